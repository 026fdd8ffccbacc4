// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/model_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ostream>
#include <string_view>
#include <utility>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "formats/format_table.h"
#include "model/following_normals.h"
#include "model/gltf_edit.h"
#include "text/bytes.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

ModelScan scan(const std::string& path, Extent extent) {
  const std::string name = path == "-" ? "-.obj" : path;  // standard input has no extension
  const auto& format = format_of(name, Content::kModel, "read a model as");
  ModelScan scan;
  scan.text = read_file(path);
  format.model.read(path, extent, scan);
  return scan;
}

template <class Scalar>
std::string_view bytes_of(double value, bool is_big_endian, char (&bytes)[8]) {
  const auto scalar = static_cast<Scalar>(value);
  put_number(scalar, bytes);
  if (is_big_endian) std::reverse(bytes, bytes + sizeof scalar);
  return {bytes, sizeof scalar};
}

void write_number(TextWriter& writer, NumberForm form, double value) {
  char bytes[8];
  switch (form) {
    case NumberForm::kFloat:
    case NumberForm::kBigFloat:
      writer << bytes_of<float>(value, form == NumberForm::kBigFloat, bytes);
      return;
    case NumberForm::kDouble:
    case NumberForm::kBigDouble:
      writer << bytes_of<double>(value, form == NumberForm::kBigDouble, bytes);
      return;
    default:
      writer << value;
  }
}

bool is_single(NumberForm form) {
  return form == NumberForm::kFloat || form == NumberForm::kBigFloat;
}

// Throws if a coordinate cannot be written in place.
void check_coordinate(const NumberPlace& place, Index vertex, int axis, double value) {
  const std::string name =
      std::string("coordinate ") + "xyz"[axis] + " of vertex " + std::to_string(vertex);
  if (!std::isfinite(value)) throw InputError(name + " would not be finite");
  if (place.form == NumberForm::kInteger) {
    throw InputError(name + " cannot change: in the file it is an integer or missing");
  }
  if (is_single(place.form) && !std::isfinite(static_cast<float>(value))) {
    throw InputError(name + " would be too large for the single precision of the file");
  }
}

template <int Dim>
PointList<3> in_space(const PolygonSoup& soup, const PointList<Dim>& points) {
  if (points.cols() != static_cast<Eigen::Index>(soup.points.size())) {
    throw InputError("the file has " + std::to_string(soup.points.size()) +
                     " vertices, but there are " + std::to_string(points.cols()) + " points");
  }
  PointList<3> result(3, points.cols());
  for (Eigen::Index v = 0; v < points.cols(); ++v) result.col(v) = soup.points[v];
  result.template topRows<Dim>() = points;
  return result;
}

bool are_single(const std::vector<Vector<3>>& points) {
  return std::all_of(points.begin(), points.end(), [](const auto& point) {
    return point.template cast<float>().template cast<double>() == point;
  });
}

// Rounds decimals with few digits to the intended color levels.
bool are_levels(const PointList<3>& colors) {
  constexpr double kDigits = 1e-3;
  const Eigen::ArrayXXd levels = 255 * colors.array();
  return ((levels - levels.round()).abs() <= kDigits).all();
}

}  // namespace

PolygonSoup read_polygons(const std::string& path) {
  return scan(path, Extent::kGeometry).model.soup;
}

struct ModelFile::Content {
  explicit Content(const std::string& path)
      : file(scan(path, Extent::kEverything)), normals(file.model, file.face_normals) {}

  FollowingNormals::Turned turned(const PointList<3>& points,
                                  const Eigen::MatrixXd& jacobians) const {
    return jacobians.size() > 0 ? normals.by(jacobians) : normals.at(points);
  }

  ModelScan file;
  FollowingNormals normals;
};

ModelFile::ModelFile(const std::string& path) : content_(std::make_unique<Content>(path)) {
}
ModelFile::~ModelFile() = default;
ModelFile::ModelFile(ModelFile&&) noexcept = default;
ModelFile& ModelFile::operator=(ModelFile&&) noexcept = default;

const Model& ModelFile::model() const {
  return content_->file.model;
}

const std::string& ModelFile::text() const {
  return content_->file.text;
}

Index ModelFile::num_loose_normals() const {
  return content_->normals.num_loose();
}

template <int Dim>
void ModelFile::write(std::ostream& out, const PointList<Dim>& points,
                      const Eigen::MatrixXd& jacobians) const {
  const auto& file = content_->file;
  if (!file.fixed.empty()) throw InputError(file.fixed);
  if (file.model.gltf) {
    const auto model = this->moved(points, jacobians);
    const bool is_same = model.soup.points == file.model.soup.points &&
                         model.attributes.normals == file.model.attributes.normals;
    out << (is_same ? file.text : moved_gltf(model));
    return;
  }
  const auto moved = in_space(file.model.soup, points);
  FollowingNormals::Turned turned;
  if (Dim == 3) turned = content_->turned(moved, jacobians);

  TextWriter writer(out);
  std::size_t done = 0;
  // Unchanged numbers keep their digits, and integer normals are not changed.
  const auto replace = [&](const NumberPlace& place, double before, double after) {
    if (after == before || place.form == NumberForm::kInteger) return;
    writer << std::string_view(file.text).substr(done, place.begin - done);
    if (place.size == 0) writer << " ";
    write_number(writer, place.form, after);
    done = place.begin + place.size;
  };
  for (const Site& site : file.sites) {
    const int d = site.axis;
    const Index k = site.index;
    if (site.kind == TripleKind::kPoint && d < Dim) {
      check_coordinate(site.place, k, d, moved(d, k));
      replace(site.place, file.model.soup.points[k][d], moved(d, k));
    } else if (site.kind == TripleKind::kNormal && Dim == 3) {
      replace(site.place, file.model.attributes.normals(d, k), turned.normals(d, k));
    } else if (site.kind == TripleKind::kFaceNormal && Dim == 3) {
      replace(site.place, file.face_normals(d, k), turned.face_normals(d, k));
    }
  }
  writer << std::string_view(file.text).substr(done);
  writer.flush();
}

template <int Dim>
Model ModelFile::moved(const PointList<Dim>& points, const Eigen::MatrixXd& jacobians) const {
  Model model = content_->file.model;
  const auto moved = in_space(model.soup, points);
  for (Eigen::Index v = 0; v < moved.cols(); ++v) model.soup.points[v] = moved.col(v);
  if (Dim == 3) model.attributes.normals = content_->turned(moved, jacobians).normals;
  return model;
}

template void ModelFile::write<2>(std::ostream&, const PointList<2>&, const Eigen::MatrixXd&) const;
template void ModelFile::write<3>(std::ostream&, const PointList<3>&, const Eigen::MatrixXd&) const;
template Model ModelFile::moved<2>(const PointList<2>&, const Eigen::MatrixXd&) const;
template Model ModelFile::moved<3>(const PointList<3>&, const Eigen::MatrixXd&) const;

std::vector<std::string> losses(const Model& model, const std::string& path) {
  const auto content = holds(path, {Content::kModel}) ? Content::kModel : Content::kMesh2D;
  const auto& format = format_of(path, content, "write a model as");
  const auto kept = format.model.attributes;
  const bool is_gltf = format.extension == "glb" || format.extension == "vrm";
  const bool is_stl = format.extension == "stl";
  const auto& [points, polygons, polylines] = model.soup;
  const auto& attributes = model.attributes;
  auto phrases = model.others;
  if (is_gltf && model.gltf) return missing_pictures(*model.gltf);  // all else stays
  const auto add_if = [&](bool is_lost, const char* phrase) {
    if (is_lost) phrases.emplace_back(phrase);
  };
  add_if((kept != Attributes::kCorners || is_gltf) && !polylines.empty(), "polylines");
  add_if(is_stl, "the order of the vertices");
  add_if((is_gltf || is_stl) && !are_single(points), "coordinates beyond single precision");
  add_if(is_stl && std::any_of(polygons.begin(), polygons.end(),
                               [](const auto& polygon) { return polygon.size() > 3; }),
         "polygons (they are cut into triangles)");
  if (kept == Attributes::kNone) {
    add_if(attributes.colors.cols() > 0, "colors");
    add_if(attributes.normals.cols() > 0, "normals of vertices");
    add_if(attributes.texture_coordinates.cols() > 0, "texture coordinates");
  } else if (kept == Attributes::kVertices) {
    add_if(!normals_at_vertices(model), "normals (they differ between corners of a vertex)");
    add_if(!texture_coordinates_at_vertices(model),
           "texture coordinates (they differ between corners of a vertex)");
    add_if(!are_levels(attributes.colors), "colors beyond 256 levels");
  }
  return phrases;
}

void write_model(const std::string& path, const Model& model) {
  const auto& format = format_of(path, Content::kModel, "write a model as");
  if (!format.model.write) {
    throw OptionError(path + ": this format is only read; write .glb, .ply, or .obj");
  }
  write_file(path, [&](std::ostream& out) { format.model.write(out, model); });
}

}  // namespace flbc::io

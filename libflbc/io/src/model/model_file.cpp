// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/io/model_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>
#include <string_view>

#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "model/following_normals.h"
#include "model/model_scan.h"
#include "text/text_writer.h"

namespace flbc::io {
namespace {

ModelScan scan(const std::string& path) {
  const auto extension = extension_of(path);
  if (extension == "obj") return scan_obj(path);
  if (extension == "off") return scan_off(path);
  if (extension == "ply") return scan_ply(path);
  if (extension == "stl") return scan_stl(path);
  if (extension == "om") return scan_om(path);
  throw OptionError(path + ": expected a file ending in .obj, .off, .ply, .stl or .om");
}

template <class Scalar>
std::string_view bytes_of(double value, bool is_big_endian, char (&bytes)[8]) {
  const auto scalar = static_cast<Scalar>(value);
  std::memcpy(bytes, &scalar, sizeof scalar);
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

// Fails where a coordinate cannot be written in its place.
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

}  // namespace

struct ModelFile::Content {
  explicit Content(const std::string& path)
      : file(scan(path)), normals(file.model, file.face_normals) {}

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

Index ModelFile::num_loose_normals() const {
  return content_->normals.num_loose();
}

template <int Dim>
void ModelFile::write(std::ostream& out, const PointList<Dim>& points) const {
  const auto& file = content_->file;
  const auto moved = in_space(file.model.soup, points);
  FollowingNormals::Turned turned;
  if (Dim == 3) turned = content_->normals.at(moved);

  TextWriter writer(out);
  std::size_t done = 0;
  // What does not change keeps its digits, and normals that are integers stay.
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
Model ModelFile::moved(const PointList<Dim>& points) const {
  Model model = content_->file.model;
  const auto moved = in_space(model.soup, points);
  for (Eigen::Index v = 0; v < moved.cols(); ++v) model.soup.points[v] = moved.col(v);
  if (Dim == 3) model.attributes.normals = content_->normals.at(moved).normals;
  return model;
}

template void ModelFile::write<2>(std::ostream&, const PointList<2>&) const;
template void ModelFile::write<3>(std::ostream&, const PointList<3>&) const;
template Model ModelFile::moved<2>(const PointList<2>&) const;
template Model ModelFile::moved<3>(const PointList<3>&) const;

}  // namespace flbc::io

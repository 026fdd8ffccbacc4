// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include "flbc/errors.h"
#include "model/model_scan.h"
#include "model/om_reader.h"

namespace flbc::io {
namespace {

using Entity = OmChunk::Entity;
using Type = OmChunk::Type;

class OmScanner {
 public:
  OmScanner(const std::string& path, ModelScan& scan)
      : path_(path), scan_(scan), model_(scan.model), reader_(path, scan.text) {}

  void run() {
    model_.is_text = false;
    model_.soup.polygons = reader_.polygons();
    for (std::size_t f = 0; f < model_.soup.polygons.size(); ++f) {
      if (model_.soup.polygons[f].size() >= 3) continue;
      throw InputError(path_ + ": face " + std::to_string(f) + " has fewer than 3 vertices");
    }
    for (const OmChunk& chunk : reader_.chunks()) take(chunk);
    if (model_.soup.points.size() != reader_.num_vertices()) {
      throw InputError(path_ + ": the file has no coordinates of its vertices");
    }
    keep_finite<3>(model_, model_.attributes.normals);
    keep_finite<2>(model_, model_.attributes.texture_coordinates);
    keep_finite<3>(model_, scan_.face_normals);
    keep_colors_in_range(model_);
    refer_to_vertices(model_);
  }

 private:
  void take(const OmChunk& chunk) {
    auto& attributes = model_.attributes;
    const bool is_of_vertices = chunk.entity == Entity::kVertex;
    const std::size_t size = chunk.components;
    if (is_of_vertices && chunk.type == Type::kPoint && size == 3) {
      take_points(chunk);
    } else if (is_of_vertices && chunk.type == Type::kNormal && size == 3) {
      attributes.normals = rows<3>(chunk, reader_.num_vertices());
      add_sites_of(chunk, reader_.num_vertices(), TripleKind::kNormal);
    } else if (chunk.entity == Entity::kFace && chunk.type == Type::kNormal && size == 3) {
      scan_.face_normals = rows<3>(chunk, reader_.num_faces());
      add_sites_of(chunk, reader_.num_faces(), TripleKind::kFaceNormal);
      add_other(model_, "normals of polygons");
    } else if (is_of_vertices && chunk.type == Type::kTexture && size == 2) {
      attributes.texture_coordinates = rows<2>(chunk, reader_.num_vertices());
    } else if (is_of_vertices && chunk.type == Type::kColor && (size == 3 || size == 4)) {
      take_colors(chunk);
    } else if (chunk.type != Type::kTopology) {
      add_other(model_, name_of(chunk));
    }
  }

  void take_points(const OmChunk& chunk) {
    if (!model_.soup.points.empty()) throw InputError(path_ + ": has coordinates twice");
    const auto points = rows<3>(chunk, reader_.num_vertices());
    for (Eigen::Index v = 0; v < points.cols(); ++v) {
      if (!points.col(v).allFinite()) {
        throw InputError(path_ + ": vertex " + std::to_string(v) + " is not finite");
      }
      model_.soup.points.emplace_back(points.col(v));
    }
    add_sites_of(chunk, reader_.num_vertices(), TripleKind::kPoint);
  }

  void take_colors(const OmChunk& chunk) {
    const double largest =
        chunk.is_floating ? 1 : std::ldexp(1.0, 8 * static_cast<int>(chunk.bytes_each)) - 1;
    model_.attributes.colors = rows<3>(chunk, reader_.num_vertices()) / largest;
    if (chunk.components == 3) return;
    for (std::size_t v = 0; v < reader_.num_vertices(); ++v) {
      if (reader_.number(chunk, v, 3) < largest) add_other(model_, "transparency");
    }
  }

  template <int Dim>
  PointList<Dim> rows(const OmChunk& chunk, std::size_t count) const {
    PointList<Dim> result(Dim, static_cast<Eigen::Index>(count));
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t d = 0; d < Dim; ++d) {
        result(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(k)) =
            reader_.number(chunk, k, d);
      }
    }
    return result;
  }

  void add_sites_of(const OmChunk& chunk, std::size_t count, TripleKind kind) {
    const NumberForm form = !chunk.is_floating      ? NumberForm::kInteger
                            : chunk.bytes_each == 4 ? NumberForm::kFloat
                                                    : NumberForm::kDouble;
    std::size_t begin = chunk.begin;
    for (std::size_t k = 0; k < count; ++k) {
      std::array<NumberPlace, 3> places;
      for (auto& place : places) {
        place = {begin, static_cast<std::uint32_t>(chunk.bytes_each), form};
        begin += chunk.bytes_each;
      }
      add_sites(scan_, places, kind, static_cast<Index>(k));
    }
  }

  static std::string name_of(const OmChunk& chunk) {
    if (chunk.type == Type::kCustom) return "property " + in_quotes(chunk.name);
    const char* const entity = chunk.entity == Entity::kVertex     ? " of vertices"
                               : chunk.entity == Entity::kFace     ? " of polygons"
                               : chunk.entity == Entity::kEdge     ? " of edges"
                               : chunk.entity == Entity::kHalfedge ? " of corners"
                                                                   : " of the mesh";
    const char* const type = chunk.type == Type::kStatus    ? "marks"
                             : chunk.type == Type::kColor   ? "colors"
                             : chunk.type == Type::kTexture ? "texture coordinates"
                             : chunk.type == Type::kNormal  ? "normals"
                                                            : "numbers";
    return std::string(type) + entity;
  }

  const std::string& path_;
  ModelScan& scan_;
  Model& model_;
  OmReader reader_;
};

}  // namespace

void read_om(const std::string& path, Extent, ModelScan& scan) {
  OmScanner(path, scan).run();
}

}  // namespace flbc::io

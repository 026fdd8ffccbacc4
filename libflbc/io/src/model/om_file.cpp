// SPDX-License-Identifier: BSD-3-Clause
// Reads OpenMesh .om files: a header with numbers of elements, then chunks of little-endian
// values, one per property of vertices, faces, edges, halfedges, or the mesh. The OpenMesh reader
// can crash on damaged files, and drops properties that are not requested.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "flbc/errors.h"
#include "model/model_scan.h"
#include "text/bytes.h"

namespace flbc::io {
namespace {

// A property.
struct OmChunk {
  enum class Entity { kVertex = 0, kMesh = 1, kFace = 2, kEdge = 4, kHalfedge = 6, kEnd = 7 };
  enum class Type {
    kPoint = 0,
    kNormal = 1,
    kTexture = 2,
    kStatus = 3,
    kColor = 4,
    kCustom = 6,
    kTopology = 7
  };

  Entity entity{};
  Type type{};
  std::string name{};        // of a custom property
  bool is_floating = false;  // otherwise integers
  bool is_signed = false;
  std::size_t components = 0;  // numbers per element
  std::size_t bytes_each = 0;  // bytes per number
  std::size_t begin = 0;       // of the values
};

using Entity = OmChunk::Entity;
using Type = OmChunk::Type;

constexpr int version(int major, int minor) {
  return major << 5 | minor;
}
constexpr int kNewestVersion = version(2, 2);
constexpr int kHalfedgesSince = version(2, 0);  // before, faces list their vertices
constexpr int kTypeNamesSince = version(2, 2);
constexpr std::size_t kStatusBytes = 4;

// A file in chunks. All errors are InputErrors naming the file.
class OmReader {
 public:
  //! Parses the file. Keeps references.
  OmReader(const std::string& path, const std::string& content) : path_(path), content_(content) {
    read_header();
    while (read_chunk()) {
    }
    if (version_ >= kHalfedgesSince) walk_polygons();
  }

  std::size_t num_vertices() const { return num_vertices_; }
  std::size_t num_faces() const { return num_faces_; }
  const std::vector<OmChunk>& chunks() const { return chunks_; }

  //! The first chunk of a kind, null if there is none.
  const OmChunk* find(Entity entity, Type type) const {
    for (const OmChunk& chunk : chunks_) {
      if (chunk.entity == entity && chunk.type == type) return &chunk;
    }
    return nullptr;
  }

  //! A component of an element; integers are not scaled.
  double number(const OmChunk& chunk, std::size_t element, std::size_t component) const {
    const std::size_t position =
        chunk.begin + (element * chunk.components + component) * chunk.bytes_each;
    return decode_number(content_.data() + position, chunk.bytes_each, chunk.is_floating,
                         chunk.is_signed);
  }

  //! The vertices of each face. The vertices are in range.
  const std::vector<std::vector<Index>>& polygons() const { return polygons_; }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_ + ": at byte " + std::to_string(position_) + ": " + message);
  }

  template <class T>
  T take() {
    if (content_.size() - position_ < sizeof(T)) fail("the file ends too early");
    position_ += sizeof(T);
    return number_at<T>(content_.data() + position_ - sizeof(T));
  }

  std::string take_name() {
    const std::size_t size = take<std::uint8_t>();
    if (content_.size() - position_ < size) fail("the file ends within a name");
    position_ += size;
    return content_.substr(position_ - size, size);
  }

  void read_header() {
    if (content_.compare(0, 2, "OM") != 0) fail("not an OpenMesh file");
    position_ = 2;
    kind_ = take<char>();
    version_ = take<std::uint8_t>();
    if (version_ > kNewestVersion) {
      fail("version " + std::to_string(version_ >> 5) + "." + std::to_string(version_ & 31) +
           " of the format is not supported; only versions up to 2.2 are");
    }
    num_vertices_ = take<std::uint32_t>();
    num_faces_ = take<std::uint32_t>();
    num_edges_ = take<std::uint32_t>();
    constexpr std::size_t kMost = std::numeric_limits<Index>::max();
    if (std::max(num_vertices_, num_faces_) > kMost) fail("the file has too many elements");
  }

  // A chunk's header has, from the lowest bit: 1 unused, 1 named, 3 entity, 4 type, 1 signed,
  // 1 floating, 3 number of components less one, 2 binary logarithm of the size.
  bool read_chunk() {
    if (position_ == content_.size()) return false;  // files before version 2 have no end mark
    const unsigned bits = take<std::uint16_t>();
    OmChunk chunk;
    chunk.entity = static_cast<Entity>(bits >> 2 & 7);
    if (chunk.entity == Entity::kEnd) {
      if (position_ < content_.size()) fail("the file has data after its end mark");
      return false;
    }
    chunk.type = static_cast<Type>(bits >> 5 & 15);
    if ((bits >> 1 & 1) != 0) {
      chunk.name = take_name();
      if (version_ >= kTypeNamesSince) take_name();
    }
    measure(chunk, bits);
    if (chunk.type == Type::kTopology && version_ < kHalfedgesSince) {
      read_listed_polygons(chunk);
      return true;
    }
    const std::size_t bytes = chunk.type == Type::kCustom
                                  ? take<std::uint32_t>()
                                  : count(chunk.entity) * chunk.components * chunk.bytes_each;
    if (content_.size() - position_ < bytes) fail("the file ends within a property");
    position_ += bytes;
    chunks_.push_back(chunk);
    return true;
  }

  void measure(OmChunk& chunk, unsigned bits) {
    const unsigned logarithm = bits >> 14 & 3;
    chunk.components = (bits >> 11 & 7) + 1;
    chunk.is_signed = (bits >> 9 & 1) != 0;
    // OpenMesh marks vectors of unsigned bytes as floating as well, but only these as unsigned.
    chunk.is_floating = (bits >> 10 & 1) != 0 && chunk.is_signed && chunk.type != Type::kTopology;
    chunk.bytes_each = std::size_t{chunk.is_floating ? 4u : 1u} << logarithm;
    if (chunk.is_floating && chunk.bytes_each > 8) fail("numbers of 128 bits are not supported");
    if (chunk.type == Type::kStatus) chunk.bytes_each = kStatusBytes;
    chunk.begin = position_;
  }

  std::size_t count(Entity entity) const {
    switch (entity) {
      case Entity::kVertex:
        return num_vertices_;
      case Entity::kFace:
        return num_faces_;
      case Entity::kEdge:
        return num_edges_;
      case Entity::kHalfedge:
        return 2 * num_edges_;
      case Entity::kMesh:
        return 1;
      default:
        fail("a property belongs to elements of an unknown kind");
    }
  }

  void read_listed_polygons(const OmChunk& chunk) {
    for (std::size_t f = 0; f < num_faces_; ++f) {
      std::size_t size = kind_ == 'T' ? 3 : 4;
      if (kind_ == 'P') size = take<std::uint16_t>();
      OmChunk corners = chunk;
      corners.begin = position_;
      if (content_.size() - position_ < size * chunk.bytes_each)
        fail("the file ends within a face");
      polygons_.emplace_back();
      for (std::size_t k = 0; k < size; ++k) {
        const std::size_t vertex = index(corners, 0, k, num_vertices_);
        polygons_.back().push_back(static_cast<Index>(vertex));
      }
      position_ += size * chunk.bytes_each;
    }
  }

  // Since version 2, a face stores a halfedge, and a halfedge stores the next one, its target
  // vertex, and its face.
  void walk_polygons() {
    const OmChunk* const faces = find(Entity::kFace, Type::kTopology);
    const OmChunk* const halfedges = find(Entity::kHalfedge, Type::kTopology);
    if (num_faces_ == 0) return;
    if (!faces || !halfedges || halfedges->components < 3) fail("the file has no connectivity");
    // The number of halfedges bounds the number of corners; faces cannot share a halfedge.
    std::size_t num_corners = 0;
    for (std::size_t f = 0; f < num_faces_; ++f) {
      const std::size_t first = index(*faces, f, 0, 2 * num_edges_);
      std::vector<Index> polygon;
      for (std::size_t h = first; polygon.empty() || h != first;) {
        if (++num_corners > 2 * num_edges_) {
          fail("the halfedges of face " + std::to_string(f) + " do not lead back to the first one");
        }
        polygon.push_back(static_cast<Index>(index(*halfedges, h, 1, num_vertices_)));
        h = index(*halfedges, h, 0, 2 * num_edges_);
      }
      polygons_.push_back(std::move(polygon));
    }
  }

  std::size_t index(const OmChunk& chunk, std::size_t element, std::size_t component,
                    std::size_t end) const {
    const double value = number(chunk, element, component);
    if (!(value >= 0 && value < static_cast<double>(end))) {
      fail("the connectivity names an element that does not exist");
    }
    return static_cast<std::size_t>(value);
  }

  const std::string& path_;
  const std::string& content_;
  std::size_t position_ = 0;
  char kind_ = 'P';
  int version_ = 0;
  std::size_t num_vertices_ = 0;
  std::size_t num_faces_ = 0;
  std::size_t num_edges_ = 0;
  std::vector<OmChunk> chunks_;
  std::vector<std::vector<Index>> polygons_;
};

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

// SPDX-License-Identifier: BSD-3-Clause
#include "model/om_reader.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "flbc/errors.h"

namespace flbc::io {
namespace {

using Entity = OmChunk::Entity;
using Type = OmChunk::Type;

constexpr int version(int major, int minor) {
  return major << 5 | minor;
}
constexpr int kNewestVersion = version(2, 2);
constexpr int kHalfedgesSince = version(2, 0);  // before, faces list their vertices
constexpr int kTypeNamesSince = version(2, 2);
constexpr std::size_t kStatusBytes = 4;

template <class T>
T as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace

OmReader::OmReader(const std::string& path, const std::string& content)
    : path_(path), content_(content) {
  read_header();
  while (read_chunk()) {
  }
  if (version_ >= kHalfedgesSince) walk_polygons();
}

void OmReader::fail(const std::string& message) const {
  throw InputError(path_ + ": at byte " + std::to_string(position_) + ": " + message);
}

template <class T>
T OmReader::take() {
  if (content_.size() - position_ < sizeof(T)) fail("the file ends too early");
  position_ += sizeof(T);
  return as<T>(content_.data() + position_ - sizeof(T));
}

std::string OmReader::take_name() {
  const std::size_t size = take<std::uint8_t>();
  if (content_.size() - position_ < size) fail("the file ends within a name");
  position_ += size;
  return content_.substr(position_ - size, size);
}

void OmReader::read_header() {
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

std::size_t OmReader::count(Entity entity) const {
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

// A chunk's header has, from the lowest bit: 1 unused, 1 named, 3 entity, 4 type, 1 signed,
// 1 floating, 3 number of components less one, 2 binary logarithm of the size.
bool OmReader::read_chunk() {
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

void OmReader::measure(OmChunk& chunk, unsigned bits) {
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

const OmChunk* OmReader::find(Entity entity, Type type) const {
  for (const OmChunk& chunk : chunks_) {
    if (chunk.entity == entity && chunk.type == type) return &chunk;
  }
  return nullptr;
}

double OmReader::number(const OmChunk& chunk, std::size_t element, std::size_t component) const {
  const std::size_t position =
      chunk.begin + (element * chunk.components + component) * chunk.bytes_each;
  const char* const bytes = content_.data() + position;
  if (chunk.is_floating) {
    return chunk.bytes_each == 4 ? as<float>(bytes) : as<double>(bytes);
  }
  switch (chunk.bytes_each) {
    case 1:
      return chunk.is_signed ? as<std::int8_t>(bytes) : as<std::uint8_t>(bytes);
    case 2:
      return chunk.is_signed ? as<std::int16_t>(bytes) : as<std::uint16_t>(bytes);
    case 4:
      return chunk.is_signed ? as<std::int32_t>(bytes) : as<std::uint32_t>(bytes);
    default:
      return static_cast<double>(as<std::int64_t>(bytes));
  }
}

void OmReader::read_listed_polygons(const OmChunk& chunk) {
  for (std::size_t f = 0; f < num_faces_; ++f) {
    std::size_t size = kind_ == 'T' ? 3 : 4;
    if (kind_ == 'P') size = take<std::uint16_t>();
    OmChunk corners = chunk;
    corners.begin = position_;
    if (content_.size() - position_ < size * chunk.bytes_each) fail("the file ends within a face");
    polygons_.emplace_back();
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t vertex = index(corners, 0, k, num_vertices_);
      polygons_.back().push_back(static_cast<Index>(vertex));
    }
    position_ += size * chunk.bytes_each;
  }
}

// Since version 2, a face stores a halfedge, and a halfedge stores the next one, its target vertex,
// and its face.
void OmReader::walk_polygons() {
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

std::size_t OmReader::index(const OmChunk& chunk, std::size_t element, std::size_t component,
                            std::size_t end) const {
  const double value = number(chunk, element, component);
  if (!(value >= 0 && value < static_cast<double>(end))) {
    fail("the connectivity names an element that does not exist");
  }
  return static_cast<std::size_t>(value);
}

}  // namespace flbc::io

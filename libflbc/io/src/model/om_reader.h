// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Reads OpenMesh .om files: a header with numbers of elements, then chunks of little-endian
//! values, one per property of vertices, faces, edges, halfedges, or the mesh. The OpenMesh reader
//! can crash on damaged files, and drops properties that are not requested.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "flbc/types.h"

namespace flbc::io {

//! A property.
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
  std::string name{};        //!< of a custom property
  bool is_floating = false;  //!< otherwise integers
  bool is_signed = false;
  std::size_t components = 0;  //!< numbers per element
  std::size_t bytes_each = 0;  //!< bytes per number
  std::size_t begin = 0;       //!< of the values
};

//! A file in chunks. All errors are InputErrors naming the file.
class OmReader {
 public:
  //! Parses the file. Keeps references.
  OmReader(const std::string& path, const std::string& content);

  std::size_t num_vertices() const { return num_vertices_; }
  std::size_t num_faces() const { return num_faces_; }
  const std::vector<OmChunk>& chunks() const { return chunks_; }

  //! The first chunk of a kind, null if there is none.
  const OmChunk* find(OmChunk::Entity entity, OmChunk::Type type) const;

  //! A component of an element; integers are not scaled.
  double number(const OmChunk& chunk, std::size_t element, std::size_t component) const;

  //! The vertices of each face. The vertices are in range.
  const std::vector<std::vector<Index>>& polygons() const { return polygons_; }

 private:
  [[noreturn]] void fail(const std::string& message) const;
  template <class T>
  T take();
  std::string take_name();
  void read_header();
  bool read_chunk();
  void measure(OmChunk& chunk, unsigned bits);
  std::size_t count(OmChunk::Entity entity) const;
  void read_listed_polygons(const OmChunk& chunk);
  void walk_polygons();
  std::size_t index(const OmChunk& chunk, std::size_t element, std::size_t component,
                    std::size_t end) const;

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

}  // namespace flbc::io

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Connectivity of a tetrahedral mesh: vertices, edges, faces, and cells.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <vector>

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Utils/Property.hh>

#include "flbc/domain_mesh.h"

namespace flbc::openmesh {

//! Handle of a tetrahedron. Like OpenMesh handles, it is invalid unless it has an index.
struct CellHandle : OpenMesh::BaseHandle {
  explicit CellHandle(int index = -1) : OpenMesh::BaseHandle(index) {}
};

//! Handle of a property of the cells.
template <class T>
struct CPropHandleT : OpenMesh::BasePropHandleT<T> {
  using Value = T;
  using value_type = T;
  using Handle = CellHandle;

  explicit CPropHandleT(int index = -1) : OpenMesh::BasePropHandleT<T>(index) {}
  explicit CPropHandleT(const OpenMesh::BasePropHandleT<T>& base)
      : OpenMesh::BasePropHandleT<T>(base) {}
};

}  // namespace flbc::openmesh

namespace OpenMesh {

template <>
struct PropHandle<flbc::openmesh::CellHandle> {
  template <class T>
  using type = flbc::openmesh::CPropHandleT<T>;
};

}  // namespace OpenMesh

template <>
struct std::hash<flbc::openmesh::CellHandle> {
  std::size_t operator()(const flbc::openmesh::CellHandle& cell) const {
    return static_cast<std::size_t>(cell.idx());
  }
};

namespace flbc::openmesh {

namespace internal {

//! Types of a forward iterator over handles, which are created from indices on access.
template <class HandleType>
struct HandleIterator {
  using iterator_category = std::forward_iterator_tag;
  using value_type = HandleType;
  using difference_type = std::ptrdiff_t;
  using pointer = const HandleType*;
  using reference = HandleType;
};

}  // namespace internal

//! All elements of one kind, ascending. Valid until the elements of the mesh change, as
//! HandleRange.
template <class Handle>
class ElementRange {
 public:
  class iterator : public internal::HandleIterator<Handle> {
   public:
    explicit iterator(int index = 0) : index_(index) {}
    Handle operator*() const { return Handle(index_); }
    iterator& operator++() { return ++index_, *this; }
    iterator operator+(int count) const { return iterator(index_ + count); }
    iterator operator++(int) { return iterator(index_++); }
    bool operator==(const iterator& other) const { return index_ == other.index_; }
    bool operator!=(const iterator& other) const { return index_ != other.index_; }

   private:
    int index_;
  };

  explicit ElementRange(std::size_t size) : size_(static_cast<int>(size)) {}
  iterator begin() const { return iterator(0); }
  iterator end() const { return iterator(size_); }
  std::size_t size() const { return static_cast<std::size_t>(size_); }

 private:
  int size_;
};

//! The neighbors of an element.
template <class Handle>
class HandleRange {
 public:
  class iterator : public internal::HandleIterator<Handle> {
   public:
    explicit iterator(const int* place = nullptr) : place_(place) {}
    Handle operator*() const { return Handle(*place_); }
    iterator& operator++() { return ++place_, *this; }
    iterator operator++(int) { return iterator(place_++); }
    bool operator==(const iterator& other) const { return place_ == other.place_; }
    bool operator!=(const iterator& other) const { return place_ != other.place_; }

   private:
    const int* place_;
  };

  HandleRange(const int* first, std::size_t size) : first_(first), size_(size) {}
  iterator begin() const { return iterator(first_); }
  iterator end() const { return iterator(first_ + size_); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  //! No range check is performed.
  Handle operator[](std::size_t k) const { return Handle(first_[k]); }

 private:
  const int* first_;
  std::size_t size_;
};

//! The part of TetMesh without points. Vertices and cells keep their order in the DomainMesh. Faces
//! are numbered as build_topology() does, edges by their first vertex, then their second.
class TetConnectivity {
 public:
  using VertexHandle = OpenMesh::VertexHandle;
  using EdgeHandle = OpenMesh::EdgeHandle;
  using FaceHandle = OpenMesh::FaceHandle;
  using CellHandle = openmesh::CellHandle;

  TetConnectivity() = default;

  //! \param mesh  with positively oriented cells
  //! \throws InputError if a face belongs to more than two cells
  explicit TetConnectivity(const DomainMesh<3>& mesh);

  std::size_t n_vertices() const { return vertex_cells_.starts.size() - 1; }
  std::size_t n_edges() const { return static_cast<std::size_t>(edges_.cols()); }
  std::size_t n_faces() const { return static_cast<std::size_t>(topology_.facets.cols()); }
  std::size_t n_cells() const { return static_cast<std::size_t>(cells_.cols()); }

  ElementRange<VertexHandle> vertices() const { return ElementRange<VertexHandle>(n_vertices()); }
  ElementRange<EdgeHandle> edges() const { return ElementRange<EdgeHandle>(n_edges()); }
  ElementRange<FaceHandle> faces() const { return ElementRange<FaceHandle>(n_faces()); }
  ElementRange<CellHandle> cells() const { return ElementRange<CellHandle>(n_cells()); }

  //! The 4 vertices in their given order.
  HandleRange<VertexHandle> cv_range(CellHandle cell) const { return {&cells_(0, cell.idx()), 4}; }

  //! The 4 faces; the k-th is opposite the k-th vertex.
  HandleRange<FaceHandle> cf_range(CellHandle cell) const {
    return {&topology_.cell_facets(0, cell.idx()), 4};
  }

  //! The 3 vertices, counterclockwise as seen from outside the first cell. Boundary faces therefore
  //! have outward orientation.
  HandleRange<VertexHandle> fv_range(FaceHandle face) const {
    return {&topology_.facets(0, face.idx()), 3};
  }

  //! The 2 cells, or 1 on the boundary, ascending.
  HandleRange<CellHandle> fc_range(FaceHandle face) const {
    return {&topology_.sides(0, face.idx()), is_boundary(face) ? 1u : 2u};
  }

  //! The 2 vertices, ascending.
  HandleRange<VertexHandle> ev_range(EdgeHandle edge) const { return {&edges_(0, edge.idx()), 2}; }

  //! The cells around a vertex, ascending.
  HandleRange<CellHandle> vc_range(VertexHandle vertex) const { return vertex_cells_.at(vertex); }

  //! The edges at a vertex, ascending.
  HandleRange<EdgeHandle> ve_range(VertexHandle vertex) const { return vertex_edges_.at(vertex); }

  //! The vertices at the other ends of these edges, in their order.
  HandleRange<VertexHandle> vv_range(VertexHandle vertex) const {
    return vertex_vertices_.at(vertex);
  }

  //! True if the face belongs to one cell only.
  bool is_boundary(FaceHandle face) const { return topology_.is_boundary(face.idx()); }
  //! True if the edge or vertex belongs to a boundary face.
  bool is_boundary(EdgeHandle edge) const { return boundary_edges_[edge.idx()]; }
  bool is_boundary(VertexHandle vertex) const { return boundary_vertices_[vertex.idx()]; }
  //! True if a face of the cell is on the boundary.
  bool is_boundary(CellHandle cell) const;

  //! The edge between two vertices, or an invalid handle.
  EdgeHandle find_edge(VertexHandle a, VertexHandle b) const;

 private:
  //! The neighbors of one kind of all vertices; those of v start at items[starts[v]].
  template <class Handle>
  struct Neighbors {
    HandleRange<Handle> at(VertexHandle vertex) const {
      const int first = starts[vertex.idx()];
      return {items.data() + first, static_cast<std::size_t>(starts[vertex.idx() + 1] - first)};
    }
    std::vector<int> starts = {0}, items;
  };

  CellList<3> cells_;
  MeshTopology<3> topology_;  // facets oriented outward from their first cell
  Eigen::Matrix<Index, 2, Eigen::Dynamic> edges_;
  Neighbors<CellHandle> vertex_cells_;
  Neighbors<EdgeHandle> vertex_edges_;
  Neighbors<VertexHandle> vertex_vertices_;
  std::vector<bool> boundary_vertices_, boundary_edges_;
};

}  // namespace flbc::openmesh

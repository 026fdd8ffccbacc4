// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Which vertices, edges, faces and cells of a tetrahedral mesh meet.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <OpenMesh/Core/Mesh/Handles.hh>

#include "flbc/openmesh/simplex_table.h"
#include "flbc/openmesh/tet_handles.h"
#include "flbc/openmesh/tet_ranges.h"

namespace flbc::openmesh {

//! The part of TetMesh that knows no points. Elements are numbered in the order in which they were
//! added, edges and faces in the order in which the cells first met them; so they are numbered the
//! same way however the mesh was made. Elements cannot be deleted.
class TetConnectivity {
 public:
  using VertexHandle = OpenMesh::VertexHandle;
  using EdgeHandle = OpenMesh::EdgeHandle;
  using FaceHandle = OpenMesh::FaceHandle;
  using CellHandle = openmesh::CellHandle;

  std::size_t n_vertices() const { return last_corner_.size(); }
  std::size_t n_edges() const { return edge_vertices_.size() / 2; }
  std::size_t n_faces() const { return face_vertices_.size() / 3; }
  std::size_t n_cells() const { return cell_vertices_.size() / 4; }

  ElementRange<VertexHandle> vertices() const { return ElementRange<VertexHandle>(n_vertices()); }
  ElementRange<EdgeHandle> edges() const { return ElementRange<EdgeHandle>(n_edges()); }
  ElementRange<FaceHandle> faces() const { return ElementRange<FaceHandle>(n_faces()); }
  ElementRange<CellHandle> cells() const { return ElementRange<CellHandle>(n_cells()); }

  //! The 4 vertices in the order in which they were given.
  HandleRange<VertexHandle> cv_range(CellHandle cell) const {
    return few<VertexHandle, 4>(cell_vertices_, cell);
  }

  //! The 4 faces; the k-th is opposite the k-th vertex.
  HandleRange<FaceHandle> cf_range(CellHandle cell) const {
    return few<FaceHandle, 4>(cell_faces_, cell);
  }

  //! The 3 vertices, anticlockwise as seen from outside the first of its cells if that is
  //! positively oriented; so the boundary faces look outwards.
  HandleRange<VertexHandle> fv_range(FaceHandle face) const {
    return few<VertexHandle, 3>(face_vertices_, face);
  }

  //! The 2 cells, or 1 on the boundary; the first is the one that was added first.
  HandleRange<CellHandle> fc_range(FaceHandle face) const {
    return {face_cells_.data() + 2 * place(face), is_boundary(face) ? 1u : 2u};
  }

  //! The 2 vertices, the one with the smaller number first.
  HandleRange<VertexHandle> ev_range(EdgeHandle edge) const {
    return few<VertexHandle, 2>(edge_vertices_, edge);
  }

  //! The cells around a vertex, ascending.
  ListRange<internal::CellOfCorner> vc_range(VertexHandle vertex) const {
    return {next_corner_.data(), last_corner_[place(vertex)]};
  }

  //! The edges at a vertex, ascending.
  ListRange<internal::EdgeOfEnd> ve_range(VertexHandle vertex) const {
    return {next_end_.data(), last_end_[place(vertex)]};
  }

  //! The vertices at the other ends of these edges, in their order.
  ListRange<internal::OppositeEnd> vv_range(VertexHandle vertex) const {
    return {next_end_.data(), last_end_[place(vertex)], {edge_vertices_.data()}};
  }

  //! True if the face belongs to one cell only.
  bool is_boundary(FaceHandle face) const { return face_cells_[2 * place(face) + 1] < 0; }
  //! True if the edge belongs to a boundary face.
  bool is_boundary(EdgeHandle edge) const { return boundary_faces_at_edge_[place(edge)] > 0; }
  //! True if the vertex belongs to a boundary face.
  bool is_boundary(VertexHandle vertex) const {
    return boundary_faces_at_vertex_[place(vertex)] > 0;
  }
  //! True if one of the cell's faces is a boundary face.
  bool is_boundary(CellHandle cell) const;

  //! The edge between two vertices, or an invalid handle; walks the edges at the first one.
  EdgeHandle find_edge(VertexHandle a, VertexHandle b) const;

  //! The face of three vertices, or an invalid handle; walks the cells around the first one.
  FaceHandle find_face(VertexHandle a, VertexHandle b, VertexHandle c) const;

 protected:
  void reserve(std::size_t vertices, std::size_t edges, std::size_t faces, std::size_t cells);

  //! A vertex without cells.
  VertexHandle append_vertex();

  //! \throws InputError, and changes nothing, if a vertex does not exist or occurs twice, or if a
  //! face has two cells already
  CellHandle append_cell(const std::array<int, 4>& vertices);

  //! Frees the memory that only append_cell() needs; it would have to be built anew.
  void forget_tables();

 private:
  template <class Element>
  static std::size_t place(Element element) {
    return static_cast<std::size_t>(element.idx());
  }
  template <class Handle, std::size_t Count, class Element>
  static HandleRange<Handle> few(const std::vector<int>& table, Element element) {
    return {table.data() + Count * place(element), Count};
  }

  void restore_tables();
  std::array<int, 4> existing_faces(const std::array<int, 4>& vertices) const;
  std::array<int, 6> append_edges(const std::array<int, 4>& vertices);
  void append_face(const std::array<int, 4>& vertices, int opposite);
  void count_boundary(int opposite, const std::array<int, 4>& vertices,
                      const std::array<int, 6>& edges, int change);

  // Flat tables, some entries per element.
  std::vector<int> cell_vertices_;  // 4
  std::vector<int> cell_faces_;     // 4
  std::vector<int> face_vertices_;  // 3
  std::vector<int> face_cells_;     // 2, the second -1 on the boundary
  std::vector<int> edge_vertices_;  // 2

  // The corners (4 * cell + k) and the edges' ends (2 * edge + k) at each vertex as closed lists,
  // of which the last entry is kept (-1: empty), so that more can be appended in any order.
  std::vector<int> next_corner_;
  std::vector<int> last_corner_;
  std::vector<int> next_end_;
  std::vector<int> last_end_;

  std::vector<int> boundary_faces_at_vertex_;
  std::vector<int> boundary_faces_at_edge_;

  SimplexTable<3> face_of_;
  SimplexTable<2> edge_of_;
};

}  // namespace flbc::openmesh

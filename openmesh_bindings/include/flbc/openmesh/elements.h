// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! A common interface to cells and facets of triangle meshes and tetrahedral meshes.
#pragma once

#include <array>

#include <OpenMesh/Core/Mesh/Handles.hh>
#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>
#include <OpenMesh/Core/Utils/Property.hh>

#include "flbc/openmesh/tet_mesh.h"

namespace flbc::openmesh {

//! Dimension of the domain that a mesh type describes: 2 for triangle meshes, 3 for TetMesh.
template <class Mesh>
inline constexpr int kDimension = 2;
//! Tetrahedral meshes.
template <>
inline constexpr int kDimension<TetMesh> = 3;

//! OpenMesh meshes: cells are faces, facets are edges.
template <class Mesh>
struct Elements {
  using Cell = OpenMesh::FaceHandle;
  using Facet = OpenMesh::EdgeHandle;
  template <class T>
  using CellProperty = OpenMesh::FPropHandleT<T>;
  template <class T>
  using FacetProperty = OpenMesh::EPropHandleT<T>;

  static auto cells(const Mesh& mesh) { return mesh.all_faces(); }
  static auto facets(const Mesh& mesh) { return mesh.all_edges(); }
  static auto facets_of(const Mesh& mesh, Cell cell) { return mesh.fe_range(cell); }

  //! The cells on the first and second side of a facet; the second is invalid on the boundary.
  static std::array<Cell, 2> sides(const Mesh& mesh, Facet facet) {
    const auto edge = OpenMesh::make_smart(facet, mesh);
    const Cell first = edge.h0().face(), second = edge.h1().face();
    return first.is_valid() ? std::array{first, second} : std::array{second, first};
  }
  static std::array<OpenMesh::VertexHandle, 2> corners(const Mesh& mesh, Facet facet) {
    const auto halfedge = OpenMesh::make_smart(facet, mesh).h0();
    return {halfedge.from(), halfedge.to()};
  }
};

//! Tetrahedral meshes: cells are cells, facets are faces.
template <>
struct Elements<TetMesh> {
  using Cell = CellHandle;
  using Facet = OpenMesh::FaceHandle;
  template <class T>
  using CellProperty = CPropHandleT<T>;
  template <class T>
  using FacetProperty = OpenMesh::FPropHandleT<T>;

  static auto cells(const TetMesh& mesh) { return mesh.cells(); }
  static auto facets(const TetMesh& mesh) { return mesh.faces(); }
  static auto facets_of(const TetMesh& mesh, Cell cell) { return mesh.cf_range(cell); }
  static std::array<Cell, 2> sides(const TetMesh& mesh, Facet facet) {
    const auto cells = mesh.fc_range(facet);
    return {cells[0], cells.size() == 2 ? cells[1] : Cell()};
  }
  static std::array<OpenMesh::VertexHandle, 3> corners(const TetMesh& mesh, Facet facet) {
    const auto vertices = mesh.fv_range(facet);
    return {vertices[0], vertices[1], vertices[2]};
  }
};

}  // namespace flbc::openmesh

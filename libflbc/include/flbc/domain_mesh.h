// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The domain mesh, on which the coordinates are piecewise linear, and its facets, edges, and
//! parts.
#pragma once

#include <array>
#include <vector>

#include "flbc/types.h"

namespace flbc {

//! Triangles (2D) or tetrahedra (3D) that fill the interior of a cage.
template <int Dim>
struct DomainMesh {
  PointList<Dim> points;  //!< Dim x V
  CellList<Dim> cells;    //!< (Dim + 1) x F, positively oriented

  //! V.
  Index num_vertices() const { return static_cast<Index>(points.cols()); }

  //! F.
  Index num_cells() const { return static_cast<Index>(cells.cols()); }
};

//! The facets (edges in 2D, triangles in 3D) of a domain mesh and which cells they separate.
template <int Dim>
struct MeshTopology {
  //! Dim x E, the vertices of each facet.
  FacetList<Dim> facets;

  //! 2 x E, the cells on the first and second side; the second is -1 on the boundary.
  Eigen::Matrix<Index, 2, Eigen::Dynamic> sides;

  //! (Dim + 1) x F, row k: the facet opposite to the cell's vertex k.
  CellList<Dim> cell_facets;

  //! E.
  Index num_facets() const { return static_cast<Index>(facets.cols()); }

  //! Whether only one cell has the facet.
  bool is_boundary(Index facet) const { return sides(1, facet) < 0; }
};

//! Enumerates facets in the order of their first occurrence in the cells.
//! \param mesh  with indices in range
//! \throws InputError if a facet belongs to more than two cells
template <int Dim>
MeshTopology<Dim> build_topology(const DomainMesh<Dim>& mesh);

//! Which vertices lie on boundary facets.
//! \param topology  of a mesh
//! \param num_vertices  V of that mesh
//! \return V entries
template <int Dim>
std::vector<bool> boundary_vertices(const MeshTopology<Dim>& topology, Index num_vertices);

//! Signed area (2D) or volume (3D) of a cell; positive for cells of a valid mesh.
//! \param mesh  with indices in range
//! \param cell  in [0, F)
//! \return in units of the mesh^Dim
template <int Dim>
double signed_measure(const DomainMesh<Dim>& mesh, Index cell);

//! Checks the numbers of a mesh. \throws InputError naming the element if the mesh is empty, an
//! index is out of range, a coordinate is not finite, a cell is degenerate or inverted, or a vertex
//! belongs to no cell
template <int Dim>
void validate(const DomainMesh<Dim>& mesh);

//! Checks how cells meet. \param mesh  has passed validate() \param topology  of the mesh
//! \throws InputError naming the element if a facet belongs to two cells on the same side, or parts
//! touch without a common facet
template <int Dim>
void validate(const DomainMesh<Dim>& mesh, const MeshTopology<Dim>& topology);

//! Reverses cells with negative measure, and performs both checks.
//! \param mesh  any
//! \throws InputError naming the element if the mesh is empty, an index is out of range, a
//! coordinate is not finite, a cell is degenerate, a vertex belongs to no cell, a facet belongs to
//! more than two cells or to two cells on the same side, or parts touch without a common facet.
//! Several parts that do not touch are valid (mesh_parts())
template <int Dim>
void normalize_and_validate(DomainMesh<Dim>& mesh);

//! A connected part of a mesh.
template <int Dim>
struct MeshPart {
  DomainMesh<Dim> mesh;
  std::vector<Index> vertices;  //!< per vertex of the part: its index in the whole mesh
};

//! Number of parts that share no vertex.
//! \param mesh  has passed normalize_and_validate()
template <int Dim>
Index count_parts(const DomainMesh<Dim>& mesh);

//! Splits a mesh into its parts. Vertices and cells of a part keep their order.
//! \param mesh  has passed normalize_and_validate()
//! \return in the order of their first vertices
template <int Dim>
std::vector<MeshPart<Dim>> mesh_parts(const DomainMesh<Dim>& mesh);

//! Joins parts. Cells are concatenated in the order of the parts.
//! \param parts  their `vertices` together contain each index from 0 to V - 1 once
template <int Dim>
DomainMesh<Dim> join_parts(const std::vector<MeshPart<Dim>>& parts);

//! Throws if a mesh has several parts.
//! \param mesh  has passed normalize_and_validate()
//! \throws InputError naming a vertex of each of two parts
template <int Dim>
void require_connected(const DomainMesh<Dim>& mesh);

//! Undirected edges between points.
struct EdgeList {
  //! The two points of each edge, in any order.
  std::vector<std::array<Index, 2>> ends{};

  //! Weight of each edge, > 0; empty means 1 for each. An edge that is listed twice counts twice.
  std::vector<double> weights{};
};

//! A model as a set of points, segments, and triangles.
template <int Dim>
struct ModelElements {
  PointList<Dim> points;  //!< Dim x P
  FacetList<3> corners;   //!< 3 x E; repeated corners describe a segment or a point
};

//! Checks edges.
//! \param edges  any
//! \param num_points  P
//! \throws InputError if an end of an edge is not in [0, P), a weight is not positive and finite,
//! or there is not one weight per edge
void validate(const EdgeList& edges, Eigen::Index num_points);

//! The edges of the cells, each once, ascending. With their weights,
//!
//!     sum over edges ab of k_ab |f(a) - f(b)|^2
//!
//! approximates the integral of |grad f|^2. Each cell distributes its area or volume, times Dim,
//! equally among its edges; k_ab is the sum for the edge, divided by its squared length. On regular
//! cells these are the cotangent weights of linear finite elements. Unlike those they are positive
//! on all cells, which edge-by-edge minimization requires.
//! \param mesh  any cells and points
//! \throws InputError if a vertex of a cell is not one of the points
template <int Dim>
EdgeList edges_of_cells(const DomainMesh<Dim>& mesh);

//! The same for polygons and polylines. The area of a polygon is that of the triangle fan at its
//! first vertex.
//! \param points  Dim x P
//! \param polygons  vertices of each in order, the first not repeated
//! \param polylines  vertices of each in order; closed if the last equals the first
//! \throws InputError if a vertex of a polygon or polyline is not one of the points
template <int Dim>
EdgeList edges_of_polygons(const PointList<Dim>& points,
                           const std::vector<std::vector<Index>>& polygons,
                           const std::vector<std::vector<Index>>& polylines = {});

}  // namespace flbc

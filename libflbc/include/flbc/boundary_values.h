// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The coordinates of points on the cage, which are known beforehand.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Barycentric coordinates of the mesh's boundary vertices in the cage facets on which they lie
//! (Lagrange property and linearity on facets, properties 4 and 5 of the paper). At most Dim
//! control points matter to each; a vertex at a control point or on a cage edge has zeros
//! elsewhere.
template <int Dim>
struct BoundaryValues {
  std::vector<Index> vertices;          //!< the boundary vertices, ascending
  std::vector<Index> boundary_index;    //!< per mesh vertex: its place in `vertices`, or -1 inside
  FacetList<Dim> control_points;        //!< Dim x B, the control points of the facet
  PointList<Dim> values;                //!< Dim x B, their weights, each column sums to 1
  std::vector<Index> control_vertices;  //!< per control point: the mesh vertex that lies on it

  //! Whether a vertex does not lie on the cage.
  //! \param vertex  of the mesh
  bool is_interior(Index vertex) const { return boundary_index[vertex] < 0; }

  //! The vertices that do not lie on the cage, ascending.
  std::vector<Index> interior_vertices() const {
    std::vector<Index> interior;
    interior.reserve(boundary_index.size() - vertices.size());
    for (std::size_t v = 0; v < boundary_index.size(); ++v) {
      if (is_interior(static_cast<Index>(v))) interior.push_back(static_cast<Index>(v));
    }
    return interior;
  }

  //! Adds the coordinates of a boundary vertex to a row of zeros.
  //! \param b  place of the vertex in `vertices`
  //! \param row  n zeros
  template <class Row>
  void scatter(Index b, Row&& row) const {
    for (int k = 0; k < Dim; ++k) row[control_points(k, b)] += values(k, b);
  }

  //! Replaces the columns of boundary vertices by their exact coordinates.
  //! \param weights  n x V
  void impose_on(WeightMatrix& weights) const {
    for (std::size_t b = 0; b < vertices.size(); ++b) {
      auto column = weights.col(vertices[b]);
      column.setZero();
      scatter(static_cast<Index>(b), column);
    }
  }
};

//! Locates every boundary vertex on the cage by geometry, so that any mesh of the interior of
//! the cage works.
//! \param cage  n control points
//! \param mesh  V vertices, B of them on the boundary
//! \param topology  of the mesh
//! \throws InputError naming the vertex if one is farther from the cage than 1e-6 of the cage's
//! size, the cell if its boundary facet is, or the control point if one is not a vertex of the mesh
template <int Dim>
BoundaryValues<Dim> boundary_values(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                    const MeshTopology<Dim>& topology);

//! Moves boundary vertices near the cage onto it: first onto control points, then onto facets.
//! Meshes stored in single precision or as text with few digits have such vertices. Vertices within
//! 1e-12 of the size of the cage are unchanged.
//! \param cage  n control points
//! \param topology  of the mesh
//! \param tolerance  how far, relative to the cage's size, a vertex is moved at most, >= 0
//! \param mesh  V vertices, changed in place
template <int Dim>
void snap_to_cage(const Cage<Dim>& cage, const MeshTopology<Dim>& topology, double tolerance,
                  DomainMesh<Dim>& mesh);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Weights at points on the cage, which are known without solving.
#pragma once

#include <vector>

#include "flbc/cage.h"
#include "flbc/domain_mesh.h"

namespace flbc {

//! Known weights of the boundary vertices: barycentric coordinates in the cage facet on which each
//! vertex lies. They satisfy the Lagrange property and linearity on facets (properties 4 and 5 of
//! the paper). At most Dim weights of a vertex are nonzero; at a control point only one is.
template <int Dim>
struct BoundaryValues {
  std::vector<Index> vertices;          //!< boundary vertices, ascending
  std::vector<Index> boundary_index;    //!< per mesh vertex: position in `vertices`; -1 inside
  FacetList<Dim> control_points;        //!< Dim x B, control points of the facet
  PointList<Dim> values;                //!< Dim x B, their weights; each column sums to 1
  std::vector<Index> control_vertices;  //!< per control point: the mesh vertex at it

  //! Whether a vertex lies off the cage.
  //! \param vertex  of the mesh
  bool is_interior(Index vertex) const { return boundary_index[vertex] < 0; }

  //! The vertices off the cage, ascending.
  std::vector<Index> interior_vertices() const {
    std::vector<Index> interior;
    interior.reserve(boundary_index.size() - vertices.size());
    for (std::size_t v = 0; v < boundary_index.size(); ++v) {
      if (is_interior(static_cast<Index>(v))) interior.push_back(static_cast<Index>(v));
    }
    return interior;
  }

  //! Adds the weights of a boundary vertex to a row of zeros.
  //! \param b  position of the vertex in `vertices`
  //! \param row  n zeros
  template <class Row>
  void scatter(Index b, Row&& row) const {
    for (int k = 0; k < Dim; ++k) row[control_points(k, b)] += values(k, b);
  }

  //! Replaces the columns of boundary vertices with their exact weights.
  //! \param weights  n x V
  void impose_on(WeightMatrix& weights) const {
    for (std::size_t b = 0; b < vertices.size(); ++b) {
      auto column = weights.col(vertices[b]);
      column.setZero();
      scatter(static_cast<Index>(b), column);
    }
  }
};

//! Locates every boundary vertex on the cage geometrically, so any domain mesh of the cage works.
//! \param cage  n control points
//! \param mesh  V vertices, B of them on the boundary
//! \param topology  of the mesh
//! \throws InputError if a boundary vertex or facet is farther from the cage than 1e-6 of cage
//! size, or a control point is not a mesh vertex. The message names the vertex, cell, or control
//! point
template <int Dim>
BoundaryValues<Dim> boundary_values(const Cage<Dim>& cage, const DomainMesh<Dim>& mesh,
                                    const MeshTopology<Dim>& topology);

//! Moves boundary vertices near the cage onto it: first onto control points, then onto facets.
//! Meshes stored in single precision or as text with few digits have such vertices. Vertices within
//! 1e-12 of cage size stay unchanged.
//! \param cage  n control points
//! \param topology  of the mesh
//! \param tolerance  maximum displacement of a vertex relative to cage size, >= 0
//! \param mesh  V vertices, changed in place
//! \throws OptionError if the tolerance is negative
template <int Dim>
void snap_to_cage(const Cage<Dim>& cage, const MeshTopology<Dim>& topology, double tolerance,
                  DomainMesh<Dim>& mesh);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The discretized problem (7)-(10) of the paper, with an optional quadratic term.
#pragma once

#include <cstddef>
#include <functional>

#include "flbc/boundary_values.h"
#include "flbc/cage.h"
#include "flbc/distance_weights.h"
#include "flbc/domain_mesh.h"
#include "flbc/masks.h"
#include "flbc/types.h"

namespace flbc {

//! The input of all solver methods. The geometry is centered and scaled so that the bounding box of
//! the cage has diagonal 1. Weights do not depend on the scale.
template <int Dim>
struct LbcProblem {
  Cage<Dim> cage;                //!< scaled, n control points
  DomainMesh<Dim> mesh;          //!< scaled, V vertices and F cells
  MeshTopology<Dim> topology;    //!< of the mesh
  BoundaryValues<Dim> boundary;  //!< known weights (properties 4 and 5 of the paper)
  WeightFunctions phi;           //!< n x F: weights of the total variation
  double scale = 1;              //!< scaled length / original length
  double smoothness = 0;         //!< epsilon >= 0 of the quadratic term, scaled length
  PointMasks masks{};            //!< of interior vertices (SolverOptions::masks)

  //! n.
  Index num_control_points() const { return cage.size(); }
};

//! Read access to one vector per cell and control point, for gradients and duals. The order in
//! memory is cell, component, control point; a row has `stride` entries, of which the first n are
//! used.
template <class Scalar, int Dim>
struct CellFieldView {
  const Scalar* data;  //!< of the first cell
  std::size_t stride;  //!< distance between components in entries, >= n
  Index n;             //!< number of control points

  //! The vectors on one cell in double precision, Dim x n.
  Eigen::Matrix<double, Dim, Eigen::Dynamic> cell(Index s) const {
    using Rows = Eigen::Matrix<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const Rows, 0, Eigen::OuterStride<>>(
               data + static_cast<std::size_t>(s) * Dim * stride, Dim, n,
               Eigen::OuterStride<>(static_cast<Eigen::Index>(stride)))
        .template cast<double>();
  }
};

//! Computes one vector per control point on a cell or facet, n x Dim.
template <int Dim>
using VectorsAt = std::function<Eigen::Matrix<double, Eigen::Dynamic, Dim>(Index)>;

//! Sets up a problem: topology, boundary values, and phi.
//! \param cage  n control points
//! \param mesh  domain mesh of the cage, V vertices (see normalize_and_validate)
//! \param scheme  growth of phi with the geodesic distance
//! \param smoothness  SolverOptions::smoothness, >= 0
//! \throws InputError naming the element if the mesh does not match the cage, or if the mesh has
//! several parts; SolverError if distances cannot be computed
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, DistanceScheme scheme,
                             double smoothness);

//! The same with known facets in the caller's order, for example from a half-edge mesh.
//! \param cage  n control points
//! \param mesh  domain mesh of the cage, V vertices
//! \param topology  of the mesh
//! \param scheme  growth of phi with the geodesic distance
//! \param smoothness  SolverOptions::smoothness, >= 0
//! \throws InputError, SolverError as above
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             DistanceScheme scheme, double smoothness);

}  // namespace flbc

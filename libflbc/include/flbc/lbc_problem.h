// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The discretised problem (7)-(10) of the paper, immutable once made.
#pragma once

#include <cstddef>
#include <functional>

#include "flbc/boundary_values.h"
#include "flbc/cage.h"
#include "flbc/distance_weights.h"
#include "flbc/domain_mesh.h"
#include "flbc/types.h"

namespace flbc {

//! Everything the solvers read. Geometry is centered and scaled such that the diagonal of the
//! cage's bounding box is the unit of length; weights do not depend on it.
template <int Dim>
struct LbcProblem {
  Cage<Dim> cage;                //!< scaled, n control points
  DomainMesh<Dim> mesh;          //!< scaled, V vertices and F cells
  MeshTopology<Dim> topology;    //!< of the mesh
  BoundaryValues<Dim> boundary;  //!< the weights that are known (properties 4 and 5 of the paper)
  WeightFunctions phi;           //!< n x F: the weight functions of total variation
  double scale = 1;              //!< scaled length / original length

  //! n.
  Index num_control_points() const { return cage.size(); }
};

//! Read access to one vector per cell and control point (gradients, duals), stored cell-major, then
//! by component, then `stride` control points contiguous, of which the first n count.
template <class Scalar, int Dim>
struct CellFieldView {
  const Scalar* data;  //!< of the first cell
  std::size_t stride;  //!< numbers from one component to the next, >= n
  Index n;             //!< number of control points

  //! Dim x n, on one cell, in double precision.
  Eigen::Matrix<double, Dim, Eigen::Dynamic> cell(Index s) const {
    using Rows = Eigen::Matrix<Scalar, Dim, Eigen::Dynamic, Eigen::RowMajor>;
    return Eigen::Map<const Rows, 0, Eigen::OuterStride<>>(
               data + static_cast<std::size_t>(s) * Dim * stride, Dim, n,
               Eigen::OuterStride<>(static_cast<Eigen::Index>(stride)))
        .template cast<double>();
  }
};

//! One vector per control point on a cell or facet, n x Dim, computed on demand.
template <int Dim>
using VectorsAt = std::function<Eigen::Matrix<double, Eigen::Dynamic, Dim>(Index)>;

//! Sets a problem up: topology, boundary values, phi.
//! \param cage  n control points
//! \param mesh  V vertices, a mesh of the cage's interior (see normalize_and_validate)
//! \param scheme  growth of phi with the geodesic distance
//! \throws InputError if mesh and cage do not belong together, naming the element, or the mesh has
//! several parts; SolverError if distances cannot be computed
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, DistanceScheme scheme);

//! The same with facets that are known already, in the caller's order, as a half-edge mesh has
//! them.
//! \param cage  n control points
//! \param mesh  V vertices, a mesh of the cage's interior
//! \param topology  of the mesh
//! \param scheme  growth of phi with the geodesic distance
//! \throws InputError, SolverError as above
template <int Dim>
LbcProblem<Dim> make_problem(Cage<Dim> cage, DomainMesh<Dim> mesh, MeshTopology<Dim> topology,
                             DistanceScheme scheme);

}  // namespace flbc

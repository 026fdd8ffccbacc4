// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Supports: the control points that may have a weight at a vertex. Elsewhere nothing is stored.
#pragma once

#include <cstdint>
#include <functional>

#include "flbc/lbc_problem.h"
#include "mesh/vertex_cells.h"
#include "solver/start/start.h"
#include "solver/start/transfer.h"

namespace flbc::active_set {

//! Number of a control point; see plan::active_set() for how many there are at most.
using ControlPoint = std::uint16_t;

//! The control points of every vertex, ascending.
using ActiveLists = VertexItems<ControlPoint>;

//! Weights that are not above it are as good as zero where a mean squared error is wanted.
double threshold_for(double tolerance);

//! Supports from the weights on a coarser mesh: the control points whose weights are above the
//! threshold at a corner of the vertex's coarse cell or at a neighbour of one, and those of the
//! boundary next to the vertex. There are non-negative weights on them at every vertex. Boundary
//! vertices have those control points whose weights are not zero.
template <int Dim>
ActiveLists active_from(const LbcProblem<Dim>& problem, const Transfer<Dim>& coarse,
                        double threshold);

//! The same from weights on the mesh itself, at the vertex or at a neighbour.
//! \param weights  of an interior vertex, n numbers, feasible
template <int Dim>
ActiveLists active_of(const LbcProblem<Dim>& problem, const VectorsAt<1>& weights,
                      double threshold);

//! The flux densities of a start where weights above the threshold are near, zero elsewhere.
template <int Dim>
VectorsAt<Dim> where_weights_are(const LbcProblem<Dim>& problem, const Start<Dim>& start,
                                 double threshold);

//! Where an iteration on the active set starts from without a coarser mesh: harmonic coordinates,
//! without duals, and their active set.
template <int Dim>
struct ColdStart {
  Start<Dim> start;  //!< owns what it refers to
  ActiveLists active;
};

//! \param problem  without phi as well \param linear_solver  for the Laplace equation
//! \throws SolverError if it cannot be solved
template <int Dim>
ColdStart<Dim> cold_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver);

//! w at one place of an interior vertex's list.
using WeightInList = std::function<double(Index vertex, Index place)>;

//! Sum of the squared weights at the ends of the active set: where a neighbour may not have any.
template <int Dim>
double squared_at_ends(const LbcProblem<Dim>& problem, const ActiveLists& active,
                       const WeightInList& weight);

//! Supports with the control points of neighbours whose weights are above the threshold.
template <int Dim>
ActiveLists grown(const LbcProblem<Dim>& problem, const ActiveLists& active, double threshold,
                  const WeightInList& weight);

//! Pairs of interior vertices and control points, relative to all there are.
template <int Dim>
double density(const LbcProblem<Dim>& problem, const ActiveLists& active);

}  // namespace flbc::active_set

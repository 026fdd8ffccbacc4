// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! The active set: per vertex, the control points that may have a weight. Nothing else is stored.
#pragma once

#include <cstdint>
#include <functional>

#include "flbc/lbc_problem.h"
#include "linear/linear_solver.h"
#include "mesh/vertex_cells.h"
#include "solver/start/prolongation.h"
#include "solver/start/start.h"

namespace flbc::active_set {

//! Index of a control point; plan::active_set() limits their number.
using ControlPoint = std::uint16_t;

//! The active control points of every vertex, ascending. There may be more than 2^31 in all.
using ActiveLists = VertexItems<ControlPoint, std::size_t>;

//! Smaller weights count as zero for a given mean squared error.
double threshold_for(double tolerance);

//! The active set from weights on a coarser mesh. A vertex gets the control points whose weights
//! exceed the threshold at a corner of its coarse cell or at a neighbor of such a corner, and those
//! of adjacent boundary vertices. Feasible non-negative weights exist at every vertex. Boundary
//! vertices get the control points of their nonzero weights.
template <int Dim>
ActiveLists active_from(const LbcProblem<Dim>& problem, const Prolongation<Dim>& coarse,
                        double threshold);

//! The same from weights on the mesh itself, at the vertex or at a neighbor.
//! \param weights  of an interior vertex, n numbers, feasible
template <int Dim>
ActiveLists active_of(const LbcProblem<Dim>& problem, const VectorsAt<1>& weights,
                      double threshold);

//! The pairs of two active sets of a problem.
template <int Dim>
ActiveLists joined(const LbcProblem<Dim>& problem, const ActiveLists& a, const ActiveLists& b);

//! All control points that masks allow.
template <int Dim>
ActiveLists all_allowed(const LbcProblem<Dim>& problem);

//! The flux densities of a start near weights above the threshold; zero elsewhere.
template <int Dim>
VectorsAt<Dim> where_weights_are(const LbcProblem<Dim>& problem, const Start<Dim>& start,
                                 double threshold);

//! Start of an iteration on the active set without a coarser mesh: harmonic coordinates without
//! duals, and their active set.
template <int Dim>
struct HarmonicStart {
  Start<Dim> start;  //!< refers to data of this object
  ActiveLists active;
};

//! \param problem  phi is not needed \param linear_solver  for the Laplace equation
//! \throws SolverError if the Laplace equation cannot be solved
template <int Dim>
HarmonicStart<Dim> harmonic_start(const LbcProblem<Dim>& problem, LinearSolver linear_solver);

//! w at one entry in the list of an interior vertex.
using WeightInList = std::function<double(Index vertex, Index place)>;

//! Sum of the squared weights at the border of the active set: pairs that are missing at a
//! neighbor.
template <int Dim>
double squared_at_ends(const LbcProblem<Dim>& problem, const ActiveLists& active,
                       const WeightInList& weight);

//! Extends the active set by control points of neighbors whose weights exceed the threshold.
template <int Dim>
ActiveLists grown(const LbcProblem<Dim>& problem, const ActiveLists& active, double threshold,
                  const WeightInList& weight);

//! Active pairs of interior vertices and control points, relative to all pairs.
template <int Dim>
double density(const LbcProblem<Dim>& problem, const ActiveLists& active);

}  // namespace flbc::active_set

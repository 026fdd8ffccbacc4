// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Quality measures of weights.
#pragma once

#include "flbc/domain_mesh.h"
#include "flbc/lbc_problem.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! A weight is an influence if |w_i| exceeds this threshold.
constexpr double kInfluenceThreshold = 1e-4;

//! Quality measures that need only weights, points, and control points. Points without weights,
//! which do not move, have no errors.
struct Quality {
  double min_weight = 0;              //!< smallest w_i
  double max_partition_error = 0;     //!< max |sum_i w_i - 1|
  double max_reproduction_error = 0;  //!< max |sum_i w_i c_i - x| / cage size
  double mean_influences = 0;         //!< mean number of |w_i| > 1e-4 per point
};

//! Measures weights.
//! \param control_points  Dim x n
//! \param points  Dim x P, in the units of the control points
//! \param weights  of P points
//! \throws InputError if the sizes do not match
template <int Dim>
Quality measure_quality(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const SparseWeights& weights);

//! Objective (7) of the paper plus the quadratic term of SolverOptions::smoothness:
//! sum_s sum_i A_s (phi_s^i |grad w_i|_s + epsilon / 2 |grad w_i|_s^2).
//! \param mesh  valid, F cells, V vertices
//! \param phi  n x F
//! \param weights  of V points
//! \param smoothness  epsilon >= 0, a length in units of the mesh
//! \return in units of phi times the mesh^(Dim - 1)
//! \throws InputError if phi or weights are of other sizes, or a cell names no vertex
template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const WeightFunctions& phi,
                 const SparseWeights& weights, double smoothness = 0);

//! The objective that a problem minimizes, in its scaled units.
template <int Dim>
double objective(const LbcProblem<Dim>& problem, const SparseWeights& weights) {
  return objective(problem.mesh, problem.phi, weights, problem.smoothness);
}

//! The total variation sum_s sum_i A_s |grad w_i|_s.
//! \param mesh  valid, V vertices
//! \param weights  of V points
//! \return in units of the mesh^(Dim - 1)
template <int Dim>
double total_variation(const DomainMesh<Dim>& mesh, const SparseWeights& weights);

//! Smoothness of weights: the jump of their gradients across interior facets, relative to the size
//! of the cage. A kink has a jump on every mesh; jumps of smooth functions shrink with the cells.
//! \param problem  its mesh and topology
//! \param weights  of V points
//! \return root mean square of sqrt(sum_i |jump of grad w_i|^2), weighted by the measure of a
//! facet, times bounding_box_diagonal of the cage; 0 without interior facets
//! \throws InputError if the sizes do not match
template <int Dim>
double gradient_jump(const LbcProblem<Dim>& problem, const SparseWeights& weights);

//! Error (5) of the paper: the mean of (a - b)^2 over interior vertices and control points.
//! \param a  weights of V points
//! \param b  reference weights, usually the optimum
//! \return 0 if there are no interior vertices
//! \throws InputError if the sizes do not match
template <int Dim>
double squared_error(const LbcProblem<Dim>& problem, const SparseWeights& a,
                     const SparseWeights& b);

}  // namespace flbc

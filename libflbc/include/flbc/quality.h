// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! How good weights are, measured on the weights themselves.
#pragma once

#include "flbc/domain_mesh.h"
#include "flbc/lbc_problem.h"
#include "flbc/sparse_weights.h"

namespace flbc {

//! A weight counts as an influence if |w_i| is above it.
constexpr double kInfluenceThreshold = 1e-4;

//! Properties of weights, measured on the weights themselves.
struct Quality {
  double min_weight = 0;              //!< smallest w_i
  double max_partition_error = 0;     //!< max |sum_i w_i - 1|
  double max_reproduction_error = 0;  //!< max |sum_i w_i c_i - x| / size of the cage
  double mean_influences = 0;         //!< mean number of |w_i| > 1e-4 per point
};

//! Measures weights from nothing but points and control points.
//! \param control_points  Dim x n
//! \param points  Dim x P, in the units of the control points
//! \param weights  n x P
//! \tparam Weights  WeightMatrix or SparseWeights
//! \throws InputError if the sizes do not belong together
template <int Dim, class Weights>
Quality measure_quality(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const Weights& weights);

//! The paper's objective (7), sum_s sum_i phi_s^i A_s |grad w_i|_s.
//! \param mesh  valid, F cells, V vertices
//! \param phi  n x F
//! \param weights  n x V
//! \return in units of phi times the mesh^(Dim - 1)
template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const WeightFunctions& phi,
                 const WeightMatrix& weights);

//! The same for weights without their zeros.
template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const WeightFunctions& phi,
                 const SparseWeights& weights);

//! The total variation sum_s sum_i A_s |grad w_i|_s.
//! \param mesh  valid, V vertices
//! \param weights  n x V
//! \return in units of the mesh^(Dim - 1)
template <int Dim>
double total_variation(const DomainMesh<Dim>& mesh, const WeightMatrix& weights);

//! The paper's error (5): the mean of (a - b)^2 over interior vertices and control points.
//! \param a  weights, n x V
//! \param b  weights to compare with, usually the optimum, n x V
//! \return 0 if there are no interior vertices
//! \throws InputError if the sizes do not belong together
template <int Dim>
double squared_error(const LbcProblem<Dim>& problem, const WeightMatrix& a, const WeightMatrix& b);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// Harmonic coordinates and least-squares recovery with a shared Poisson problem.
#pragma once

#include "base/parallel.h"
#include "flbc/lbc_problem.h"
#include "flbc/sparse_weights.h"
#include "problem/barycentric_constraints.h"
#include "problem/laplacian.h"

namespace flbc {

//! harmonic_coordinates() of harmonic.h. \param poisson  on the mesh of the problem
template <int Dim>
WeightMatrix harmonic_coordinates(const LbcProblem<Dim>& problem,
                                  const DirichletProblem<Dim>& poisson);

//! integrate_least_squares() of recovery.h. \param poisson  on the mesh of the problem
template <class Scalar, int Dim>
WeightMatrix integrate_least_squares(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients,
                                     const DirichletProblem<Dim>& poisson);

//! Projects interior columns onto partition of unity and reproduction (8). Single precision
//! gradients satisfy them only to about 1e-7, and errors accumulate over many cells. Boundary
//! columns are exact and unchanged.
template <int Dim>
void project_interior(const LbcProblem<Dim>& problem, WeightMatrix& weights) {
  const BarycentricConstraints<Dim> constraints(problem.cage.points);
  parallel_for(problem.mesh.num_vertices(), [&](Index v) {
    if (problem.boundary.is_interior(v)) {
      constraints.project_weights(problem.mesh.points.col(v), weights.col(v));
    }
  });
}

//! The same for sparse weights, which stay zero where they are zero.
template <int Dim>
void project_interior(const LbcProblem<Dim>& problem, SparseWeights& weights);

}  // namespace flbc

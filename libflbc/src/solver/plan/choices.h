// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Every automatic choice of a solve, from sizes and settings. The constants are in constants.h.
#pragma once

#include "flbc/lbc_problem.h"
#include "linear/linear_solver.h"
#include "solver/plan/constants.h"
#include "solver/plan/settings.h"

namespace flbc::plan {

//! The inputs of a choice.
struct Sizes {
  int dim;
  Index control_points;
  Index vertices;
  bool masked = false;  // inside; masks of boundary vertices do not change the problem
};

template <int Dim>
Sizes sizes_of(const LbcProblem<Dim>& problem) {
  return {Dim, problem.num_control_points(), problem.mesh.num_vertices(), !problem.masks.empty()};
}

//! Whether a method supports the quadratic term of SolverOptions::smoothness.
bool smooths(Method method);

//! Whether a method can start from the duals of another mesh or rest cage.
bool inherits(Method method);

//! The linear solver: a factor of a large mesh takes more time and memory than the iteration.
inline LinearSolver linear_solver(const Sizes& sizes, Method method) {
  if (method == Method::kLbc2014) return LinearSolver::kDirect;  // as published
  return sizes.vertices > most_factored(sizes.dim) ? LinearSolver::kMultigrid
                                                   : LinearSolver::kDirect;
}

//! Indices of control points in an active set are stored in 16 bits.
constexpr Index kMostActiveControlPoints = 65000;

//! Whether to try an active set, because it may be faster and supports all settings, or because
//! there are masks.
bool active_set(const Sizes& sizes, const Settings& settings);

//! Whether the active set has all pairs that masks allow. A small problem without another start has
//! them, because masks move weights to control points that harmonic coordinates do not find.
bool active_set_is_complete(const Sizes& sizes, const Settings& settings, bool cold);

//! Whether a certificate is wanted, which needs the duals of all pairs.
bool proves(const Settings& settings);

//! Whether an active set is small enough to be faster. \param density  of its pairs
bool active_set_pays(double density, const Sizes& sizes, const Settings& settings);

//! The factor that converts a penalty for a cage of size 1 to a cage of another size. The penalty
//! term must scale like total variation, length^(dim - 1). It is mu A |grad w|^2 for kWeights, mu
//! A^2 |grad w|^2 for kLbc2014, and mu |grad w|^2 for other methods; gradients scale like 1 /
//! length.
//! \param size  of the cage (bounding_box_diagonal)
double penalty_unit(Method method, int dim, double size);

//! Published penalties and thresholds refer to a domain whose farthest vertex is at radius 250 from
//! the center of its bounding box.
//! \return published length / length of this mesh
template <int Dim>
double published_scale(const DomainMesh<Dim>& mesh) {
  constexpr double kRadius = 250;
  const Vector<Dim> center =
      (mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff()) / 2;
  return kRadius / (mesh.points.colwise() - center).colwise().norm().maxCoeff();
}

//! Whether distances of a refined mesh are interpolated. Automatic ones are not for a certificate,
//! which proves the gap for its phi. \param error  DistanceReport::phi_error; 0 if not known yet
bool interpolates(const Settings& settings, double error);

}  // namespace flbc::plan

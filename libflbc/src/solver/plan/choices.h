// SPDX-License-Identifier: BSD-3-Clause
//! \file
//! Every choice that a solve makes by itself, from sizes and options alone. The numbers behind the
//! choices are in constants.h.
#pragma once

#include <vector>

#include "flbc/lbc_problem.h"
#include "flbc/options.h"

namespace flbc::plan {

//! What a choice depends on.
struct Sizes {
  int dim;
  Index control_points;
  Index vertices;
};

template <int Dim>
Sizes sizes_of(const LbcProblem<Dim>& problem) {
  return {Dim, problem.num_control_points(), problem.mesh.num_vertices()};
}

//! Whether a method minimizes the objective, for which it needs phi.
bool minimizes(Method method);

//! Whether a method starts from the duals of another mesh or shape.
bool inherits(Method method);

//! How linear systems are solved: a factor of a large mesh takes more time and memory than the
//! iteration.
LinearSolver linear_solver(const Sizes& sizes, const SolverOptions& options);

//! Whether the duals of cells are stored in half precision at first.
bool half_precision(Index cells, const SolverOptions& options);

//! Whether an active set is to be looked for, because it may pay and gives all that is asked for.
bool active_set(const Sizes& sizes, const SolverOptions& options);

//! Whether an active set is small enough to be faster. \param density  of its pairs
bool active_set_pays(double density, const SolverOptions& options);

//! The penalty whose value is 1 for a cage of size 1, for a cage of another size. The term of the
//! penalty has to grow with lengths as total variation does, (length)^(dim - 1): it is
//! mu A |grad w|^2 for kValue, mu A^2 |grad w|^2 for kLbc2014 and mu |grad w|^2 for the others, in
//! which gradients shrink as 1 / length.
//! \param size  of the cage (bounding_box_diagonal)
double penalty_unit(Method method, int dim, double size);

//! Penalties and thresholds in publications have a meaning for a domain whose farthest vertex is at
//! radius 250 about the center of its bounding box.
//! \return published length / length of this mesh
template <int Dim>
double published_scale(const DomainMesh<Dim>& mesh) {
  constexpr double kRadius = 250;
  const Vector<Dim> center =
      (mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff()) / 2;
  return kRadius / (mesh.points.colwise() - center).colwise().norm().maxCoeff();
}

//! Numbers of vertices of the coarser meshes to start from, ascending; none where they do not pay
//! or are not wanted. \param options  resolved
std::vector<Index> coarse_sizes(const Sizes& sizes, const SolverOptions& options);

//! Whether distances are to be interpolated from a coarser mesh if they turn out to be good enough.
//! \param has_coarse_mesh  whether there is one to start from
bool interpolates_distances(const Sizes& sizes, const SolverOptions& options, bool has_coarse_mesh);

//! Vertices of a coarse mesh for distances alone.
Index distances_mesh_size(Index vertices, double tolerance);

}  // namespace flbc::plan

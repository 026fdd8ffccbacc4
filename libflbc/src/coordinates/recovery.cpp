// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/recovery.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "coordinates/poisson_weights.h"
#include "flbc/errors.h"
#include "linear/dense.h"
#include "mesh/cell_geometry.h"
#include "mesh/vertex_cells.h"

namespace flbc {
namespace {

template <class Scalar, int Dim>
void require_gradients_of(const LbcProblem<Dim>& problem,
                          const CellFieldView<Scalar, Dim>& gradients) {
  if (gradients.n == problem.num_control_points()) return;
  throw InputError("the gradients are of " + std::to_string(gradients.n) +
                   " control points, but the problem has " +
                   std::to_string(problem.num_control_points()));
}

// The vertices by their distance from the boundary, counted in edges; a level is ascending.
template <int Dim>
std::vector<std::vector<Index>> breadth_first_levels(const LbcProblem<Dim>& problem,
                                                     const VertexCells& around,
                                                     std::vector<Index>& level_of) {
  level_of.assign(problem.mesh.num_vertices(), -1);
  std::vector<std::vector<Index>> levels{problem.boundary.vertices};
  for (const Index v : levels[0]) level_of[v] = 0;
  while (!levels.back().empty()) {
    std::vector<Index> next;
    for (const Index v : levels.back()) {
      for (const Index s : around.cells_of(v)) {
        for (const Index w : problem.mesh.cells.col(s)) {
          if (level_of[w] >= 0) continue;
          level_of[w] = static_cast<Index>(levels.size());
          next.push_back(w);
        }
      }
    }
    std::sort(next.begin(), next.end());
    levels.push_back(std::move(next));
  }
  return levels;
}

}  // namespace

template <class Scalar, int Dim>
WeightMatrix integrate_breadth_first(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients) {
  require_gradients_of(problem, gradients);
  const auto& mesh = problem.mesh;
  const VertexCells around(mesh);
  std::vector<Index> level_of;
  const auto levels = breadth_first_levels(problem, around, level_of);

  WeightMatrix weights = WeightMatrix::Zero(gradients.n, mesh.num_vertices());
  problem.boundary.impose_on(weights);
  for (std::size_t level = 1; level < levels.size(); ++level) {
    const auto& vertices = levels[level];
    parallel_for(vertices.size(), [&](std::size_t k) {
      const Index v = vertices[k];
      int paths = 0;
      for (const Index s : around.cells_of(v)) {
        const auto gradient = gradients.cell(s);
        for (const Index w : mesh.cells.col(s)) {
          if (level_of[w] != static_cast<Index>(level) - 1) continue;
          weights.col(v) +=
              weights.col(w) + gradient.transpose() * (mesh.points.col(v) - mesh.points.col(w));
          ++paths;
        }
      }
      weights.col(v) /= paths;
    });
  }
  project_interior(problem, weights);
  return weights;
}

template <class Scalar, int Dim>
WeightMatrix integrate_least_squares(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients,
                                     const DirichletProblem<Dim>& poisson) {
  require_gradients_of(problem, gradients);
  const auto& mesh = problem.mesh;
  const VertexCells around(mesh);
  Eigen::MatrixXd divergence = Eigen::MatrixXd::Zero(gradients.n, mesh.num_vertices());
  parallel_for(mesh.num_vertices(), [&](Index v) {
    if (!problem.boundary.is_interior(v)) return;
    for (const Index s : around.cells_of(v)) {
      const auto geometry = cell_geometry(mesh, s);
      Index corner = 0;
      while (mesh.cells(corner, s) != v) ++corner;
      divergence.col(v) +=
          gradients.cell(s).transpose() * (geometry.measure * geometry.hat_gradients.col(corner));
    }
  });
  auto weights = poisson.solve(boundary_matrix(problem.boundary, gradients.n), divergence);
  project_interior(problem, weights);
  return weights;
}

template <class Scalar, int Dim>
WeightMatrix integrate_least_squares(const LbcProblem<Dim>& problem,
                                     const CellFieldView<Scalar, Dim>& gradients) {
  return integrate_least_squares(problem, gradients,
                                 DirichletProblem<Dim>(problem.mesh, problem.boundary));
}

namespace {

// The nearest weights on the same control points with sum 1 that reproduce the point.
template <int Dim>
Eigen::VectorXd projected_on_support(const LbcProblem<Dim>& problem, Index vertex,
                                     Eigen::VectorXd weights) {
  std::vector<Index> support;
  for (Index i = 0; i < weights.size(); ++i) {
    if (weights[i] != 0) support.push_back(i);
  }
  Eigen::MatrixXd constraints(Dim + 1, support.size());
  constraints.row(0).setOnes();
  constraints.bottomRows(Dim) = problem.cage.points(Eigen::all, support);
  Vector<Dim + 1> target;
  target << 1, problem.mesh.points.col(vertex);
  const Eigen::VectorXd defect = target - constraints * weights(support);
  weights(support) += dense::least_squares(constraints, defect);
  return weights;
}

}  // namespace

template <int Dim>
void project_interior(const LbcProblem<Dim>& problem, SparseWeights& weights) {
  const auto given = std::move(weights);
  weights = SparseWeights::of(given.num_control_points(), given.num_points(), [&](Index v) {
    return problem.boundary.is_interior(v) ? projected_on_support(problem, v, given.at(v))
                                           : given.at(v);
  });
}

#define FLBC_INSTANTIATE(Scalar, Dim)                                               \
  template WeightMatrix integrate_breadth_first(const LbcProblem<Dim>&,             \
                                                const CellFieldView<Scalar, Dim>&); \
  template WeightMatrix integrate_least_squares(const LbcProblem<Dim>&,             \
                                                const CellFieldView<Scalar, Dim>&); \
  template WeightMatrix integrate_least_squares(                                    \
      const LbcProblem<Dim>&, const CellFieldView<Scalar, Dim>&, const DirichletProblem<Dim>&);
FLBC_INSTANTIATE(float, 2)
FLBC_INSTANTIATE(float, 3)
FLBC_INSTANTIATE(double, 2)
FLBC_INSTANTIATE(double, 3)
#undef FLBC_INSTANTIATE

template void project_interior(const LbcProblem<2>&, SparseWeights&);
template void project_interior(const LbcProblem<3>&, SparseWeights&);

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/gradient_problem.h"

#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include <Eigen/LU>

#include "base/flush_denormals.h"
#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/union_find.h"
#include "coordinates/poisson_weights.h"
#include "flbc/bounding_box.h"
#include "mesh/cell_geometry.h"
#include "problem/barycentric_constraints.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"

namespace flbc::openmesh {
namespace {

// Tangential projectors of all facets; on boundary facets h of (9), the tangential gradients of the
// boundary values.
template <class Scalar, int Dim>
void set_up_facets(const MeshTopology<Dim>& topology, GradientProblem<Scalar, Dim>& problem) {
  const auto& boundary = problem.base->boundary;
  const auto& points = problem.base->mesh.points;
  const auto num_facets = static_cast<std::size_t>(topology.num_facets());
  problem.slope.resize(num_facets);
  problem.projector.resize(num_facets);
  for (Index f = 0; f < topology.num_facets(); ++f) {
    const auto corners = topology.facets.col(f);
    Eigen::Matrix<double, Dim, Dim - 1> edges;
    for (int k = 1; k < Dim; ++k)
      edges.col(k - 1) = points.col(corners[k]) - points.col(corners[0]);
    const Eigen::Matrix<double, Dim - 1, Dim - 1> products = edges.transpose() * edges;
    const Eigen::Matrix<double, Dim, Dim - 1> inverse = edges * products.inverse();
    problem.projector[f] = (inverse * edges.transpose()).template cast<Scalar>();
    if (!topology.is_boundary(f)) continue;
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(problem.base->num_control_points(), Dim);
    for (int k = 0; k < Dim; ++k) {
      boundary.scatter(boundary.boundary_index[corners[k]], weights.col(k));
    }
    const Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> differences =
        weights.template rightCols<Dim - 1>().colwise() - weights.col(0);
    problem.slope[f] = (inverse * differences.transpose()).template cast<Scalar>();
  }
}

// The radius phi A and epsilon A of the Z-step.
template <class Scalar, int Dim>
void set_up_cells(const Eigen::VectorXd& measures, GradientProblem<Scalar, Dim>& problem) {
  problem.quadratic = problem.base->smoothness * measures;
  problem.radius.resize(problem.base->num_control_points(), measures.size());
  parallel_for(measures.size(), [&](Eigen::Index s) {
    problem.radius.col(s) = (measures[s] * problem.base->phi.col(s)).template cast<Scalar>();
  });
}

// The boundary component of each control point. \return number of components
template <int Dim>
Index number_components(const LbcProblem<Dim>& problem, std::vector<Index>& component) {
  const Index n = problem.num_control_points();
  UnionFind sets(n);
  for (const auto& facet : problem.cage.facets.colwise()) {
    for (const Index i : facet) sets.unite(facet[0], i);
  }
  component.assign(static_cast<std::size_t>(n), -1);
  Index count = 0;
  for (Index i = 0; i < n; ++i) {
    Index& of_root = component[sets.find(i)];
    if (of_root < 0) of_root = count++;
    component[i] = of_root;
  }
  return count;
}

// With psi harmonic, 1 on one component and 0 on the others, the sum of A_s grad psi(s) . g_i(s) is
// the same for the gradients of all weights with the right boundary values, including those of
// harmonic coordinates. These sum to psi over the control points on the component.
template <class Scalar, int Dim>
void set_up_periods(GradientProblem<Scalar, Dim>& problem) {
  const auto& mesh = problem.base->mesh;
  const Index n = problem.base->num_control_points();
  std::vector<Index> component;
  const Index count = number_components(*problem.base, component);
  if (count == 1) return;
  const WeightMatrix harmonic = internal::harmonic_weights(problem);
  Eigen::MatrixXd indicator = Eigen::MatrixXd::Zero(n, count - 1);
  for (Index i = 0; i < n; ++i) {
    if (component[i] > 0) indicator(i, component[i] - 1) = 1;
  }
  problem.periods.resize(static_cast<std::size_t>(count - 1),
                         {PointList<Dim>(Dim, mesh.num_cells()), Eigen::RowVectorXd::Zero(n)});
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const auto geometry = cell_geometry(mesh, s);
    const auto gradients = weight_gradients(mesh, s, geometry, harmonic);
    const Eigen::MatrixXd fields = geometry.measure * gradients.transpose() * indicator;
    for (Index p = 0; p < count - 1; ++p) {
      problem.periods[p].field.col(s) = fields.col(p);
      problem.periods[p].values += (gradients * fields.col(p)).transpose();
    }
  }
  for (auto& period : problem.periods) {
    period.values /= period.field.norm();
    period.field /= period.field.norm();
  }
}

template <class Scalar, int Dim>
const DirichletProblem<Dim>& poisson_of(const GradientProblem<Scalar, Dim>& problem) {
  const auto& base = *problem.base;
  if (!problem.poisson) {
    problem.poisson = std::make_shared<const DirichletProblem<Dim>>(
        base.mesh, base.boundary, plan::linear_solver(plan::sizes_of(base), Method::kGradient));
  }
  return *problem.poisson;
}

}  // namespace

template <class Scalar, int Dim>
GradientProblem<Scalar, Dim> make_gradient_problem(std::shared_ptr<const LbcProblem<Dim>> base,
                                                   const MeshTopology<Dim>& topology) {
  GradientProblem<Scalar, Dim> problem;
  problem.base = std::move(base);
  const auto& [cage, mesh] = std::tie(problem.base->cage, problem.base->mesh);
  // (8) in an orthonormal basis. Centering the control points keeps their span and the gradients.
  const BarycentricConstraints<Dim> constraints(cage.points.colwise() -
                                                cage.points.rowwise().mean());
  problem.basis = constraints.basis().template cast<Scalar>();
  problem.target = constraints.gradient_target().transpose().template cast<Scalar>();
  const Eigen::VectorXd measures = cell_measures(mesh);
  set_up_cells(measures, problem);
  set_up_facets(topology, problem);
  set_up_periods(problem);
  // docs/explanation/method/gradient_admm.md
  const double length = std::pow(measures.squaredNorm() / measures.sum(), 1.0 / Dim);
  problem.penalty = plan::gradient_penalty(Dim) * std::pow(bounding_box_diagonal(cage.points), 2) *
                    std::pow(length, Dim - 1);
  problem.published_scale = plan::published_scale(mesh);
  problem.published_penalty =
      plan::published_gradient_penalty(Dim) / std::pow(problem.published_scale, Dim + 1);
  return problem;
}

void for_blocks(int count, const std::function<void(int, int, int)>& body) {
  const auto start_of = [&](std::int64_t block) {
    return static_cast<int>(block * count / kSumBlocks);
  };
  const int fewest = count < kFewestInParallel ? kSumBlocks + 1 : kSumBlocks;
  parallel_for(
      kSumBlocks,
      [&](int b) {
        const FlushDenormals scope;
        body(b, start_of(b), start_of(b + 1));
      },
      fewest);
}

template <int Dim>
std::shared_ptr<const LbcProblem<Dim>> internal::problem_on_mesh(const Cage<Dim>& cage,
                                                                 Domain<Dim> domain,
                                                                 DistanceScheme phi,
                                                                 double smoothness) {
  auto problem = make_problem(cage, domain.mesh, std::move(domain.topology), phi, 0);
  problem.cage = cage;
  problem.mesh = std::move(domain.mesh);
  problem.scale = 1;
  problem.smoothness = smoothness * bounding_box_diagonal(cage.points);
  return std::make_shared<const LbcProblem<Dim>>(std::move(problem));
}

template <class Scalar, int Dim>
WeightMatrix internal::harmonic_weights(const GradientProblem<Scalar, Dim>& problem) {
  return harmonic_coordinates(*problem.base, poisson_of(problem));
}

template <class Scalar, int Dim>
WeightMatrix internal::nearest_weights(const GradientProblem<Scalar, Dim>& problem,
                                       const CellFieldView<Scalar, Dim>& gradients) {
  return integrate_least_squares(*problem.base, gradients, poisson_of(problem));
}

FLBC_INSTANTIATE_SCALAR_FUNCTION(make_gradient_problem)
FLBC_INSTANTIATE_SCALAR_FUNCTION(internal::harmonic_weights)
FLBC_INSTANTIATE_SCALAR_FUNCTION(internal::nearest_weights)
FLBC_INSTANTIATE_FUNCTION(internal::problem_on_mesh)

}  // namespace flbc::openmesh

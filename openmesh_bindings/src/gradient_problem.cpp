// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/gradient_problem.h"

#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include <Eigen/LU>

#include "base/parallel.h"
#include "flbc/bounding_box.h"
#include "flbc/harmonic.h"
#include "flbc/openmesh/gradients.h"
#include "linear/dense.h"
#include "solver/plan/choices.h"
#include "solver/plan/constants.h"

namespace flbc::openmesh {
namespace {

// Tangential projectors of all facets; on boundary facets h of (9), the tangential gradients of the
// boundary values.
template <int Dim>
void set_up_facets(GradientProblem<Dim>& problem) {
  const auto& [topology, boundary, points] =
      std::tie(problem.base.topology, problem.base.boundary, problem.base.mesh.points);
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
    problem.projector[f] = inverse * edges.transpose();
    if (!topology.is_boundary(f)) continue;
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(problem.base.num_control_points(), Dim);
    for (int k = 0; k < Dim; ++k) {
      boundary.scatter(boundary.boundary_index[corners[k]], weights.col(k));
    }
    const Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> differences =
        weights.template rightCols<Dim - 1>().colwise() - weights.col(0);
    problem.slope[f] = inverse * differences.transpose();
  }
}

// (8) in an orthonormal basis. Centering the control points keeps their span and the gradients.
template <int Dim>
void set_up_barycentric_conditions(GradientProblem<Dim>& problem) {
  const auto& points = problem.base.cage.points;
  Eigen::Matrix<double, Eigen::Dynamic, Dim + 1> A(points.cols(), Dim + 1);
  A.col(0).setOnes();
  A.template rightCols<Dim>() = (points.colwise() - points.rowwise().mean()).transpose();
  problem.basis = dense::orthonormal_basis(A);
  // g A = [0, I] and A = Q R, hence g Q = [0, I] / R.
  Eigen::Matrix<double, Dim, Dim + 1> demanded;
  demanded << Vector<Dim>::Zero(), Eigen::Matrix<double, Dim, Dim>::Identity();
  problem.target = demanded * dense::gram<Dim + 1>(problem.basis, A).inverse();
}

// The boundary component of each control point; component 0 contains the first boundary vertex.
// \return number of components
template <int Dim>
Index number_components(const LbcProblem<Dim>& problem, std::vector<Index>& component) {
  const auto& facets = problem.cage.facets;
  component.assign(static_cast<std::size_t>(problem.num_control_points()), -1);
  Index count = 0;
  for (Eigen::Index b = 0; b < problem.boundary.control_points.cols(); ++b) {
    const Index first = problem.boundary.control_points(0, b);
    if (component[first] >= 0) continue;
    component[first] = count;
    for (bool grows = true; grows;) {
      grows = false;
      for (const auto& facet : facets.colwise()) {
        bool touches = false, leaves = false;
        for (const Index i : facet) (component[i] == count ? touches : leaves) = true;
        if (!touches || !leaves) continue;
        for (const Index i : facet) component[i] = count;
        grows = true;
      }
    }
    ++count;
  }
  return count;
}

// With psi harmonic, 1 on one component and 0 on the others, the sum of A_s grad psi(s) . g_i(s) is
// the same for the gradients of all weights with the right boundary values, including those of
// harmonic coordinates. These sum to psi over the control points on the component.
template <int Dim>
void set_up_periods(GradientProblem<Dim>& problem) {
  const auto& mesh = problem.base.mesh;
  std::vector<Index> component;
  const Index count = number_components(problem.base, component);
  if (count == 1) return;
  const SparseWeights harmonic = harmonic_coordinates(problem.base);
  Eigen::MatrixXd indicator = Eigen::MatrixXd::Zero(harmonic.num_control_points(), count - 1);
  for (std::size_t i = 0; i < component.size(); ++i) {
    if (component[i] > 0) indicator(static_cast<Eigen::Index>(i), component[i] - 1) = 1;
  }
  problem.periods.resize(static_cast<std::size_t>(count - 1),
                         {PointList<Dim>(Dim, mesh.num_cells()),
                          Eigen::RowVectorXd::Zero(harmonic.num_control_points())});
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const auto gradients = internal::gradients_on_cell(mesh, s, harmonic);
    const Eigen::MatrixXd fields = signed_measure(mesh, s) * gradients * indicator;
    for (Index p = 0; p < count - 1; ++p) {
      problem.periods[p].field.col(s) = fields.col(p);
      problem.periods[p].values += fields.col(p).transpose() * gradients;
    }
  }
  for (auto& period : problem.periods) {
    period.values /= period.field.norm();
    period.field /= period.field.norm();
  }
}

}  // namespace

template <int Dim>
GradientProblem<Dim> make_gradient_problem(const Cage<Dim>& cage, Domain<Dim> domain,
                                           DistanceScheme phi, double smoothness) {
  GradientProblem<Dim> problem;
  problem.base = make_problem(cage, domain.mesh, std::move(domain.topology), phi, 0);
  problem.base.cage = cage;
  problem.base.mesh = std::move(domain.mesh);
  problem.base.scale = 1;
  problem.base.smoothness = smoothness * bounding_box_diagonal(cage.points);
  const auto& mesh = problem.base.mesh;
  problem.radius = problem.base.phi.dense();
  Eigen::VectorXd measures(mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) measures[s] = signed_measure(mesh, s);
  problem.radius *= measures.asDiagonal();
  problem.quadratic = problem.base.smoothness * measures;
  set_up_facets(problem);
  set_up_barycentric_conditions(problem);
  set_up_periods(problem);
  // The same choice as for Method::kGradient; docs/explanation/method/gradient_admm.md.
  const double length = std::pow(measures.squaredNorm() / measures.sum(), 1.0 / Dim);
  problem.penalty = plan::gradient_penalty(Dim) * std::pow(bounding_box_diagonal(cage.points), 2) *
                    std::pow(length, Dim - 1);
  problem.published_scale = plan::published_scale(mesh);
  return problem;
}

void for_blocks(int count, const std::function<void(int, int, int)>& body) {
  const auto start_of = [&](std::int64_t block) {
    return static_cast<int>(block * count / kSumBlocks);
  };
  const int fewest = count < kFewestInParallel ? kSumBlocks + 1 : kSumBlocks;
  parallel_for(
      kSumBlocks, [&](int b) { body(b, start_of(b), start_of(b + 1)); }, fewest);
}

template GradientProblem<2> make_gradient_problem(const Cage<2>&, Domain<2>, DistanceScheme,
                                                  double);
template GradientProblem<3> make_gradient_problem(const Cage<3>&, Domain<3>, DistanceScheme,
                                                  double);

}  // namespace flbc::openmesh

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/gradient_problem.h"

#include <cmath>
#include <utility>

#include <Eigen/LU>
#include <Eigen/QR>

#include "flbc/bounding_box.h"
#include "flbc/harmonic.h"
#include "flbc/openmesh/gradients.h"

namespace flbc::openmesh {
namespace {

// h of (9): on each boundary facet, the tangential gradients of the boundary values.
template <int Dim>
std::vector<VectorRows<Dim>> boundary_slopes(const LbcProblem<Dim>& problem) {
  const Index n = problem.num_control_points();
  const auto& facets = problem.topology.facets;
  std::vector<VectorRows<Dim>> slopes(static_cast<std::size_t>(problem.topology.num_facets()));
  for (Index f = 0; f < problem.topology.num_facets(); ++f) {
    if (!problem.topology.is_boundary(f)) continue;
    Eigen::Matrix<double, Dim, Dim - 1> edges;
    Eigen::MatrixXd corner_weights = Eigen::MatrixXd::Zero(n, Dim);
    for (int k = 0; k < Dim; ++k) {
      problem.boundary.scatter(problem.boundary.boundary_index[facets(k, f)],
                               corner_weights.col(k));
      if (k > 0) {
        edges.col(k - 1) =
            problem.mesh.points.col(facets(k, f)) - problem.mesh.points.col(facets(0, f));
      }
    }
    const Eigen::Matrix<double, Eigen::Dynamic, Dim - 1> differences =
        corner_weights.template rightCols<Dim - 1>().colwise() - corner_weights.col(0);
    const Eigen::Matrix<double, Dim - 1, Dim - 1> products = edges.transpose() * edges;
    slopes[static_cast<std::size_t>(f)] = edges * products.inverse() * differences.transpose();
  }
  return slopes;
}

// (8) in an orthonormal basis. Centering the control points keeps their span and the gradients.
template <int Dim>
void set_up_barycentric_conditions(GradientProblem<Dim>& problem) {
  const auto& points = problem.base.cage.points;
  Eigen::MatrixXd A(points.cols(), Dim + 1);
  A.col(0).setOnes();
  A.rightCols(Dim) = (points.colwise() - points.rowwise().mean()).transpose();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  problem.basis = qr.householderQ() * Eigen::MatrixXd::Identity(points.cols(), Dim + 1);
  // g A = [0, I] and A = Q R, hence g Q = [0, I] / R.
  Eigen::Matrix<double, Dim, Dim + 1> demanded;
  demanded << Vector<Dim>::Zero(), Eigen::Matrix<double, Dim, Dim>::Identity();
  const Eigen::Matrix<double, Dim + 1, Dim + 1> R =
      qr.matrixQR().topRows(Dim + 1).template triangularView<Eigen::Upper>();
  problem.target = demanded * R.inverse();
}

// The component of the boundary on which each control point lies, the one of the first vertex of
// the boundary first. \return their number
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
// the same for the gradients of all weights with the right boundary values, those of harmonic
// coordinates included. These sum to psi over the control points on the component.
template <int Dim>
void set_up_periods(GradientProblem<Dim>& problem) {
  const auto& mesh = problem.base.mesh;
  std::vector<Index> component;
  const Index count = number_components(problem.base, component);
  if (count == 1) return;
  const auto harmonic = harmonic_coordinates(problem.base);
  Eigen::MatrixXd indicator = Eigen::MatrixXd::Zero(harmonic.rows(), count - 1);
  for (std::size_t i = 0; i < component.size(); ++i) {
    if (component[i] > 0) indicator(static_cast<Eigen::Index>(i), component[i] - 1) = 1;
  }
  problem.periods.resize(
      static_cast<std::size_t>(count - 1),
      {PointList<Dim>(Dim, mesh.num_cells()), Eigen::RowVectorXd::Zero(harmonic.rows())});
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
                                           DistanceScheme phi) {
  GradientProblem<Dim> problem;
  problem.base = make_problem(cage, domain.mesh, std::move(domain.topology), phi);
  problem.base.cage = cage;
  problem.base.mesh = std::move(domain.mesh);
  problem.base.scale = 1;
  const auto& mesh = problem.base.mesh;
  problem.radius = problem.base.phi.dense();
  Eigen::VectorXd measures(mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) measures[s] = signed_measure(mesh, s);
  problem.radius *= measures.asDiagonal();
  problem.slope = boundary_slopes(problem.base);
  set_up_barycentric_conditions(problem);
  set_up_periods(problem);
  // As Method::kGradient chooses it; docs/method.md, section 7.
  constexpr double kFactor = Dim == 2 ? 1.0 / 3500 : 1.0 / 6000;
  const double length = std::pow(measures.squaredNorm() / measures.sum(), 1.0 / Dim);
  problem.penalty =
      kFactor * std::pow(bounding_box_diagonal(cage.points), 2) * std::pow(length, Dim - 1);
  return problem;
}

template GradientProblem<2> make_gradient_problem(const Cage<2>&, Domain<2>, DistanceScheme);
template GradientProblem<3> make_gradient_problem(const Cage<3>&, Domain<3>, DistanceScheme);

}  // namespace flbc::openmesh

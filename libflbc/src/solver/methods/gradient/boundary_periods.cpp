// SPDX-License-Identifier: BSD-3-Clause
#include "solver/methods/gradient/boundary_periods.h"

#include "base/union_find.h"
#include "mesh/cell_geometry.h"
#include "problem/laplacian.h"

namespace flbc::gradient {
namespace {

// The number of the boundary component of each boundary vertex, counted from 0.
template <int Dim>
std::vector<Index> number_components(const LbcProblem<Dim>& problem, Index& count) {
  const auto& boundary = problem.boundary;
  UnionFind sets(static_cast<Index>(boundary.vertices.size()));
  for (Index f = 0; f < problem.topology.num_facets(); ++f) {
    if (!problem.topology.is_boundary(f)) continue;
    for (int k = 1; k < Dim; ++k) {
      sets.unite(boundary.boundary_index[problem.topology.facets(0, f)],
                 boundary.boundary_index[problem.topology.facets(k, f)]);
    }
  }
  std::vector<Index> number(boundary.vertices.size(), -1);
  std::vector<Index> number_of_root(boundary.vertices.size(), -1);
  count = 0;
  for (std::size_t b = 0; b < number.size(); ++b) {
    Index& root = number_of_root[sets.find(static_cast<Index>(b))];
    if (root < 0) root = count++;
    number[b] = root;
  }
  return number;
}

// Field and right-hand side of one period from its harmonic function psi.
template <int Dim>
Period<Dim> make_period(const LbcProblem<Dim>& problem, const Eigen::RowVectorXd& psi) {
  const auto& mesh = problem.mesh;
  Period<Dim> period{PointList<Dim>(Dim, mesh.num_cells()),
                     Eigen::VectorXd::Zero(problem.num_control_points())};
  Eigen::VectorXd flux = Eigen::VectorXd::Zero(mesh.num_vertices());  // K psi
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    const auto geometry = cell_geometry(mesh, s);
    Vector<Dim> gradient = Vector<Dim>::Zero();
    for (int k = 0; k <= Dim; ++k)
      gradient += psi[mesh.cells(k, s)] * geometry.hat_gradients.col(k);
    period.field.col(s) = geometry.measure * gradient;
    for (int k = 0; k <= Dim; ++k) {
      flux[mesh.cells(k, s)] += geometry.hat_gradients.col(k).dot(period.field.col(s));
    }
  }
  for (std::size_t b = 0; b < problem.boundary.vertices.size(); ++b) {
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(problem.num_control_points());
    problem.boundary.scatter(static_cast<Index>(b), weights);
    period.values += flux[problem.boundary.vertices[b]] * weights;
  }
  const double norm = period.field.norm();
  period.field /= norm;
  period.values /= norm;
  return period;
}

}  // namespace

template <int Dim>
std::vector<Period<Dim>> boundary_periods(const LbcProblem<Dim>& problem, LinearSolver solver) {
  Index count = 0;
  const auto component = number_components(problem, count);
  if (count == 1) return {};
  Eigen::MatrixXd indicator = Eigen::MatrixXd::Zero(count - 1, component.size());
  for (std::size_t b = 0; b < component.size(); ++b) {
    if (component[b] > 0) indicator(component[b] - 1, b) = 1;
  }
  const auto psi = DirichletProblem<Dim>(problem.mesh, problem.boundary, solver).solve(indicator);
  std::vector<Period<Dim>> periods;
  periods.reserve(static_cast<std::size_t>(count - 1));
  for (Index p = 0; p < count - 1; ++p) periods.push_back(make_period(problem, psi.row(p)));
  return periods;
}

template std::vector<Period<2>> boundary_periods(const LbcProblem<2>&, LinearSolver);
template std::vector<Period<3>> boundary_periods(const LbcProblem<3>&, LinearSolver);

}  // namespace flbc::gradient

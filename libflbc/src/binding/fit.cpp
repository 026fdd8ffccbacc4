// SPDX-License-Identifier: BSD-3-Clause
// From points back to control points: the transpose of a deformation, and its inverse.
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "base/messages.h"
#include "base/shape_checks.h"
#include "flbc/binding.h"
#include "flbc/errors.h"

namespace flbc {
namespace {

// Sum over points of w_i times a column each.
// \param which  P'  \param columns  Dim x P'
template <int Dim>
PointList<Dim> transposed_product(const SparseWeights& weights, const std::vector<Index>& which,
                                  const PointList<Dim>& columns) {
  PointList<Dim> sums = PointList<Dim>::Zero(Dim, weights.num_control_points());
  for (std::size_t k = 0; k < which.size(); ++k) {
    weights.visit(which[k], [&](Index i, double w) { sums.col(i) += w * columns.col(k); });
  }
  return sums;
}

// W^T W of some points.
Eigen::MatrixXd normal_matrix(const SparseWeights& weights, const std::vector<Index>& which) {
  const Index n = weights.num_control_points();
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n, n);
  for (const Index p : which) {
    weights.visit(p, [&](Index i, double a) {
      weights.visit(p, [&](Index j, double b) { product(i, j) += a * b; });
    });
  }
  return product;
}

// The graph Laplacian of the edges of facets.
template <int Dim>
Eigen::MatrixXd laplacian(const Cage<Dim>& cage) {
  const Index n = cage.size();
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (const auto& facet : cage.facets.colwise()) {
    for (int k = 0; k < Dim; ++k) {
      matrix(facet[k], facet[(k + 1) % Dim]) = matrix(facet[(k + 1) % Dim], facet[k]) = -1;
    }
  }
  matrix.diagonal() = -matrix.rowwise().sum();
  return matrix;
}

std::vector<Index> all_of(Index count) {
  std::vector<Index> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

// \throws InputError unless all numbers are in [0, count), each once
void require_indices(const std::vector<Index>& numbers, Index count, const std::string& name) {
  std::vector<bool> is_there(static_cast<std::size_t>(count), false);
  for (const Index number : numbers) {
    if (number < 0 || number >= count) {
      throw InputError("fit: there is no " + name + " " + std::to_string(number));
    }
    if (is_there[number])
      throw InputError("fit: " + name + " " + std::to_string(number) + " twice");
    is_there[number] = true;
  }
}

}  // namespace

template <int Dim>
PointList<Dim> Binding<Dim>::adjoint(const PointList<Dim>& gradients) const {
  if (gradients.cols() != points.cols()) {
    throw InputError("there are gradients of " + std::to_string(gradients.cols()) +
                     " points, but the binding is of " + std::to_string(points.cols()));
  }
  check_finite<Dim>(gradients);
  PointList<Dim> sums = transposed_product<Dim>(weights, all_of(weights.num_points()), gradients);
  for (const Index i : held) sums.col(i).setZero();
  return sums;
}

template <int Dim>
Fit<Dim> Binding<Dim>::fit(const PointList<Dim>& targets, const FitOptions& options) const {
  const Index n = cage.size();
  if (!(options.stiffness >= 0 && std::isfinite(options.stiffness))) {
    throw OptionError("fit: the stiffness must be at least 0");
  }
  require_indices(options.points, weights.num_points(), "point");
  require_indices(options.held, n, "control point");
  const auto which = options.points.empty() ? all_of(weights.num_points()) : options.points;
  if (targets.cols() != static_cast<Eigen::Index>(which.size())) {
    throw InputError("fit: there are targets of " + std::to_string(targets.cols()) +
                     " points, but " + std::to_string(which.size()) + " points");
  }
  check_finite<Dim>(targets);
  std::vector<bool> is_held(static_cast<std::size_t>(n), false);
  for (const auto* list : {&held, &options.held}) {
    for (const Index i : *list) is_held[i] = true;
  }
  std::vector<Index> free;
  for (Index i = 0; i < n; ++i) {
    if (!is_held[i]) free.push_back(i);
  }
  Fit<Dim> result{cage.points};
  const PointList<Dim> moves = targets - rest()(Eigen::all, which);
  if (!free.empty()) {
    Eigen::MatrixXd matrix = normal_matrix(weights, which);
    if (options.stiffness > 0) {
      const double lambda = options.stiffness * matrix.diagonal().mean();
      matrix += lambda * laplacian(cage);
    }
    const Eigen::MatrixXd system = matrix(free, free);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(system);
    const auto& values = solver.eigenvalues();
    constexpr double kSingular = 1e-13;
    if (!(values[0] > kSingular * values[values.size() - 1])) {
      Eigen::Index loosest = 0;
      solver.eigenvectors().col(0).cwiseAbs().maxCoeff(&loosest);
      throw InputError("fit: the targets do not determine control point " +
                       std::to_string(free[loosest]) +
                       "; give targets of more points, hold it, or add stiffness");
    }
    result.condition = values[values.size() - 1] / values[0];
    const PointList<Dim> sums = transposed_product<Dim>(weights, which, moves);
    const Eigen::MatrixXd found = system.ldlt().solve(sums(Eigen::all, free).transpose());
    for (std::size_t k = 0; k < free.size(); ++k) {
      result.control_points.col(free[k]) += found.row(k).transpose();
    }
  }
  const PointList<Dim> shift = result.control_points - cage.points;
  double sum = 0;
  for (std::size_t k = 0; k < which.size(); ++k) {
    Vector<Dim> missing = moves.col(k);
    weights.visit(which[k], [&](Index i, double w) { missing -= w * shift.col(i); });
    sum += missing.squaredNorm();
    if (result.worst >= 0 && missing.norm() <= result.largest) continue;
    result.largest = missing.norm();
    result.worst = which[k];
  }
  if (!which.empty()) result.rms = std::sqrt(sum / static_cast<double>(which.size()));
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                 \
  template PointList<Dim> Binding<Dim>::adjoint(const PointList<Dim>&) const; \
  template Fit<Dim> Binding<Dim>::fit(const PointList<Dim>&, const FitOptions&) const;
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

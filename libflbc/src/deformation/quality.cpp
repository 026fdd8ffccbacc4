// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/bounding_box.h"
#include "mesh/cell_geometry.h"

namespace flbc {
namespace {

// Sums of the gradients of weights in cells.
template <int Dim>
class SparseGradients {
 public:
  explicit SparseGradients(Index num_control_points)
      : gradients_(GradientRows::Zero(num_control_points, Dim)),
        is_touched_(num_control_points, 0) {}

  // Adds the gradients in cell s times a factor.
  void add(const DomainMesh<Dim>& mesh, Index s, const CellGeometry<Dim>& geometry,
           const SparseWeights& weights, double factor = 1) {
    for (int k = 0; k <= Dim; ++k) {
      const RowVector hat = factor * geometry.hat_gradients.col(k).transpose();
      weights.visit(mesh.cells(k, s), [&](Index i, double weight) {
        gradients_.row(i) += weight * hat;
        if (!is_touched_[i]) touched_.push_back(i);
        is_touched_[i] = 1;
      });
    }
  }

  // Calls action(i, sum for w_i) for the control points with a nonzero weight at a corner, and
  // starts over.
  template <class Action>
  void take(const Action& action) {
    for (const Index i : touched_) {
      action(i, gradients_.row(i));
      gradients_.row(i).setZero();
      is_touched_[i] = 0;
    }
    touched_.clear();
  }

 private:
  using RowVector = Eigen::Matrix<double, 1, Dim>;
  using GradientRows = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::RowMajor>;
  GradientRows gradients_;        // zero unless touched
  std::vector<char> is_touched_;  // by control point
  std::vector<Index> touched_;
};

// sum_s A_s sum_i f(i, s, grad w_i).
template <int Dim, class Function>
double integrate_gradients(const DomainMesh<Dim>& mesh, const SparseWeights& weights,
                           const Function& function) {
  check_indices(mesh.cells, mesh.num_vertices(), kMeshNames);
  check_size(weights, weights.num_control_points(), mesh.num_vertices());
  return parallel_sum(mesh.num_cells(), 0.0, [&](Index begin, Index end) {
    SparseGradients<Dim> gradients(weights.num_control_points());
    double sum = 0;
    for (Index s = begin; s < end; ++s) {
      const auto geometry = cell_geometry(mesh, s);
      gradients.add(mesh, s, geometry, weights);
      gradients.take([&](Index i, const auto& gradient) {
        sum += geometry.measure * function(i, s, gradient);
      });
    }
    return sum;
  });
}

}  // namespace

template <int Dim>
Quality measure_quality(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const SparseWeights& weights) {
  check_size(weights, control_points.cols(), points.cols());
  const double size = bounding_box_diagonal(control_points);
  Quality quality;
  quality.min_weight = std::numeric_limits<double>::max();
  for (Index p = 0; p < static_cast<Index>(points.cols()); ++p) {
    Vector<Dim> error = -points.col(p);
    double sum = 0;
    if (weights.count(p) < control_points.cols()) {
      quality.min_weight = std::min(quality.min_weight, 0.0);
    }
    weights.visit(p, [&](Index i, double weight) {
      error += weight * control_points.col(i);
      sum += weight;
      quality.min_weight = std::min(quality.min_weight, weight);
      quality.mean_influences += std::abs(weight) > kInfluenceThreshold ? 1 : 0;
    });
    if (!weights.has_weights(p)) continue;
    quality.max_partition_error = std::max(quality.max_partition_error, std::abs(sum - 1));
    quality.max_reproduction_error = std::max(quality.max_reproduction_error, error.norm() / size);
  }
  if (points.cols() == 0 || control_points.cols() == 0) quality.min_weight = 0;
  if (points.cols() > 0) quality.mean_influences /= static_cast<double>(points.cols());
  return quality;
}

template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const WeightFunctions& phi,
                 const SparseWeights& weights, double smoothness) {
  check_phi(phi, weights.num_control_points(), mesh.num_cells());
  return integrate_gradients(mesh, weights, [&](Index i, Index s, const auto& gradient) {
    return phi(i, s) * gradient.norm() + smoothness / 2 * gradient.squaredNorm();
  });
}

template <int Dim>
double total_variation(const DomainMesh<Dim>& mesh, const SparseWeights& weights) {
  return integrate_gradients(mesh, weights,
                             [](Index, Index, const auto& gradient) { return gradient.norm(); });
}

template <int Dim>
double gradient_jump(const LbcProblem<Dim>& problem, const SparseWeights& weights) {
  check_size(weights, problem.num_control_points(), problem.mesh.num_vertices());
  const auto& mesh = problem.mesh;
  const auto& topology = problem.topology;
  const auto sums = parallel_sum(
      topology.num_facets(), Eigen::Array2d::Zero().eval(), [&](Index begin, Index end) {
        SparseGradients<Dim> jump(weights.num_control_points());
        Eigen::Array2d sum = Eigen::Array2d::Zero();
        for (Index f = begin; f < end; ++f) {
          if (topology.is_boundary(f)) continue;
          const auto [first, second] = std::pair(topology.sides(0, f), topology.sides(1, f));
          const auto geometry = cell_geometry(mesh, first);
          int opposite = 0;
          while (topology.cell_facets(opposite, first) != f) ++opposite;
          const double measure =
              Dim * geometry.measure * geometry.hat_gradients.col(opposite).norm();
          jump.add(mesh, first, geometry, weights);
          jump.add(mesh, second, cell_geometry(mesh, second), weights, -1);
          double jump2 = 0;
          jump.take([&](Index, const auto& gradient) { jump2 += gradient.squaredNorm(); });
          sum += measure * Eigen::Array2d(1, jump2);
        }
        return sum;
      });
  if (sums[0] == 0) return 0;
  return std::sqrt(sums[1] / sums[0]) * bounding_box_diagonal(problem.cage.points);
}

template <int Dim>
double squared_error(const LbcProblem<Dim>& problem, const SparseWeights& a,
                     const SparseWeights& b) {
  check_size(a, problem.num_control_points(), problem.mesh.num_vertices());
  check_size(b, problem.num_control_points(), problem.mesh.num_vertices());
  double sum = 0;
  const auto interior = problem.boundary.interior_vertices();
  for (const Index v : interior) sum += (a.at(v) - b.at(v)).squaredNorm();
  if (interior.empty()) return 0;
  return sum / (static_cast<double>(interior.size()) * problem.num_control_points());
}

FLBC_INSTANTIATE_FUNCTION(measure_quality)
template double objective(const DomainMesh<2>&, const WeightFunctions&, const SparseWeights&,
                          double);
template double objective(const DomainMesh<3>&, const WeightFunctions&, const SparseWeights&,
                          double);
FLBC_INSTANTIATE_FUNCTION(gradient_jump)
FLBC_INSTANTIATE_FUNCTION(total_variation)
FLBC_INSTANTIATE_FUNCTION(squared_error)

}  // namespace flbc

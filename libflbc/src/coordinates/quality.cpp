// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/quality.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/weight_columns.h"
#include "coordinates/mean_count.h"
#include "flbc/bounding_box.h"
#include "mesh/cell_geometry.h"

namespace flbc {
namespace {

// sum_s A_s f(s, |grad w|_s), where |grad w|_s has one entry per control point.
template <int Dim, class Function>
double integrate_gradient_lengths(const DomainMesh<Dim>& mesh, const WeightMatrix& weights,
                                  const Function& function) {
  return parallel_sum(mesh.num_cells(), 0.0, [&](Index begin, Index end) {
    double sum = 0;
    for (Index s = begin; s < end; ++s) {
      const auto geometry = cell_geometry(mesh, s);
      const auto gradients = weight_gradients(mesh, s, geometry, weights);
      sum += geometry.measure * function(s, gradients.rowwise().norm());
    }
    return sum;
  });
}

// Gradients of the nonzero weights of a cell.
template <int Dim>
class SparseGradients {
 public:
  explicit SparseGradients(Index num_control_points)
      : gradients_(GradientRows::Zero(num_control_points, Dim)),
        is_touched_(num_control_points, 0) {}

  // Calls action(i, grad w_i) for the control points with a nonzero weight at a corner.
  template <class Action>
  void visit(const DomainMesh<Dim>& mesh, Index s, const CellGeometry<Dim>& geometry,
             const SparseWeights& weights, const Action& action) {
    for (int k = 0; k <= Dim; ++k) {
      const Index v = mesh.cells(k, s);
      weights.visit(v, [&](Index i, double weight) {
        gradients_.row(i) += weight * geometry.hat_gradients.col(k).transpose();
        if (!is_touched_[i]) touched_.push_back(i);
        is_touched_[i] = 1;
      });
    }
    for (const Index i : touched_) {
      action(i, gradients_.row(i));
      gradients_.row(i).setZero();
      is_touched_[i] = 0;
    }
    touched_.clear();
  }

 private:
  using GradientRows = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::RowMajor>;
  GradientRows gradients_;        // zero except during a visit
  std::vector<char> is_touched_;  // by control point
  std::vector<Index> touched_;
};

}  // namespace

template <int Dim, class Weights>
Quality measure_quality(const PointList<Dim>& control_points, const PointList<Dim>& points,
                        const Weights& weights) {
  check_size(weights, control_points.cols(), points.cols());
  const double size = bounding_box_diagonal(control_points);
  Quality quality;
  quality.min_weight = std::numeric_limits<double>::max();
  MeanCount influences;
  for (Index p = 0; p < static_cast<Index>(points.cols()); ++p) {
    const auto& column = column_of(weights, p);
    const Vector<Dim> error = control_points * column - points.col(p);
    if (column.size() > 0) quality.min_weight = std::min(quality.min_weight, column.minCoeff());
    quality.max_partition_error = std::max(quality.max_partition_error, std::abs(column.sum() - 1));
    quality.max_reproduction_error = std::max(quality.max_reproduction_error, error.norm() / size);
    influences.add(static_cast<Index>((column.array().abs() > kInfluenceThreshold).count()));
  }
  if (points.cols() == 0 || control_points.cols() == 0) quality.min_weight = 0;
  quality.mean_influences = influences.value();
  return quality;
}

template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const WeightFunctions& phi,
                 const WeightMatrix& weights, double smoothness) {
  return integrate_gradient_lengths(mesh, weights, [&](Index s, const auto& lengths) {
    const double variation = phi.col(s).dot(lengths);
    return smoothness > 0 ? variation + smoothness / 2 * lengths.squaredNorm() : variation;
  });
}

template <int Dim>
double objective(const DomainMesh<Dim>& mesh, const WeightFunctions& phi,
                 const SparseWeights& weights, double smoothness) {
  return parallel_sum(mesh.num_cells(), 0.0, [&](Index begin, Index end) {
    SparseGradients<Dim> gradients(weights.num_control_points());
    double sum = 0;
    for (Index s = begin; s < end; ++s) {
      const auto geometry = cell_geometry(mesh, s);
      gradients.visit(mesh, s, geometry, weights, [&](Index i, const auto& gradient) {
        sum += geometry.measure *
               (phi(i, s) * gradient.norm() + smoothness / 2 * gradient.squaredNorm());
      });
    }
    return sum;
  });
}

template <int Dim>
double total_variation(const DomainMesh<Dim>& mesh, const WeightMatrix& weights) {
  return integrate_gradient_lengths(mesh, weights,
                                    [](Index, const auto& lengths) { return lengths.sum(); });
}

template <int Dim>
double gradient_jump(const LbcProblem<Dim>& problem, const WeightMatrix& weights) {
  check_size(weights, problem.num_control_points(), problem.mesh.num_vertices());
  const auto& mesh = problem.mesh;
  const auto& topology = problem.topology;
  const auto sums = parallel_sum(
      topology.num_facets(), Eigen::Array2d::Zero().eval(), [&](Index begin, Index end) {
        Eigen::Array2d sum = Eigen::Array2d::Zero();
        for (Index f = begin; f < end; ++f) {
          if (topology.is_boundary(f)) continue;
          const auto [first, second] = std::pair(topology.sides(0, f), topology.sides(1, f));
          const auto geometry = cell_geometry(mesh, first);
          int opposite = 0;
          while (topology.cell_facets(opposite, first) != f) ++opposite;
          const double measure =
              Dim * geometry.measure * geometry.hat_gradients.col(opposite).norm();
          const double jump2 =
              (weight_gradients(mesh, first, geometry, weights) -
               weight_gradients(mesh, second, cell_geometry(mesh, second), weights))
                  .squaredNorm();
          sum += measure * Eigen::Array2d(1, jump2);
        }
        return sum;
      });
  if (sums[0] == 0) return 0;
  return std::sqrt(sums[1] / sums[0]) * bounding_box_diagonal(problem.cage.points);
}

template <int Dim>
double squared_error(const LbcProblem<Dim>& problem, const WeightMatrix& a, const WeightMatrix& b) {
  check_size(a, problem.num_control_points(), problem.mesh.num_vertices());
  check_size(b, problem.num_control_points(), problem.mesh.num_vertices());
  double sum = 0;
  const auto interior = problem.boundary.interior_vertices();
  for (const Index v : interior) sum += (a.col(v) - b.col(v)).squaredNorm();
  if (interior.empty()) return 0;
  return sum / (static_cast<double>(interior.size()) * static_cast<double>(a.rows()));
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template Quality measure_quality(const PointList<Dim>&, const PointList<Dim>&,                  \
                                   const WeightMatrix&);                                          \
  template Quality measure_quality(const PointList<Dim>&, const PointList<Dim>&,                  \
                                   const SparseWeights&);                                         \
  template double objective(const DomainMesh<Dim>&, const WeightFunctions&, const WeightMatrix&,  \
                            double);                                                              \
  template double objective(const DomainMesh<Dim>&, const WeightFunctions&, const SparseWeights&, \
                            double);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE
FLBC_INSTANTIATE_FUNCTION(gradient_jump)
FLBC_INSTANTIATE_FUNCTION(total_variation)
FLBC_INSTANTIATE_FUNCTION(squared_error)

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "polytope/project_columns.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <string>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "polytope/nearest_point_in_hull.h"
#include "polytope/weight_projection.h"

namespace flbc {
namespace {

void require_finite(const Eigen::VectorXd& point, const char* what, Index number) {
  if (point.allFinite()) return;
  throw InputError(what + std::to_string(number) + " is not finite: " + format_point(point));
}

template <int Dim>
void check_input(const PointList<Dim>& control_points, const PointList<Dim>& points,
                 const std::vector<Index>& columns) {
  if (control_points.cols() == 0) throw InputError("there are no control points");
  for (Eigen::Index i = 0; i < control_points.cols(); ++i) {
    require_finite(control_points.col(i), "control point ", static_cast<Index>(i));
  }
  for (const Index column : columns) {
    if (column < 0 || column >= points.cols()) {
      throw InputError("point " + std::to_string(column) +
                       " of the weights does not exist: there are " +
                       std::to_string(points.cols()));
    }
    require_finite(points.col(column), "point ", column);
  }
}

// Projects columns, and notes the first that failed: exceptions cannot leave a parallel loop.
template <int Dim>
class ColumnProjection {
 public:
  ColumnProjection(const PointList<Dim>& control_points, const PointList<Dim>& points,
                   const PointMasks& masks, double negligible)
      : control_points_(control_points),
        points_(points),
        masks_(masks),
        negligible_(negligible),
        projection_(control_points),
        works_(omp_get_max_threads()),
        infinite_(static_cast<Index>(points.cols())),
        outside_(static_cast<Index>(points.cols())) {}

  void operator()(Index point, Eigen::VectorXd& column) {
    if (!column.allFinite()) return lower_to(infinite_, point);
    // Only the first failure is reported, so later columns can be skipped.
    if (outside_.load(std::memory_order_relaxed) < point) return;
    if (negligible_ > 0 && project_on_large(point, column)) return;
    if (masks_.at(point)) return project_masked(point, column);
    auto& work = works_[omp_get_thread_num()];
    if (!work) work.emplace(projection_);
    if (projection_.project(points_.col(point), column, *work) > 0) lower_to(outside_, point);
  }

  void throw_first_failure() const {
    if (const Index point = infinite_; point < points_.cols()) {
      throw InputError("a weight of point " + std::to_string(point) + " at " +
                       format_point(points_.col(point)) + " is not finite");
    }
    const Index point = outside_;
    if (point == points_.cols()) return;
    const PointList<Dim> carriers =
        masks_.at(point) ? control_points_(Eigen::all, masks_.allowed(point)) : control_points_;
    if (carriers.cols() == 0) {
      throw InputError("all control points are masked at point " + std::to_string(point) + " at " +
                       format_point(points_.col(point)) + ", but its weights must sum to 1");
    }
    const auto nearest = nearest_point_in_hull<Dim>(carriers, points_.col(point));
    throw InputError("point " + std::to_string(point) + " at " + format_point(points_.col(point)) +
                     " lies outside the convex hull of the control points " +
                     (masks_.at(point) ? "that may move it by " : "by ") +
                     format_number(nearest.distance) + ": no weights >= 0 reproduce it");
  }

 private:
  // \return false if the control points with large weights cannot carry the point with nearly the
  // same weights
  bool project_on_large(Index point, Eigen::VectorXd& column) const {
    constexpr double kMostChange = 10;  // mean square, relative to that of negligible weights
    std::vector<Index> large;
    for (Index i = 0; i < static_cast<Index>(column.size()); ++i) {
      if (column[i] < negligible_ || (masks_.at(point) && masks_.forbids(point, i))) continue;
      large.push_back(i);
    }
    Eigen::VectorXd few;
    if (large.empty() || !projection_.project(points_.col(point), large, column, few)) return false;
    const double mean_square = (few - column).squaredNorm() / static_cast<double>(column.size());
    if (mean_square > kMostChange * negligible_ * negligible_) return false;
    column = few;
    return true;
  }

  void project_masked(Index point, Eigen::VectorXd& column) {
    const auto allowed = masks_.allowed(point);
    if (allowed.empty()) return lower_to(outside_, point);
    const WeightProjection<Dim> projection(control_points_(Eigen::all, allowed));
    typename WeightProjection<Dim>::Workspace work(projection);
    Eigen::VectorXd few = column(allowed);
    if (projection.project(points_.col(point), few, work) > 0) return lower_to(outside_, point);
    column.setZero();
    column(allowed) = few;
  }

  static void lower_to(std::atomic<Index>& least, Index number) {
    Index current = least.load();
    while (number < current && !least.compare_exchange_weak(current, number)) {
    }
  }

  const PointList<Dim>& control_points_;
  const PointList<Dim>& points_;
  const PointMasks& masks_;
  double negligible_;
  const WeightProjection<Dim> projection_;
  std::vector<std::optional<typename WeightProjection<Dim>::Workspace>> works_;  // by thread
  std::atomic<Index> infinite_, outside_;
};

std::vector<Index> numbers_of(const std::optional<std::vector<Index>>& columns,
                              Eigen::Index num_points) {
  if (columns) return *columns;
  std::vector<Index> all(static_cast<std::size_t>(num_points));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

template <int Dim>
SparseWeights project_columns(const PointList<Dim>& control_points, const PointList<Dim>& points,
                              const std::vector<Index>& columns,
                              const std::function<Eigen::VectorXd(Index)>& weights_of,
                              const PointMasks& masks, double negligible) {
  check_input(control_points, points, columns);
  std::vector<char> is_projected(static_cast<std::size_t>(points.cols()), 0);
  for (const Index p : columns) is_projected[p] = 1;
  ColumnProjection<Dim> project(control_points, points, masks, negligible);
  LoopProgress progress(static_cast<Index>(columns.size()));
  auto result = SparseWeights::of(static_cast<Index>(control_points.cols()),
                                  static_cast<Index>(points.cols()), [&](Index p) {
                                    auto column = weights_of(p);
                                    if (is_projected[p]) {
                                      project(p, column);
                                      progress.add(1);
                                    }
                                    return column;
                                  });
  project.throw_first_failure();
  return result;
}

template <int Dim>
SparseWeights project_non_negative(const PointList<Dim>& control_points,
                                   const PointList<Dim>& points, const SparseWeights& weights,
                                   const std::optional<std::vector<Index>>& some,
                                   const PointMasks& masks) {
  check_size(weights, control_points.cols(), points.cols());
  auto numbers = numbers_of(some, points.cols());
  const auto is_still = [&](Index p) {
    return p >= 0 && p < weights.num_points() && !weights.has_weights(p);
  };
  numbers.erase(std::remove_if(numbers.begin(), numbers.end(), is_still), numbers.end());
  const auto projected = project_columns<Dim>(
      control_points, points, numbers, [&](Index p) { return weights.at(p); }, masks);
  return projected == weights ? weights : projected;  // one copy of the entries
}

FLBC_INSTANTIATE_FUNCTION(project_columns)
FLBC_INSTANTIATE_FUNCTION(project_non_negative)

}  // namespace flbc

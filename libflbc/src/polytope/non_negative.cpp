// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/non_negative.h"

#include <atomic>
#include <numeric>
#include <string>

#include <Eigen/SparseCore>

#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "base/stage_progress.h"
#include "flbc/errors.h"
#include "polytope/nearest_point_in_hull.h"
#include "polytope/weight_projection.h"

namespace flbc {
namespace {

void require_finite(const Eigen::VectorXd& point, const char* what, Index number) {
  if (point.allFinite()) return;
  throw InputError(what + std::to_string(number) + " is not finite: " + format_point(point));
}

// \param weights_of  returns the weights of a point
template <int Dim, class WeightsOf>
void check_input(const PointList<Dim>& control_points, const PointList<Dim>& points,
                 const WeightsOf& weights_of, const std::vector<Index>& columns) {
  if (control_points.cols() == 0) throw InputError("there are no control points");
  for (Eigen::Index i = 0; i < control_points.cols(); ++i) {
    require_finite(control_points.col(i), "control point ", static_cast<Index>(i));
  }
  for (const Index column : columns) {
    if (column < 0 || column >= points.cols()) {
      throw InputError("column " + std::to_string(column) +
                       " of the weights does not exist: there are " +
                       std::to_string(points.cols()));
    }
    require_finite(points.col(column), "point ", column);
    if (!weights_of(column).allFinite()) {
      throw InputError("a weight of point " + std::to_string(column) + " at " +
                       format_point(points.col(column)) + " is not finite");
    }
  }
}

// \param weights_of  returns the weights of a point \param replace  called with the position of a
// column in `columns` and its new weights
template <int Dim, class WeightsOf, class Replace>
void project_columns(const PointList<Dim>& control_points, const PointList<Dim>& points,
                     const std::vector<Index>& columns, const WeightsOf& weights_of,
                     const Replace& replace) {
  check_input(control_points, points, weights_of, columns);
  const WeightProjection<Dim> projection(control_points);
  const auto count = static_cast<Index>(columns.size());
  std::atomic<Index> outside{static_cast<Index>(points.cols())};
  LoopProgress progress(count);
  const auto make_work = [&] { return typename WeightProjection<Dim>::Workspace(projection); };
  parallel_for_chunks(count, 64, make_work, [&](Index k, auto& work) {
    const Index point = columns[k];
    progress.add(1);
    // Only the first failure is reported, so later columns can be skipped.
    if (outside.load(std::memory_order_relaxed) < point) return;
    Eigen::VectorXd column = weights_of(point);
    if (projection.project(points.col(point), column, work) > 0) {
      lower_to(outside, point);
    } else {
      replace(k, column);
    }
  });
  const Index point = outside.load();
  if (point == points.cols()) return;
  throw InputError(
      "point " + std::to_string(point) + " at " + format_point(points.col(point)) +
      " lies outside the convex hull of the control points by " +
      format_number(nearest_point_in_hull<Dim>(control_points, points.col(point)).distance) +
      ": no weights >= 0 reproduce it");
}

std::vector<Index> numbers_of(const std::optional<std::vector<Index>>& columns,
                              Eigen::Index num_points) {
  if (columns) return *columns;
  std::vector<Index> all(static_cast<std::size_t>(num_points));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

template <int Dim>
void project_non_negative(const PointList<Dim>& control_points, const PointList<Dim>& points,
                          WeightMatrix& weights, const std::optional<std::vector<Index>>& some) {
  check_size(weights, control_points.cols(), points.cols());
  const auto columns = numbers_of(some, points.cols());
  project_columns(
      control_points, points, columns, [&](Index p) { return weights.col(p); },
      [&](Index k, const Eigen::VectorXd& column) { weights.col(columns[k]) = column; });
}

template <int Dim>
SparseWeights project_non_negative(const PointList<Dim>& control_points,
                                   const PointList<Dim>& points, const SparseWeights& weights,
                                   const std::optional<std::vector<Index>>& some) {
  check_size(weights, control_points.cols(), points.cols());
  const auto columns = numbers_of(some, points.cols());
  std::vector<Eigen::SparseVector<double>> projected(columns.size());
  project_columns(
      control_points, points, columns, [&](Index p) { return weights.at(p); },
      [&](Index k, const Eigen::VectorXd& column) { projected[k] = column.sparseView(); });
  std::vector<Index> place(points.cols(), -1);
  for (std::size_t k = 0; k < columns.size(); ++k) place[columns[k]] = static_cast<Index>(k);
  return SparseWeights::of(weights.num_control_points(), weights.num_points(), [&](Index p) {
    return place[p] < 0 ? weights.at(p) : Eigen::VectorXd(projected[place[p]]);
  });
}

#define FLBC_INSTANTIATE(Dim)                                                                     \
  template void project_non_negative(const PointList<Dim>&, const PointList<Dim>&, WeightMatrix&, \
                                     const std::optional<std::vector<Index>>&);                   \
  template SparseWeights project_non_negative(const PointList<Dim>&, const PointList<Dim>&,       \
                                              const SparseWeights&,                               \
                                              const std::optional<std::vector<Index>>&);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

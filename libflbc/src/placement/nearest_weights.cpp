// SPDX-License-Identifier: BSD-3-Clause
#include "placement/nearest_weights.h"

#include <string>
#include <vector>

#include "base/instantiate.h"
#include "base/messages.h"
#include "base/parallel.h"
#include "base/shape_checks.h"
#include "flbc/errors.h"
#include "placement/nearest_simplex.h"

namespace flbc {
namespace {

template <int Dim>
void check_input(const ModelElements<Dim>& from, const SparseWeights& weights) {
  check_size(weights, weights.num_control_points(), from.points.cols());
  check_finite<Dim>(from.points);
  if (from.corners.cols() == 0) throw InputError("the model that has weights is empty");
  for (Eigen::Index e = 0; e < from.corners.cols(); ++e) {
    for (const Index corner : from.corners.col(e)) {
      if (corner >= 0 && corner < from.points.cols()) continue;
      throw InputError("element " + std::to_string(e) + " has a corner " + std::to_string(corner) +
                       ", but the model has " + std::to_string(from.points.cols()) + " vertices");
    }
  }
}

template <int Dim>
void refuse_unmatched(const PointList<Dim>& to, const Eigen::VectorXd& distances, double limit) {
  std::vector<Index> unmatched;
  for (Index p = 0; p < to.cols(); ++p) {
    if (!(distances[p] <= limit)) unmatched.push_back(p);
  }
  if (unmatched.empty()) return;
  Eigen::Index farthest = 0;
  distances.maxCoeff(&farthest);
  throw InputError(
      std::to_string(unmatched.size()) + " of " + std::to_string(to.cols()) + " vertices (" +
      describe_list(unmatched) + ") are farther than " + format_number(limit) +
      " from the model that has weights; the farthest is vertex " + std::to_string(farthest) +
      " at " + format_point(to.col(farthest)) + ", by " + format_number(distances[farthest]));
}

}  // namespace

template <int Dim>
SparseWeights nearest_weights(const ModelElements<Dim>& from, const SparseWeights& weights,
                              const PointList<Dim>& to, double limit, Eigen::VectorXd* distances) {
  check_input(from, weights);
  check_finite<Dim>(to);
  const NearestSimplex<Dim, 3> nearest(from.points, from.corners);
  const auto num_points = static_cast<Index>(to.cols());
  Eigen::VectorXd found(num_points);
  auto result = SparseWeights::of(weights.num_control_points(), num_points, [&](Index p) {
    HullPoint<Dim> place;
    const Index element = nearest(to.col(p), place);
    found[p] = place.distance;
    Eigen::VectorXd row = Eigen::VectorXd::Zero(weights.num_control_points());
    for (int k = 0; k < place.size; ++k) {
      weights.visit(from.corners(place.support[k], element),
                    [&](Index i, double weight) { row[i] += place.weights[k] * weight; });
    }
    return row;
  });
  refuse_unmatched(to, found, limit);
  if (distances != nullptr) *distances = std::move(found);
  return result;
}

FLBC_INSTANTIATE_FUNCTION(nearest_weights)

}  // namespace flbc

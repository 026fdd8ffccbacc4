// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/transfer_weights.h"

#include <string>
#include <vector>

#include "base/messages.h"
#include "base/shape_checks.h"
#include "coordinates/box_tree.h"
#include "flbc/errors.h"
#include "flbc/non_negative.h"
#include "polytope/nearest_point_in_hull.h"

namespace flbc {
namespace {

template <int Dim>
void check_input(const PointList<Dim>& control_points, const ModelElements<Dim>& from,
                 const WeightMatrix& weights) {
  check_size(weights, control_points.cols(), from.points.cols());
  if (from.corners.cols() == 0) throw InputError("the model has nothing to be near to");
  for (Eigen::Index e = 0; e < from.corners.cols(); ++e) {
    for (const Index corner : from.corners.col(e)) {
      if (corner >= 0 && corner < from.points.cols()) continue;
      throw InputError("element " + std::to_string(e) + " has a corner " + std::to_string(corner) +
                       ", but the model has " + std::to_string(from.points.cols()) + " vertices");
    }
  }
}

// Finds the place of a model that is nearest to a point.
template <int Dim>
class NearestPlace {
 public:
  explicit NearestPlace(const ModelElements<Dim>& model)
      : model_(model), tree_(extreme(false), extreme(true)) {}

  // \param place  its weights are for the element's corners \return the element
  Index operator()(const Vector<Dim>& point, HullPoint<Dim>& place) const {
    const Index element = tree_.nearest(
        point, [&](Index e) { return nearest_point_in_hull<Dim>(corners(e), point).distance; });
    place = nearest_point_in_hull<Dim>(corners(element), point);
    return element;
  }

 private:
  PointList<Dim> corners(Index element) const {
    PointList<Dim> corners(Dim, 3);
    for (int k = 0; k < 3; ++k) corners.col(k) = model_.points.col(model_.corners(k, element));
    return corners;
  }
  PointList<Dim> extreme(bool high) const {
    PointList<Dim> extremes(Dim, model_.corners.cols());
    for (Index e = 0; e < model_.corners.cols(); ++e) {
      if (high) {
        extremes.col(e) = corners(e).rowwise().maxCoeff();
      } else {
        extremes.col(e) = corners(e).rowwise().minCoeff();
      }
    }
    return extremes;
  }

  const ModelElements<Dim>& model_;
  BoxTree<Dim> tree_;
};

template <int Dim>
void refuse_unmatched(const PointList<Dim>& to, const Eigen::VectorXd& distances, double limit) {
  std::vector<Index> unmatched;
  for (Index p = 0; p < to.cols(); ++p) {
    if (!(distances[p] <= limit)) unmatched.push_back(p);
  }
  if (unmatched.empty()) return;
  Eigen::Index farthest = 0;
  distances.maxCoeff(&farthest);
  std::string numbers;
  constexpr std::size_t kNamed = 10;
  for (std::size_t k = 0; k < std::min(kNamed, unmatched.size()); ++k) {
    numbers += (k > 0 ? ", " : "") + std::to_string(unmatched[k]);
  }
  if (unmatched.size() > kNamed) numbers += " ...";
  throw InputError(std::to_string(unmatched.size()) + " of " + std::to_string(to.cols()) +
                   " vertices (" + numbers + ") are farther than " + format_number(limit) +
                   " from the model that has weights; the farthest is vertex " +
                   std::to_string(farthest) + " at " + format_point(to.col(farthest)) + ", by " +
                   format_number(distances[farthest]));
}

}  // namespace

template <int Dim>
WeightMatrix transfer_weights(const PointList<Dim>& control_points, const ModelElements<Dim>& from,
                              const WeightMatrix& weights, const PointList<Dim>& to, double limit,
                              Eigen::VectorXd* distances) {
  check_input(control_points, from, weights);
  const NearestPlace<Dim> nearest(from);
  const auto num_points = static_cast<Index>(to.cols());
  WeightMatrix result = WeightMatrix::Zero(weights.rows(), num_points);
  Eigen::VectorXd found(num_points);
#pragma omp parallel for schedule(dynamic, 64)
  for (Index p = 0; p < num_points; ++p) {
    HullPoint<Dim> place;
    const Index element = nearest(to.col(p), place);
    found[p] = place.distance;
    for (int k = 0; k < place.size; ++k) {
      result.col(p) += place.weights[k] * weights.col(from.corners(place.support[k], element));
    }
  }
  refuse_unmatched(to, found, limit);
  project_non_negative(control_points, to, result);
  if (distances != nullptr) *distances = std::move(found);
  return result;
}

#define FLBC_INSTANTIATE(Dim)                                                                 \
  template WeightMatrix transfer_weights(const PointList<Dim>&, const ModelElements<Dim>&,    \
                                         const WeightMatrix&, const PointList<Dim>&, double, \
                                         Eigen::VectorXd*);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

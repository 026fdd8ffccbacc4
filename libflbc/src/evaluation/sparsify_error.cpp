// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/sparsify_error.h"

#include <algorithm>
#include <cmath>

#include "base/instantiate.h"
#include "base/parallel.h"
#include "base/shape_checks.h"

namespace flbc {
namespace {

// Calls action(i, after - before) for each control point that either has at the point.
template <class Action>
void visit_difference(const SparseWeights& before, const SparseWeights& after, Index point,
                      const Action& action) {
  const auto &from = before.control_points(), &to = after.control_points();
  auto k = before.starts()[point], l = after.starts()[point];
  const auto end = before.starts()[point + 1], last = after.starts()[point + 1];
  while (k < end || l < last) {
    const bool takes_before = k < end && (l == last || from[k] <= to[l]);
    const bool takes_after = l < last && (k == end || to[l] <= from[k]);
    const auto i = takes_before ? from[k] : to[l];
    const double difference = (takes_after ? after.values()[l++] : 0);
    action(static_cast<Index>(i), difference - (takes_before ? before.values()[k++] : 0));
  }
}

// Displacements by the differences in every pose. All poses at once, because finding the
// differences takes longer than multiplying them.
template <int Dim>
class Displacements {
 public:
  Displacements(const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                const SparseWeights& after)
      : before_(before),
        after_(after),
        control_points_(Dim * poses.size(), before.num_control_points()) {
    check_size(before, after.num_control_points(), after.num_points());
    check_poses<Dim>(poses, before.num_control_points());
    for (std::size_t k = 0; k < poses.size(); ++k) {
      control_points_.middleRows(static_cast<Eigen::Index>(Dim * k), Dim) = poses[k];
    }
  }

  Eigen::Index rows() const { return control_points_.rows(); }  // Dim * number of poses

  Eigen::VectorXd of(Index point) const {
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(control_points_.rows());
    visit_difference(before_, after_, point, [&](Index i, double difference) {
      moved += difference * control_points_.col(i);
    });
    return moved;
  }

 private:
  const SparseWeights &before_, &after_;
  Eigen::MatrixXd control_points_;  // Dim * number of poses x n
};

// The longest displacement. \param moved  Dim * number of poses
template <int Dim>
double longest(const Eigen::VectorXd& moved) {
  return moved.reshaped(Dim, moved.size() / Dim).colwise().norm().maxCoeff();
}

// The sum of squares and the maximum of what points contribute.
struct Errors {
  double sum = 0, max = 0;
  Errors& operator+=(const Errors& other) {
    sum += other.sum;
    max = std::max(max, other.max);
    return *this;
  }
};

// \param of_point  \return the Errors of a point
template <class OfPoint>
ErrorNorms norms_of(Index num_points, double count, const OfPoint& of_point) {
  const auto errors = parallel_sum<Errors>(num_points, {}, [&](Index begin, Index end) {
    Errors some;
    for (Index p = begin; p < end; ++p) some += of_point(p);
    return some;
  });
  return count > 0 ? ErrorNorms{std::sqrt(errors.sum / count), errors.max} : ErrorNorms{};
}

}  // namespace

Influences count_influences(const SparseWeights& weights, double threshold) {
  if (weights.num_points() == 0) return {};
  Influences influences;
  for (Index p = 0; p < weights.num_points(); ++p) {
    Index count = 0;
    weights.visit(p, [&](Index, double weight) { count += std::abs(weight) > threshold ? 1 : 0; });
    influences.max = std::max(influences.max, count);
    influences.mean += count;
  }
  influences.mean /= weights.num_points();
  return influences;
}

ErrorNorms weight_error(const SparseWeights& before, const SparseWeights& after) {
  check_size(before, after.num_control_points(), after.num_points());
  const double count = static_cast<double>(after.num_points()) * after.num_control_points();
  return norms_of(after.num_points(), count, [&](Index p) {
    Errors errors;
    visit_difference(before, after, p, [&](Index, double difference) {
      errors += {difference * difference, std::abs(difference)};
    });
    return errors;
  });
}

template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                             const SparseWeights& after) {
  const Displacements<Dim> displacements(poses, before, after);
  const double count = static_cast<double>(after.num_points()) * static_cast<double>(poses.size());
  if (count == 0) return {};
  return norms_of(after.num_points(), count, [&](Index p) {
    const auto moved = displacements.of(p);
    return Errors{moved.squaredNorm(), longest<Dim>(moved)};
  });
}

template <int Dim>
ErrorNorms edge_error(const PointList<Dim>& points, const EdgeList& edges,
                      const std::vector<PointList<Dim>>& poses, const SparseWeights& before,
                      const SparseWeights& after) {
  const Displacements<Dim> displacements(poses, before, after);
  check_size(before, before.num_control_points(), points.cols());
  validate(edges, points.cols());
  if (poses.empty()) return {};
  Eigen::MatrixXd moved(displacements.rows(), points.cols());
  parallel_for(points.cols(),
               [&](Eigen::Index p) { moved.col(p) = displacements.of(static_cast<Index>(p)); });
  double sum = 0, rest = 0;
  ErrorNorms norms;
  for (std::size_t e = 0; e < edges.ends.size(); ++e) {
    const auto [a, b] = edges.ends[e];
    const double weight = edges.weights.empty() ? 1 : edges.weights[e];
    const double length = (points.col(a) - points.col(b)).norm();
    const Eigen::VectorXd error = moved.col(a) - moved.col(b);
    sum += weight * error.squaredNorm();
    rest += weight * length * length * static_cast<double>(poses.size());
    if (length > 0) norms.max = std::max(norms.max, longest<Dim>(error) / length);
  }
  if (rest > 0) norms.rms = std::sqrt(sum / rest);
  return norms;
}

FLBC_INSTANTIATE_FUNCTION(deformation_error)
FLBC_INSTANTIATE_FUNCTION(edge_error)

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
// What sparse weights cost.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/sparsify.h"

namespace flbc {
namespace {

// How far poses displace, relative to the cage's size.
constexpr double kDisplacement = 0.1;

void check_sizes(const WeightMatrix& before, const WeightMatrix& after) {
  if (before.rows() == after.rows() && before.cols() == after.cols()) return;
  throw InputError("weights of " + std::to_string(before.cols()) + " points and " +
                   std::to_string(before.rows()) + " control points cannot be compared with " +
                   std::to_string(after.cols()) + " points and " + std::to_string(after.rows()) +
                   " control points");
}

// Numbers in [-1, 1]. The standard's distributions differ between libraries, its engines do not.
class Numbers {
 public:
  double next() { return 2 * (static_cast<double>(engine_()) / 4294967295.0) - 1; }

  // Uniform on the unit sphere.
  template <int Dim>
  Vector<Dim> direction() {
    for (;;) {
      Vector<Dim> vector;
      for (double& entry : vector) entry = next();
      const double length = vector.norm();
      if (length > 0.1 && length <= 1) return vector / length;
    }
  }

 private:
  std::mt19937 engine_{2014};
};

}  // namespace

Influences count_influences(const WeightMatrix& weights) {
  if (weights.size() == 0) return {};
  const auto counts = (weights.array() != 0).cast<Index>().colwise().sum().eval();
  return {counts.cast<double>().mean(), counts.maxCoeff()};
}

ErrorNorms weight_error(const WeightMatrix& before, const WeightMatrix& after) {
  check_sizes(before, after);
  if (before.size() == 0) return {};
  const auto difference = (after - before).eval();
  return {std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size())),
          difference.cwiseAbs().maxCoeff()};
}

template <int Dim>
ErrorNorms deformation_error(const std::vector<PointList<Dim>>& poses, const WeightMatrix& before,
                             const WeightMatrix& after) {
  check_sizes(before, after);
  if (before.size() == 0 || poses.empty()) return {};
  const WeightMatrix difference = after - before;
  double sum = 0, max = 0;
  for (const auto& pose : poses) {
    if (pose.cols() != before.rows()) {
      throw InputError("a pose has " + std::to_string(pose.cols()) +
                       " control points, but the weights are for " + std::to_string(before.rows()));
    }
    const Eigen::VectorXd distances = (pose * difference).colwise().norm();
    sum += distances.squaredNorm();
    max = std::max(max, distances.maxCoeff());
  }
  return {std::sqrt(sum / static_cast<double>(before.cols()) / static_cast<double>(poses.size())),
          max};
}

template <int Dim>
std::vector<PointList<Dim>> independent_poses(const PointList<Dim>& control_points, int count) {
  Numbers numbers;
  const double length = kDisplacement * size_of<Dim>(control_points);
  std::vector<PointList<Dim>> poses(count, control_points);
  for (auto& pose : poses) {
    for (auto point : pose.colwise()) point += length * numbers.direction<Dim>();
  }
  return poses;
}

template <int Dim>
std::vector<PointList<Dim>> smooth_poses(const PointList<Dim>& control_points, int count) {
  using Square = Eigen::Matrix<double, Dim, Dim>;
  Numbers numbers;
  const auto random_square = [&] {
    Square square;
    for (int k = 0; k < Square::SizeAtCompileTime; ++k) square(k) = numbers.next();
    return square;
  };
  const double size = size_of<Dim>(control_points);
  const Vector<Dim> center = control_points.rowwise().mean();
  std::vector<PointList<Dim>> poses(count, control_points);
  for (auto& pose : poses) {
    const Square linear = random_square();
    std::vector<Square> bends;
    for (int axis = 0; axis < Dim; ++axis) bends.push_back(random_square());
    for (auto point : pose.colwise()) {
      // About 1 at the ends of the cage.
      const Vector<Dim> place = 2 * (point - center) / size;
      Vector<Dim> displacement = linear * place;
      for (int axis = 0; axis < Dim; ++axis) displacement[axis] += place.dot(bends[axis] * place);
      point += kDisplacement * size * displacement;
    }
  }
  return poses;
}

#define FLBC_INSTANTIATE(Dim)                                                                    \
  template ErrorNorms deformation_error(const std::vector<PointList<Dim>>&, const WeightMatrix&, \
                                        const WeightMatrix&);                                    \
  template std::vector<PointList<Dim>> independent_poses(const PointList<Dim>&, int);            \
  template std::vector<PointList<Dim>> smooth_poses(const PointList<Dim>&, int);
FLBC_INSTANTIATE(2)
FLBC_INSTANTIATE(3)
#undef FLBC_INSTANTIATE

}  // namespace flbc

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/poses.h"

#include <array>
#include <random>

#include "base/instantiate.h"
#include "flbc/bounding_box.h"

namespace flbc {
namespace {

// Displacement of poses relative to cage size.
constexpr double kDisplacement = 0.1;

// Random numbers in [-1, 1]. Standard distributions differ between libraries; standard engines do
// not.
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

template <int Dim>
std::vector<PointList<Dim>> independent_poses(const PointList<Dim>& control_points, int count) {
  Numbers numbers;
  const double length = kDisplacement * bounding_box_diagonal<Dim>(control_points);
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
  const double size = bounding_box_diagonal<Dim>(control_points);
  const Vector<Dim> center = control_points.rowwise().mean();
  std::vector<PointList<Dim>> poses(count, control_points);
  for (auto& pose : poses) {
    const Square linear = random_square();
    std::array<Square, Dim> bends;
    for (auto& bend : bends) bend = random_square();
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

FLBC_INSTANTIATE_FUNCTION(independent_poses)
FLBC_INSTANTIATE_FUNCTION(smooth_poses)

}  // namespace flbc

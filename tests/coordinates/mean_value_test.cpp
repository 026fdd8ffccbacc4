// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/pointwise.h"

#include "support/cages_of_all_kinds.h"

namespace flbc::testing {
namespace {

// Points all around and inside.
template <int Dim>
PointList<Dim> scattered_points(const Cage<Dim>& cage, Index count) {
  const Vector<Dim> low = cage.points.rowwise().minCoeff();
  const Vector<Dim> extent = cage.points.rowwise().maxCoeff() - low;
  PointList<Dim> points(Dim, count);
  for (Index p = 0; p < count; ++p) {
    for (int axis = 0; axis < Dim; ++axis) {
      const double part = std::fmod((p + 1) * std::sqrt(2.0 + 3 * axis), 1);
      points(axis, p) = low[axis] + extent[axis] * (2 * part - 0.5);
    }
  }
  return points;
}

template <int Dim>
WeightMatrix weights_at(const Cage<Dim>& cage, const Vector<Dim>& point) {
  return mean_value_coordinates<Dim>(cage, PointList<Dim>(point));
}

// Unit vectors with the parts of the unit circle or sphere for which they stand.
template <int Dim>
std::vector<std::pair<Vector<Dim>, double>> directions() {
  std::vector<std::pair<Vector<Dim>, double>> all;
  if constexpr (Dim == 2) {
    const int count = 200000;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * kPi * (k + 0.5) / count;
      all.push_back({{std::cos(angle), std::sin(angle)}, 2 * kPi / count});
    }
  } else {
    const int bands = 300;  // of equal height, so of equal area
    for (int k = 0; k < bands; ++k) {
      const double z = 2 * (k + 0.5) / bands - 1;
      for (int l = 0; l < 2 * bands; ++l) {
        const double angle = kPi * (l + 0.5) / bands;
        const double radius = std::sqrt(1 - z * z);
        all.push_back(
            {{radius * std::cos(angle), radius * std::sin(angle), z}, 2 * kPi / (bands * bands)});
      }
    }
  }
  return all;
}

// The definition: a direction sees barycentric coordinates in every facet behind one another,
// divided by the distance, positive where it leaves the interior. The cage must be oriented.
template <int Dim>
WeightMatrix integrate_over_directions(const Cage<Dim>& cage, const Vector<Dim>& x) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(cage.size());
  const auto all = directions<Dim>();
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    Eigen::Matrix<double, Dim, Dim> corners;
    for (int k = 0; k < Dim; ++k) corners.col(k) = cage.points.col(cage.facets(k, f)) - x;
    const double side = corners.determinant() > 0 ? 1 : -1;
    const Eigen::Matrix<double, Dim, Dim> to_coordinates = corners.inverse();
    for (const auto& [direction, part] : all) {
      const Vector<Dim> seen = to_coordinates * direction;  // coordinates / distance
      if (seen.minCoeff() < 0) continue;
      for (int k = 0; k < Dim; ++k) sum[cage.facets(k, f)] += side * part * seen[k];
    }
  }
  return sum / sum.sum();
}

TEST_IN_2D_AND_3D(MeanValueTest, IsWhatItsDefinitionSaysInsideAndOutside) {
  for (const auto& sample : cages<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto points = scattered_points(sample.cage, 6);
    const auto weights = mean_value_coordinates(sample.cage, points);
    for (Index p = 0; p < points.cols(); ++p) {
      const auto expected = integrate_over_directions<Dim>(sample.cage, points.col(p));
      EXPECT_LT((weights.col(p) - expected).cwiseAbs().maxCoeff(),
                (Dim == 2 ? 1e-3 : 1e-2) * (1 + expected.cwiseAbs().maxCoeff()))
          << points.col(p).transpose() << "\n"
          << weights.col(p).transpose() << "\n"
          << expected.transpose();
    }
  }
}

TEST_IN_2D_AND_3D(MeanValueTest, SumToOneAndReproduceEverywhere) {
  for (const auto& sample : cages<Dim>()) {
    SCOPED_TRACE(sample.name);
    for (const auto& points :
         {sample.mesh.points, centers(sample.mesh), scattered_points(sample.cage, 500)}) {
      const auto weights = mean_value_coordinates(sample.cage, points);
      const auto quality = measure_quality(sample.cage.points, points, weights);
      EXPECT_LT(quality.max_partition_error, 1e-13);
      EXPECT_LT(quality.max_reproduction_error, 1e-11);
      EXPECT_TRUE(weights.allFinite());
    }
  }
}

// How far the weights at a place are from those at distance 10^-k of it in several directions,
// divided by that distance: bounded for functions with bounded slope, and without noise.
template <int Dim>
void expect_bounded_slope(const Cage<Dim>& cage, const Vector<Dim>& place, double bound) {
  const auto here = weights_at<Dim>(cage, place);
  for (int k = 3; k <= 15; ++k) {
    const double distance = std::pow(10.0, -k);
    for (int turn = 0; turn < 8; ++turn) {
      Vector<Dim> direction;
      for (int axis = 0; axis < Dim; ++axis) direction[axis] = std::sin(0.3 + 2 * turn + 5 * axis);
      direction *= distance / direction.norm();
      const auto there = weights_at<Dim>(cage, place + direction);
      EXPECT_LT((there - here).cwiseAbs().maxCoeff(), bound * distance + 1e-11)
          << place.transpose() << " distance " << distance;
    }
  }
}

TEST_IN_2D_AND_3D(MeanValueTest, ContinuousAcrossThePlanesOfFacets) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 1);  // coordinates are whole numbers
  Vector<Dim> x = Vector<Dim>::Constant(0.4);
  x[1] = 1;  // in the plane of a facet, within the interior
  expect_bounded_slope<Dim>(sample.cage, x, 200);
  x[0] = 1 - 1e-7;  // and near that facet
  expect_bounded_slope<Dim>(sample.cage, x, 200);
  x[0] = 1;
  x[1] = 0.4;
  expect_bounded_slope<Dim>(sample.cage, x, 200);
  x = Vector<Dim>::Constant(2);  // outside, where planes of several facets meet
  x[0] = -3;
  expect_bounded_slope<Dim>(sample.cage, x, 200);
  x[0] = 1;
  expect_bounded_slope<Dim>(sample.cage, x, 200);
}

TEST_IN_2D_AND_3D(MeanValueTest, NotNegativeInsideConvexCages) {
  for (const auto shape : {Shape::kSimplex, Shape::kBox}) {
    const auto sample = make_sample<Dim>(shape, 5, 0.2);
    EXPECT_GT(mean_value_coordinates(sample.cage, centers(sample.mesh)).minCoeff(), 0);
  }
}

TEST_IN_2D_AND_3D(MeanValueTest, OrientationOfTheCageDoesNotMatter) {
  const Cage<Dim> outer = box_cage<Dim>(1), hole = box_cage<Dim>(0.6), core = box_cage<Dim>(0.3);
  const Cage<Dim> sound = join(join(outer, reversed(hole)), core);
  const auto points = scattered_points(sound, 200);
  const auto expected = mean_value_coordinates(sound, points);
  std::vector<Cage<Dim>> others{join(join(outer, hole), core),
                                join(join(reversed(outer), hole), reversed(core))};
  if (Dim == 2) {  // where even the edges of one loop may run against each other
    others.push_back(sound);
    others.back().facets.col(2).reverseInPlace();
    others.back().facets.col(4).reverseInPlace();
  }
  for (const auto& cage : others) {
    EXPECT_LT((mean_value_coordinates(cage, points) - expected).cwiseAbs().maxCoeff(),
              1e-10 * expected.cwiseAbs().maxCoeff());
  }
  const Vector<Dim> in_hole = Vector<Dim>::Constant(0.45);
  EXPECT_LT((weights_at<Dim>(sound, in_hole) - integrate_over_directions<Dim>(sound, in_hole))
                .cwiseAbs()
                .maxCoeff(),
            1e-2);
}

TEST_IN_2D_AND_3D(MeanValueTest, NoPointsAndPointsThatAreNone) {
  const auto cage = box_cage<Dim>(1);
  EXPECT_EQ(mean_value_coordinates(cage, PointList<Dim>(Dim, 0)).rows(), cage.size());
  PointList<Dim> points = PointList<Dim>::Zero(Dim, 3);
  points(1, 2) = std::numeric_limits<double>::quiet_NaN();
  expect_error<InputError>([&] { mean_value_coordinates(cage, points); }, {"point 2 at (0, nan"});
}

}  // namespace
}  // namespace flbc::testing

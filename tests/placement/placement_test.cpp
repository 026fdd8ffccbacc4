// SPDX-License-Identifier: BSD-3-Clause
// Weights at points inside a cage, slightly outside, and far outside.
#include "flbc/placement.h"

#include "flbc/cage_facts.h"
#include "flbc/deform.h"
#include "flbc/evaluator.h"
#include "flbc/pointwise.h"
#include "flbc/sparsify.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Cages whose facets have their normals outward, with weights that are linear on every facet.
template <int Dim>
struct PlacementTest {
  explicit PlacementTest(Shape shape = Shape::kCorner) : sample(make_sample<Dim>(shape, 4)) {
    size = bounding_box_diagonal<Dim>(sample.cage.points);
    weights = mean_value_coordinates<Dim>(sample.cage, sample.mesh.points).cwiseMax(0);
    weights.array().rowwise() /= weights.colwise().sum().array().eval();
  }

  Vector<Dim> corner(Index facet, int k) const {
    return sample.cage.points.col(sample.cage.facets(k, facet));
  }
  Vector<Dim> normal(Index facet) const {
    if constexpr (Dim == 2) {
      const Vector<2> along = corner(facet, 1) - corner(facet, 0);
      return Vector<2>(along.y(), -along.x()).normalized();
    } else {
      return (corner(facet, 1) - corner(facet, 0))
          .cross(corner(facet, 2) - corner(facet, 0))
          .normalized();
    }
  }
  // At the center of every facet, and next to its first corner.
  PointList<Dim> off_the_facets(double distance) const {
    const Index num_facets = static_cast<Index>(sample.cage.facets.cols());
    PointList<Dim> points(Dim, 2 * num_facets);
    for (Index f = 0; f < num_facets; ++f) {
      Vector<Dim> middle = Vector<Dim>::Zero();
      for (int k = 0; k < Dim; ++k) middle += corner(f, k) / Dim;
      points.col(2 * f) = middle + distance * normal(f);
      points.col(2 * f + 1) = corner(f, 0) + 1e-3 * (middle - corner(f, 0)) + distance * normal(f);
    }
    return points;
  }
  WeightMatrix weights_at_points(const PointList<Dim>& points, OutsidePoints policy) const {
    return weights_at(sample.cage, sample.mesh, weights,
                      place_points(sample.cage, sample.mesh, points, policy))
        .dense();
  }
  void expect_sums_are_one(const WeightMatrix& rows) const {
    EXPECT_LT((rows.colwise().sum().array() - 1).abs().maxCoeff(), 1e-13);
  }

  Sample<Dim> sample;
  WeightMatrix weights;
  double size = 0;
};

TEST_IN_2D_AND_3D(PlacementTest, AHairOutsideIsOnTheCageForEverybody) {
  PlacementTest<Dim> t;
  const auto& cage = t.sample.cage;
  for (const double part : {0.0, 1e-13, 1e-11, 1e-9, 1e-8, 1e-7, 9e-7}) {
    SCOPED_TRACE(part);
    const auto points = t.off_the_facets(part * t.size);
    EXPECT_TRUE(points_outside(cage, points).empty());
    const auto placement = place_points(cage, t.sample.mesh, points);
    EXPECT_TRUE(placement.outside.empty());
    if (part >= 1e-11) {
      EXPECT_EQ(static_cast<Eigen::Index>(placement.on_cage.size()), points.cols());
    }
    const auto weights = weights_at(cage, t.sample.mesh, t.weights, placement).dense();
    EXPECT_GE(weights.minCoeff(), 0);
    t.expect_sums_are_one(weights);
    const PointList<Dim> places = cage.points * weights;
    EXPECT_LT((places - points).colwise().norm().maxCoeff(), (part + 1e-12) * t.size * 1.01);
    EXPECT_LT((places - placement.points).cwiseAbs().maxCoeff(), 1e-12 * t.size);
    const SparsifyOptions few{Dim + 1};
    for (const auto& some : {points, placement.points}) {
      const auto sparse = sparsify<Dim>(cage.points, some, weights, few).dense();
      EXPECT_GE(sparse.minCoeff(), 0);
    }
  }
  for (const double part : {1.1e-6, 1e-5, 1e-2}) {
    SCOPED_TRACE(part);
    const auto points = t.off_the_facets(part * t.size);
    const auto outside = points_outside(cage, points);
    const auto placement = place_points(cage, t.sample.mesh, points, OutsidePoints::kNearest);
    ASSERT_EQ(placement.outside.size(), outside.size());
    for (std::size_t k = 0; k < outside.size(); ++k) {
      EXPECT_EQ(placement.outside[k].point, outside[k]);
    }
    EXPECT_THROW(place_points(cage, t.sample.mesh, points), InputError);
  }
}

TEST_IN_2D_AND_3D(PlacementTest, PointsOfNoEdgeFollow) {
  const auto cage = make_sample<Dim>(Shape::kBox, 2).cage;
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 4, 0.5);
  points(0, 0) = 0.25;
  const EdgeList edges{{{0, 1}}, {}}, others{{{0, 1}, {1, 2}}, {}};
  EXPECT_EQ(usual_policy(cage, points, edges), OutsidePoints::kFail);  // nothing is outside
  points(0, 2) = points(1, 3) = 7;
  EXPECT_EQ(usual_policy(cage, points, edges), OutsidePoints::kNearest);
  EXPECT_EQ(usual_policy(cage, points, others), OutsidePoints::kFail);
  EXPECT_EQ(usual_policy(cage, points, EdgeList{}), OutsidePoints::kFail);  // no faces at all
  expect_error<InputError>([&] { usual_policy(cage, points, EdgeList{{{0, 4}}, {}}); }, {"4"});
}

TEST_IN_2D_AND_3D(PlacementTest, PointsInsideAreInterpolated) {
  PlacementTest<Dim> t;
  const auto points = t.off_the_facets(-0.01 * t.size);
  const auto placement = place_points(t.sample.cage, t.sample.mesh, points);
  EXPECT_TRUE(placement.on_cage.empty());
  const auto weights = t.weights_at_points(points, OutsidePoints::kFail);
  t.expect_sums_are_one(weights);
  const PointList<Dim> before = t.sample.mesh.points;
  // Linear functions of position are reproduced for any weights of the mesh.
  for (Eigen::Index p = 0; p < points.cols(); ++p) {
    const auto& place = placement.places[p];
    Vector<Dim> found = Vector<Dim>::Zero();
    for (int k = 0; k <= Dim; ++k) {
      found += place.coordinates[k] * before.col(t.sample.mesh.cells(k, place.cell));
    }
    EXPECT_LT((found - points.col(p)).norm(), 1e-12 * t.size);
  }
}

TEST_IN_2D_AND_3D(PlacementTest, RefusalsNameTheFarthest) {
  PlacementTest<Dim> t;
  auto points = t.off_the_facets(-0.01 * t.size);
  points.col(1) = t.corner(0, 0) + 0.25 * t.size * t.normal(0);
  points.col(3).setConstant(100 * t.size);
  expect_error<InputError>(
      [&] { place_points(t.sample.cage, t.sample.mesh, points); },
      {"2 of " + std::to_string(points.cols()) + " vertices are outside",
       "the farthest is vertex 3", "kNearest", "kKeep", "kExtend", "cage_from_model()"});
}

TEST_IN_2D_AND_3D(PlacementTest, NearestIsTheNearestPointOfTheCage) {
  PlacementTest<Dim> t;
  const auto& cage = t.sample.cage;
  const auto points = t.off_the_facets(0.2 * t.size);
  const auto placement = place_points(cage, t.sample.mesh, points, OutsidePoints::kNearest);
  const auto weights = weights_at(cage, t.sample.mesh, t.weights, placement).dense();
  ASSERT_GT(placement.outside.size(), 0u);
  t.expect_sums_are_one(weights);
  const PointList<Dim> places = cage.points * weights;
  EXPECT_LT((places - placement.points).cwiseAbs().maxCoeff(), 1e-12);
  for (const auto& beside : placement.outside) {
    const Index point = beside.point;
    const double distance = beside.distance();
    EXPECT_LT((places.col(point) + beside.offset - points.col(point)).norm(), 1e-12);
    EXPECT_GE(weights.col(point).minCoeff(), 0);
    EXPECT_LE((weights.col(point).array() > 0).count(), Dim);
    EXPECT_NEAR((places.col(point) - points.col(point)).norm(), distance, 1e-12);
    // No place on any facet is nearer.
    for (Index f = 0; f < cage.facets.cols(); ++f) {
      constexpr int kSteps = 12;
      for (int a = 0; a <= kSteps; ++a) {
        for (int b = 0; b <= (Dim == 2 ? 0 : kSteps - a); ++b) {
          Vector<Dim> place = t.corner(f, 0);
          place += (t.corner(f, 1) - t.corner(f, 0)) * a / kSteps;
          if (Dim == 3) place += (t.corner(f, 2) - t.corner(f, 0)) * b / kSteps;
          EXPECT_GE((place - points.col(point)).norm(), distance - 1e-12);
        }
      }
    }
  }
}

TEST_IN_2D_AND_3D(PlacementTest, AttachedPointsAreThoseThatTheWeightsReproduce) {
  PlacementTest<Dim> t;
  const auto& cage = t.sample.cage;
  PointList<Dim> points(Dim, 4 * cage.facets.cols());
  points << t.off_the_facets(-0.01 * t.size), t.off_the_facets(0.2 * t.size);
  for (const auto policy :
       {OutsidePoints::kNearest, OutsidePoints::kKeep, OutsidePoints::kExtend}) {
    const auto placement = place_points(cage, t.sample.mesh, points, policy);
    ASSERT_GT(placement.outside.size(), 0U);
    // Reproducing on the mesh, as the weights of a solve.
    SparseWeights linear = mean_value_coordinates<Dim>(cage, t.sample.mesh.points);
    const auto weights = weights_at(cage, t.sample.mesh, linear, placement);
    const auto attached = attached_points(cage, points, weights);
    EXPECT_LT((attached - placement.points).cwiseAbs().maxCoeff(), 1e-12 * t.size);
    if (policy == OutsidePoints::kExtend) {
      EXPECT_EQ(attached, points);
    }
    // Weights of other points are not taken for weights of these.
    const PointList<Dim> others = points.rowwise().reverse();
    const auto of_others = attached_points<Dim>(cage, others, weights);
    EXPECT_GT((of_others - deform<Dim>(weights, cage.points)).colwise().norm().maxCoeff(),
              1e-3 * t.size);
    const Cage<Dim> without_facets{cage.points, {}};
    EXPECT_EQ(attached_points(without_facets, points, weights), points);
  }
}

TEST_IN_2D_AND_3D(PlacementTest, ExtendedWeightsReproducePointsAndAffineMaps) {
  PlacementTest<Dim> t;
  const auto& cage = t.sample.cage;
  for (const double part : {1e-4, 0.05, 0.5}) {
    SCOPED_TRACE(part);
    const auto points = t.off_the_facets(part * t.size);
    const auto weights = t.weights_at_points(points, OutsidePoints::kExtend);
    t.expect_sums_are_one(weights);
    // Points outside are reproduced; those that have come inside again are the mesh's business.
    const auto outside = points_outside(cage, points);
    ASSERT_GT(outside.size(), 0u);
    Eigen::Matrix<double, Dim, Dim> map = Eigen::Matrix<double, Dim, Dim>::Identity();
    map(0, Dim - 1) = 0.7;
    map(1, 1) = -2;
    const PointList<Dim> pose = (map * cage.points).array() + 3;
    for (const Index p : outside) {
      const Vector<Dim> expected = (map * points.col(p)).array() + 3;
      EXPECT_LT((cage.points * weights.col(p) - points.col(p)).norm(), 1e-12 * t.size);
      EXPECT_LT((pose * weights.col(p) - expected).norm(), 1e-11 * t.size);
    }
  }
}

TEST_IN_2D_AND_3D(PlacementTest, ExtensionIsContinuousAcrossTheCageAndRoundConvexEdges) {
  constexpr double kStep = 1e-5;
  const auto sample = make_sample<Dim>(Shape::kBox, 3);
  const auto& cage = sample.cage;
  const auto weights = mean_value_coordinates<Dim>(cage, sample.mesh.points);
  // A straight line from inside through a facet and around the edges and corners of the box.
  const Vector<Dim> center = cage.points.rowwise().mean();
  const double size = bounding_box_diagonal<Dim>(cage.points);
  Vector<Dim> along = Vector<Dim>::Zero();
  along[0] = 1;
  along[1] = 0.61;
  constexpr int kPoints = 400;
  PointList<Dim> points(Dim, 2 * kPoints);
  for (int k = 0; k < kPoints; ++k) {
    const double angle = 0.02 * k;
    Vector<Dim> place = center + size * k / kPoints * along;
    if (k >= kPoints / 2) {  // around the box
      place = center;
      place[0] += size * std::cos(angle);
      place[1] += size * std::sin(angle);
      place[Dim - 1] += Dim == 3 ? 0.3 * size * std::sin(3 * angle) : 0;
    }
    points.col(2 * k) = place;
    points.col(2 * k + 1) = place + kStep * size * along;
  }
  const auto extended = weights_at(cage, sample.mesh, weights,
                                   place_points(cage, sample.mesh, points, OutsidePoints::kExtend))
                            .dense();
  for (int k = 0; k < kPoints; ++k) {
    const double change = (extended.col(2 * k) - extended.col(2 * k + 1)).norm();
    EXPECT_LT(change, 20 * kStep) << k;
  }
}

TEST_IN_2D_AND_3D(PlacementTest, PointsThatAreNotFiniteAreRefusedByName) {
  PlacementTest<Dim> t;
  const Evaluator<Dim> evaluator(t.sample.cage, t.sample.mesh, t.weights);
  const CellLocator<Dim> locator(t.sample.mesh);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    PointList<Dim> points = t.sample.mesh.points;
    points(Dim - 1, 3) = bad;
    EXPECT_LT(locator.locate(points.col(3), 0.1).cell, 0);
    const std::vector<std::function<void()>> actions = {
        [&] { place_points(t.sample.cage, t.sample.mesh, points); },
        [&] { place_points(t.sample.cage, points, OutsidePoints::kNearest); },
        [&] { locate_points(t.sample.mesh, points); }, [&] { evaluator.place(points); }};
    for (const auto& action : actions) expect_refused<InputError>("point 3 at ", action);
    PointList<Dim> pose = t.sample.cage.points;
    pose(0, 2) = bad;
    expect_refused<InputError>("point 2 at ", [&] { deform<Dim>(t.weights, pose); });
  }
}

}  // namespace
}  // namespace flbc::testing

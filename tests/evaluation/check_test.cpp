// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/check.h"

#include "flbc/cage_facts.h"
#include "support/harmonic_weights.h"
#include "support/hollow_sample.h"

namespace flbc::testing {
namespace {

// A sample with sound weights at its vertices.
template <int Dim>
struct Weighted {
  Sample<Dim> sample = make_sample<Dim>(Shape::kRing, 4, 0.2);
  WeightMatrix weights = harmonic_weights(sample);

  WeightCheck<Dim> check() const { return check_weights(sample.cage, sample.mesh, weights); }
  Index first_vertex(bool inside) const {
    const auto interior = interior_vertices(sample.mesh);
    Index v = 0;
    while (interior[v] != inside) ++v;
    return v;
  }
};

template <int Dim>
void expect_one_violation(const WeightCheck<Dim>& check, const std::string& words) {
  const auto violations = find_violations(check);
  ASSERT_EQ(violations.size(), 1);
  expect_piece(violations.front(), words);
}

TEST_IN_2D_AND_3D(CheckTest, SoundWeightsAreSound) {
  auto all = samples<Dim>();
  all.push_back(make_hollow_sample<Dim>());
  for (const auto& sample : all) {
    SCOPED_TRACE(sample.name);
    const auto weights = harmonic_weights(sample);
    const auto check = check_weights(sample.cage, sample.mesh, weights);
    EXPECT_EQ(find_violations(check), std::vector<std::string>());
    EXPECT_EQ(check.points, sample.mesh.num_vertices());
    EXPECT_EQ(check.control_points, sample.cage.size());
    EXPECT_EQ(check.control_points_found, sample.cage.size());
    EXPECT_EQ(check.non_finite, 0);
    ASSERT_TRUE(check.mesh.has_value());
    EXPECT_EQ(check.points_on_cage + check.mesh->interior_vertices, sample.mesh.num_vertices());
    // They are harmonic coordinates themselves.
    EXPECT_NEAR(check.mesh->total_variation, check.mesh->harmonic_total_variation,
                1e-9 * check.mesh->total_variation);
    EXPECT_NEAR(check.mesh->weighted_variation, check.mesh->harmonic_weighted_variation,
                1e-9 * check.mesh->weighted_variation);
    EXPECT_NEAR(check.mesh->influence_ratio, 1, 1e-3);
  }
}

// Compares all measures with an independent reference, on arbitrary weights.
TEST_IN_2D_AND_3D(CheckTest, AgreesWithTheJudgeAndMeasureQuality) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const WeightMatrix weights =
        harmonic_weights(sample) +
        0.05 * WeightMatrix::Random(sample.cage.size(), sample.mesh.num_vertices());
    const auto check = check_weights(sample.cage, sample.mesh, weights);
    const auto judgement = judge(sample.cage, sample.mesh, weights, 1e-6);
    EXPECT_EQ(check.min_weight.value, judgement.min_weight);
    EXPECT_NEAR(check.partition.value, judgement.partition_error, 1e-13);
    EXPECT_NEAR(check.reproduction.value, judgement.reproduction_error, 1e-13);
    EXPECT_EQ(check.reproduction.place, judgement.worst_reproduced);
    EXPECT_NEAR(check.lagrange.value, judgement.lagrange_error, 1e-12);
    EXPECT_NEAR(check.linearity.value, judgement.linearity_error, 1e-9);
    EXPECT_EQ(check.control_points_found, judgement.control_points_found);
    EXPECT_EQ(check.mesh->local_minima, judgement.local_minima);
    EXPECT_EQ(check.mesh->local_maxima, judgement.local_maxima);
    const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(sample.cage.size(), sample.mesh.num_cells());
    const double variation = testing::objective(sample.mesh, weights, ones);
    EXPECT_NEAR(check.mesh->total_variation, variation, 1e-12 * variation);
    const auto phi = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0).phi.dense();
    const double weighted = testing::objective(sample.mesh, weights, phi);
    EXPECT_NEAR(check.mesh->weighted_variation, weighted, 1e-9 * weighted);

    const auto quality = measure_quality(sample.cage.points, sample.mesh.points, weights);
    EXPECT_EQ(check.quality.min_weight, quality.min_weight);
    EXPECT_EQ(check.quality.mean_influences, quality.mean_influences);
    EXPECT_NEAR(check.quality.max_partition_error, quality.max_partition_error, 1e-14);
    EXPECT_NEAR(check.quality.max_reproduction_error, quality.max_reproduction_error, 1e-14);
  }
}

TEST_IN_2D_AND_3D(CheckTest, EveryViolationIsFoundWhereItIs) {
  const Weighted<Dim> sound;
  const auto& mesh = sound.sample.mesh;
  const auto judgement = judge(sound.sample.cage, mesh, sound.weights);
  const Index inside = sound.first_vertex(true);
  auto broken = sound;

  broken.weights(3, inside) += 1e-5;
  auto check = broken.check();
  EXPECT_NEAR(check.partition.value, 1e-5, 1e-12);
  EXPECT_EQ(check.partition.point, inside);
  EXPECT_EQ(check.partition.place, mesh.points.col(inside));
  EXPECT_EQ(check.reproduction.point, inside);
  EXPECT_GT(check.reproduction.value, 1e-7);
  EXPECT_EQ(find_violations(check).front().find("the weights of point " + std::to_string(inside) +
                                                " at ("),
            0);

  broken = sound;  // the sum stays
  broken.weights(0, inside) += 0.25;
  broken.weights(1, inside) -= 0.25;
  check = broken.check();
  EXPECT_EQ(check.reproduction.point, inside);
  EXPECT_LT(check.partition.value, 1e-12);
  expect_one_violation(check, "do not reproduce it");

  Index at_control_point = 0;
  (mesh.points.colwise() - sound.sample.cage.points.col(2))
      .colwise()
      .norm()
      .minCoeff(&at_control_point);
  broken = sound;
  broken.weights(2, at_control_point) = 0.5;
  check = broken.check();
  EXPECT_EQ(check.lagrange.point, at_control_point);
  EXPECT_EQ(check.lagrange.control_point, 2);
  EXPECT_NEAR(check.lagrange.value, 0.5, 1e-9);
  EXPECT_EQ(find_violations(check).size(), 4);

  const Index on_facet = [&] {
    Index v = 0;
    const auto interior = interior_vertices(mesh);
    while (interior[v] || sound.weights.col(v).maxCoeff() > 0.9) ++v;
    return v;
  }();
  broken = sound;
  Index strongest = 0;
  broken.weights.col(on_facet).maxCoeff(&strongest);
  broken.weights(strongest, on_facet) += 1e-3;
  check = broken.check();
  EXPECT_EQ(check.linearity.point, on_facet);
  EXPECT_EQ(check.linearity.control_point, strongest);
  EXPECT_NEAR(check.linearity.value, 1e-3, 1e-9);
  EXPECT_LT(check.lagrange.value, 1e-9);
  EXPECT_LT(judgement.linearity_error, 1e-9);
}

TEST_IN_2D_AND_3D(CheckTest, NegativeWeightsAreCountedAndNoViolation) {
  Cage<Dim> cage = box_cage<Dim>(1);
  const PointList<Dim> centre = PointList<Dim>::Zero(Dim, 2);
  WeightMatrix weights = WeightMatrix::Constant(cage.size(), 2, 1.0 / cage.size());
  // The difference of two diagonals' ends reproduces zero.
  const double shift = 0.5;
  weights(0, 1) -= shift;
  weights(cage.size() - 1, 1) -= shift;
  weights(1, 1) += shift;
  weights(cage.size() - 2, 1) += shift;
  auto check = check_weights(cage, centre, weights);
  EXPECT_EQ(find_violations(check), std::vector<std::string>());
  EXPECT_EQ(check.negative, 2);
  EXPECT_EQ(check.min_weight.point, 1);
  EXPECT_EQ(check.min_weight.control_point, 0);
  EXPECT_EQ(check.min_weight.value, weights.minCoeff());
  EXPECT_EQ(check.max_weight.control_point, 1);
  EXPECT_EQ(check.influences.value, cage.size());
  EXPECT_EQ(check.influences.point, 0);
  EXPECT_FALSE(check.mesh.has_value());
  EXPECT_EQ(check.points_on_cage, 0);
  EXPECT_EQ(check.linearity.point, -1);

  weights.col(1) = weights.col(0);
  weights(0, 1) = -1e-14;  // rounding
  EXPECT_EQ(check_weights(cage, centre, weights).negative, 0);
}

TEST_IN_2D_AND_3D(CheckTest, WeightsThatAreNoNumbersAreSetApart) {
  auto broken = Weighted<Dim>();
  const Index v = broken.first_vertex(true);
  broken.weights(4, v) = std::numeric_limits<double>::quiet_NaN();
  broken.weights(5, v) = std::numeric_limits<double>::infinity();
  const auto check = broken.check();
  EXPECT_EQ(check.non_finite, 2);
  EXPECT_EQ(check.first_non_finite.point, v);
  EXPECT_EQ(check.first_non_finite.control_point, 4);
  EXPECT_LT(check.partition.value, 1e-12);
  EXPECT_LT(check.reproduction.value, 1e-12);
  expect_one_violation(check,
                       "2 weights are not finite; the first is the weight for control point "
                       "4 at point " +
                           std::to_string(v));
}

TEST_IN_2D_AND_3D(CheckTest, PointsOnTheCageAreFoundByGeometry) {
  const auto cage = make_sample<Dim>(Shape::kCorner, 1).cage;
  // The middle of every facet, two control points, and a point inside.
  const auto num_facets = static_cast<Index>(cage.facets.cols());
  WeightMatrix weights = WeightMatrix::Zero(cage.size(), num_facets + 3);
  for (Index f = 0; f < num_facets; ++f) {
    for (int k = 0; k < Dim; ++k) weights(cage.facets(k, f), f) += 1.0 / Dim;
  }
  weights(1, num_facets) = weights(4, num_facets + 1) = 1;
  weights.col(num_facets + 2).setConstant(1.0 / cage.size());
  PointList<Dim> points = cage.points * weights;
  points.rightCols(1).setConstant(0.4);
  points.col(0).array() += 1e-12;   // still on the cage
  points.col(1).array() += 1.1e-7;  // no longer, at least not in the plane of the facet
  weights.col(1).setConstant(1.0 / cage.size());

  auto check = check_weights(cage, points, weights);
  EXPECT_EQ(check.points_on_cage, num_facets + 1);
  EXPECT_EQ(check.control_points_found, 2);
  EXPECT_LT(check.linearity.value, 1e-11);
  EXPECT_LT(check.lagrange.value, 1e-12);

  weights(0, num_facets + 1) = 0.125;
  check = check_weights(cage, points, weights);
  EXPECT_EQ(check.lagrange.value, 0.125);
  EXPECT_EQ(check.lagrange.point, num_facets + 1);
  EXPECT_EQ(check.lagrange.control_point, 0);
  weights(0, num_facets - 1) += 0.25;
  check = check_weights(cage, points, weights);
  EXPECT_NEAR(check.linearity.value, 0.25, 1e-12);
  EXPECT_EQ(check.linearity.point, num_facets - 1);
}

TEST_IN_2D_AND_3D(CheckTest, ExtremaCountFromAMarginOn) {
  Weighted<Dim> sound;
  sound.sample = make_sample<Dim>(Shape::kBox, 5);  // of right angles, so none to begin with
  sound.weights = harmonic_weights(sound.sample);
  const auto before = sound.check();
  const Index v = sound.first_vertex(true);
  double highest = -1, lowest = 2;  // of w_0 at the neighbors
  for (Index s = 0; s < sound.sample.mesh.num_cells(); ++s) {
    if ((sound.sample.mesh.cells.col(s).array() != v).all()) continue;
    for (const Index w : sound.sample.mesh.cells.col(s)) {
      if (w == v) continue;
      highest = std::max(highest, sound.weights(0, w));
      lowest = std::min(lowest, sound.weights(0, w));
    }
  }
  const auto count = [&](double value, bool maxima) {
    auto changed = sound;
    changed.weights(0, v) = value;
    const auto check = changed.check();
    const auto& found = maxima ? check.mesh->local_maxima : check.mesh->local_minima;
    const auto& place = maxima ? check.mesh->highest_maximum : check.mesh->deepest_minimum;
    if (found[0] > 0) {
      EXPECT_EQ(place.point, v);
      EXPECT_EQ(place.control_point, 0);
    }
    return found[0];
  };
  EXPECT_EQ(before.mesh->highest_maximum.point, -1);
  EXPECT_EQ(before.mesh->deepest_minimum.point, -1);
  EXPECT_EQ(count(highest + 2e-6, true), 1);
  EXPECT_EQ(count(highest + 5e-7, true), 0);
  EXPECT_EQ(count(lowest - 2e-6, false), 1);
  EXPECT_EQ(count(lowest - 5e-7, false), 0);
}

TEST_IN_2D_AND_3D(CheckTest, SizesAndMeshesThatDoNotBelongAreRefused) {
  const Weighted<Dim> sound;
  const auto& cage = sound.sample.cage;
  const auto& mesh = sound.sample.mesh;
  const PointList<Dim> fewer = mesh.points.leftCols(7);
  expect_refused("match 7 points", [&] { check_weights(cage, fewer, sound.weights); });
  const WeightMatrix other = sound.weights.topRows(5);
  expect_refused("and 5 control points", [&] { check_weights(cage, mesh, other); });
  auto moved = mesh;
  moved.points.array() += 0.5;
  expect_refused("on the cage", [&] { check_weights(cage, moved, sound.weights); });
}

// Against a loop over all facets that shares no code with the library.
TEST_IN_2D_AND_3D(CheckTest, JumpsOfGradientsAreThoseAcrossInteriorFacets) {
  const Weighted<Dim> weighted;
  const auto& mesh = weighted.sample.mesh;
  double jumps = 0, measures = 0;
  for (const auto& [facet, cells] : cells_by_facet(mesh)) {
    if (cells.size() < 2) continue;
    const auto gradient = [&](Index s) {
      return linear_gradients<Dim>(cell_corners(mesh, s),
                                   columns_of(weighted.weights, mesh.cells.col(s)));
    };
    const double measure = simplex_measure<Dim>(corners_of<Dim>(mesh.points, facet));
    jumps += measure * (gradient(cells[0]) - gradient(cells[1])).squaredNorm();
    measures += measure;
  }
  const auto& points = weighted.sample.cage.points;
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  const double expected = std::sqrt(jumps / measures) * size;
  EXPECT_NEAR(weighted.check().mesh->gradient_jump, expected, 1e-9 * expected);
  EXPECT_NEAR(weighted.check().mesh->harmonic_gradient_jump, expected, 1e-6 * expected);
}

TEST_IN_2D_AND_3D(CheckTest, SameResultForAnyNumberOfThreads) {
  Weighted<Dim> weighted;
  weighted.weights += 0.01 * WeightMatrix::Random(weighted.weights.rows(), weighted.weights.cols());
  expect_same_for_any_threads([&] {
    const auto check = weighted.check();
    return std::tuple(check.mesh->total_variation, check.mesh->local_minima,
                      check.reproduction.value, check.reproduction.point);
  });
}

TEST_IN_2D_AND_3D(CheckTest, FactsOfNestedBoxes) {
  const Cage<Dim> outer = box_cage<Dim>(1), hole = box_cage<Dim>(0.6), core = box_cage<Dim>(0.3);
  const Vector<Dim> far = Vector<Dim>::Constant(1000);
  for (const auto& cage :
       {join(join(hole, core), outer), join(join(reversed(hole), core), outer)}) {
    Cage<Dim> moved = cage;
    moved.points.colwise() += far;
    const auto facts = measure_cage(moved);
    EXPECT_EQ(facts.parts, 2);
    EXPECT_EQ(facts.holes, 1);
    EXPECT_NEAR(facts.size, 2 * std::sqrt(Dim), 1e-12);
    const double expected = std::pow(2, Dim) - std::pow(1.2, Dim) + std::pow(0.6, Dim);
    EXPECT_NEAR(facts.measure, expected, 1e-9);
    EXPECT_NEAR(facts.shortest_edge, 0.6, 1e-9);
    EXPECT_EQ(facts.shortest_ends[0] / hole.size(), 1);  // both in the core
    EXPECT_EQ(facts.shortest_ends[1] / hole.size(), 1);
    EXPECT_NEAR(
        (moved.points.col(facts.shortest_ends[0]) - moved.points.col(facts.shortest_ends[1]))
            .norm(),
        0.6, 1e-9);
  }
}

TEST_IN_2D_AND_3D(CheckTest, PointsOutsideAreNamed) {
  const auto cage = join(box_cage<Dim>(1), box_cage<Dim>(0.5));
  PointList<Dim> points = PointList<Dim>::Zero(Dim, 6);
  points.row(0) << 0.75, 0.25, 1.5, 1, 1 + 1e-8, -1 - 1e-5;
  EXPECT_EQ(points_outside(cage, points), (std::vector<Index>{1, 2, 5}));
  EXPECT_TRUE(points_outside(cage, PointList<Dim>(Dim, 0)).empty());
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/distance_weights.h"

#include "problem/geodesic/eikonal_mesh.h"
#include "problem/geodesic/march.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// In a convex domain geodesics are straight, and then nothing is lost on any mesh, in any units.
TEST_IN_2D_AND_3D(DistanceWeightsTest, AreEuclideanInABox) {
  for (const Index resolution : {3, Dim == 2 ? 40 : 12}) {
    for (const double unit : {1e-3, 1.0, 1e3}) {
      auto sample = make_sample<Dim>(Shape::kBox, resolution, 0.2);
      sample.mesh.points *= unit;
      sample.cage.points *= unit;
      const auto& mesh = sample.mesh;
      const auto topology = build_topology(mesh);
      const auto sources = boundary_values(sample.cage, mesh, topology).control_vertices;
      const auto distances = geodesic_distances(mesh, topology, sources);
      const double diagonal = bounding_box_diagonal(sample.cage.points);
      for (std::size_t i = 0; i < sources.size(); ++i) {
        EXPECT_EQ(distances(i, sources[i]), 0);
        for (Index v = 0; v < mesh.num_vertices(); ++v) {
          const double straight = (mesh.points.col(v) - mesh.points.col(sources[i])).norm();
          EXPECT_NEAR(distances(i, v), straight, 1e-5 * diagonal) << unit << ' ' << i << ' ' << v;
        }
      }
    }
  }
}

// The way between two points of a square with a square hole, where it is no longer than one corner
// of the hole away from straight; infinite otherwise.
double way_round_hole(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double hole) {
  const auto crosses_hole = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    // Cut to the hole's open square, coordinate by coordinate.
    double enter = 0;
    double leave = 1;
    for (int d = 0; d < 2; ++d) {
      const double step = to[d] - from[d];
      if (step == 0) {
        if (std::abs(from[d]) >= hole * (1 - 1e-9)) return false;
        continue;
      }
      const double first = (-hole - from[d]) / step;
      const double second = (hole - from[d]) / step;
      enter = std::max(enter, std::min(first, second));
      leave = std::min(leave, std::max(first, second));
    }
    return leave - enter > 1e-9;
  };
  if (!crosses_hole(a, b)) return (b - a).norm();
  double shortest = std::numeric_limits<double>::infinity();
  for (const double x : {-hole, hole}) {
    for (const double y : {-hole, hole}) {
      const Eigen::Vector2d corner(x, y);
      if (crosses_hole(a, corner) || crosses_hole(corner, b)) continue;
      shortest = std::min(shortest, (corner - a).norm() + (b - corner).norm());
    }
  }
  return shortest;
}

// Around the hole of a ring the path bends; in 3D, a way is what it is in the plane, and straight
// in the third direction. Behind the bend the error is of the order of a cell.
TEST_IN_2D_AND_3D(DistanceWeightsTest, GoRoundHoles) {
  const auto error_of = [](Index resolution) {
    const auto sample = make_sample<Dim>(Shape::kRing, resolution);
    const auto& mesh = sample.mesh;
    const auto middle =
        ((mesh.points.rowwise().minCoeff() + mesh.points.rowwise().maxCoeff()) / 2).eval();
    // Of all control points, those of the hole are the nearest to the middle in the plane.
    double hole = std::numeric_limits<double>::infinity();
    for (const auto& corner : sample.cage.points.colwise()) {
      hole = std::min(hole, (corner - middle).template head<2>().cwiseAbs().maxCoeff());
    }
    const auto topology = build_topology(mesh);
    const auto sources = boundary_values(sample.cage, mesh, topology).control_vertices;
    const auto distances = geodesic_distances(mesh, topology, sources);
    double worst = 0;
    int num_bent = 0;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const auto source = (mesh.points.col(sources[i]) - middle).eval();
      for (Index v = 0; v < mesh.num_vertices(); ++v) {
        const auto point = (mesh.points.col(v) - middle).eval();
        const double in_plane =
            way_round_hole(source.template head<2>(), point.template head<2>(), hole);
        if (!std::isfinite(in_plane)) continue;
        const double rise = Dim == 3 ? point[Dim - 1] - source[Dim - 1] : 0.0;
        const double way = std::hypot(in_plane, rise);
        worst = std::max(worst, std::abs(distances(i, v) - way));
        num_bent += way > (point - source).norm() * 1.02 ? 1 : 0;
      }
    }
    EXPECT_GT(num_bent, 10);
    // The hole is as wide as the ring, and `resolution` cells wide.
    EXPECT_LT(worst, 2 * 2 * hole / static_cast<double>(resolution)) << resolution;
    return worst;
  };
  const double coarse = error_of(Dim == 2 ? 4 : 3);
  const double fine = error_of(Dim == 2 ? 32 : 9);
  EXPECT_LT(fine, coarse);
}

// Rounding in nearly flat cells must not count as an improvement, which would never end.
TEST_IN_2D_AND_3D(DistanceWeightsTest, EndInFlatCells) {
  for (const auto shape : {Shape::kSimplex, Shape::kBox}) {
    for (const double flatness : {1e-4, 1e-5, 1e-6}) {
      auto sample = make_sample<Dim>(shape, Dim == 2 ? 30 : 8, 0.3);
      sample.mesh.points.row(Dim - 1) *= flatness;
      const auto& mesh = sample.mesh;
      const auto topology = build_topology(mesh);
      const distance::EikonalMesh<Dim> eikonal(mesh, topology);
      distance::March<Dim> march(eikonal);
      const double size = bounding_box_diagonal(mesh.points);
      for (Index source = 0; source < mesh.num_vertices(); source += 7) {
        for (const auto& arrival : march.run({source})) {
          ASSERT_GE(arrival.distance, 0) << flatness << ' ' << source;
          ASSERT_LT(arrival.distance, 1.1 * size) << flatness << ' ' << source;
        }
      }
    }
  }
}

TEST_IN_2D_AND_3D(DistanceWeightsTest, AreTheSameForAnyNumberOfThreads) {
  const auto sample = make_sample<Dim>(Shape::kRing, Dim == 2 ? 12 : 4, 0.2);
  const auto topology = build_topology(sample.mesh);
  const auto sources = boundary_values(sample.cage, sample.mesh, topology).control_vertices;
  expect_same_for_any_threads([&] { return geodesic_distances(sample.mesh, topology, sources); });
}

// A simplex of random shape.
template <int Dim>
DomainMesh<Dim> random_cell(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (;;) {
    DomainMesh<Dim> mesh;
    mesh.points = PointList<Dim>::NullaryExpr(Dim, Dim + 1, [&] { return uniform(random); });
    mesh.cells = CellList<Dim>(Dim + 1, 1);
    for (int k = 0; k <= Dim; ++k) mesh.cells(k, 0) = k;
    if (std::abs(signed_measure(mesh, 0)) < 0.1) continue;
    normalize_and_validate(mesh);
    return mesh;
  }
}

// A point beyond the side opposite to corner c. The ray from there to c crosses that side, or, if
// `misses`, its plane beside it.
template <int Dim>
Vector<Dim> source_beyond(const DomainMesh<Dim>& mesh, int c, bool misses, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.05, 1);
  const auto at = [&](int k) { return mesh.points.col(mesh.cells(k % (Dim + 1), 0)); };
  Vector<Dim> crossing = Vector<Dim>::Zero();
  double total = 0;
  for (int turn = 1; turn <= Dim; ++turn) {
    const bool is_beside = misses && turn == Dim;
    const double share = is_beside ? -0.5 * total : uniform(random);
    crossing += share * at(c + turn);
    total += share;
  }
  return at(c) + (crossing / total - at(c)) * (1 + 20 * uniform(random));
}

template <int Dim>
std::vector<float> distances_of_corners(const DomainMesh<Dim>& mesh, const Vector<Dim>& source) {
  std::vector<float> of;
  for (int k = 0; k <= Dim; ++k) {
    of.push_back(static_cast<float>((mesh.points.col(mesh.cells(k, 0)) - source).norm()));
  }
  return of;
}

template <int Dim>
float computed_distance(const distance::EikonalMesh<Dim>& eikonal, int c,
                        const std::vector<float>& of, float limit) {
  const auto& cell = eikonal.cells[0];
  if constexpr (Dim == 3) {
    return distance_through(cell, c, {of[c ^ 1], of[c ^ 2], of[c ^ 3]}, limit);
  } else {
    return distance_through(cell, c, of[(c + 1) % 3], of[(c + 2) % 3], limit);
  }
}

TEST_IN_2D_AND_3D(DistanceWeightsTest, RaysThroughACellAreExact) {
  const ThreadScope scope(1);  // waking others up takes longer than a cell
  std::mt19937 random(1);
  for (int round = 0; round < 500; ++round) {
    const auto mesh = random_cell<Dim>(random);
    const auto topology = build_topology(mesh);
    const distance::EikonalMesh<Dim> eikonal(mesh, topology);
    for (int c = 0; c <= Dim; ++c) {
      auto of = distances_of_corners<Dim>(mesh, source_beyond(mesh, c, false, random));
      EXPECT_NEAR(computed_distance(eikonal, c, of, 2 * of[c]), of[c], 1e-4f * of[c]);
      EXPECT_EQ(computed_distance(eikonal, c, of, 0.99f * of[c]), distance::kNone);
      of = distances_of_corners<Dim>(mesh, source_beyond(mesh, c, true, random));
      EXPECT_EQ(computed_distance(eikonal, c, of, 2 * of[c]), distance::kNone);
    }
  }
}

TEST_IN_2D_AND_3D(DistanceWeightsTest, SchemesAreOrderedAndInTheUnitInterval) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 4, 0.2);
  const auto& mesh = sample.mesh;
  const auto n = sample.cage.size();
  const DistanceMatrix given = DistanceMatrix::Random(n, mesh.num_vertices()).cwiseAbs();
  const auto square = WeightFunctions(DistanceScheme::kSquare, given, mesh, n).dense();
  const auto linear = WeightFunctions(DistanceScheme::kLinear, given, mesh, n).dense();
  const auto root = WeightFunctions(DistanceScheme::kSquareRoot, given, mesh, n).dense();
  const auto constant = WeightFunctions(DistanceScheme::kConstant, {}, mesh, n).dense();
  EXPECT_TRUE((constant.array() == 1).all());
  EXPECT_GE(square.minCoeff(), 0);
  EXPECT_LE(root.maxCoeff(), 1);
  EXPECT_TRUE((square.array() <= linear.array()).all());
  EXPECT_TRUE((linear.array() <= root.array()).all());
  EXPECT_LT((linear.cwiseAbs2() - square).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((root.cwiseAbs2() - linear).cwiseAbs().maxCoeff(), 1e-15);
  const Eigen::MatrixXd distances = given.cast<double>();
  const double mean = distances(0, mesh.cells(0, 0)) + distances(0, mesh.cells(1, 0)) +
                      distances(0, mesh.cells(2, 0)) +
                      (Dim == 3 ? distances(0, mesh.cells(Dim, 0)) : 0);
  EXPECT_NEAR(linear(0, 0), mean / (Dim + 1) / distances.maxCoeff(), 1e-14);
}

// Also if there are more vertices than cells.
TEST_IN_2D_AND_3D(DistanceWeightsTest, AreKeptAsTheyAreGiven) {
  DomainMesh<Dim> mesh;  // one cell
  mesh.points = PointList<Dim>::Identity(Dim, Dim + 1);
  mesh.cells.resize(Dim + 1, 1);
  for (int k = 0; k <= Dim; ++k) mesh.cells(k, 0) = k;
  const WeightFunctions phi(DistanceScheme::kLinear, DistanceMatrix::Ones(2, Dim + 1), mesh, 2);
  EXPECT_EQ(phi.size(), 2);
  EXPECT_EQ(phi.dense(), Eigen::MatrixXd::Ones(2, 1));
  const Eigen::MatrixXd values = Eigen::MatrixXd::Random(5, 7).cwiseAbs();
  const WeightFunctions given(values);
  EXPECT_EQ(given.rows(), 5);
  EXPECT_EQ(given.cols(), 7);
  EXPECT_EQ(given.dense(), values);
  EXPECT_EQ(given.col(1), values.col(1));
  EXPECT_EQ(given(2, 1), values(2, 1));
  EXPECT_EQ(WeightFunctions().size(), 0);
}

}  // namespace
}  // namespace flbc::testing

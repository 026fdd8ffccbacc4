// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/pointwise.h"

#include "coordinates/polygon_triangulation.h"
#include "flbc/cage_facts.h"
#include "flbc/green.h"
#include "support/cages_of_all_kinds.h"

namespace flbc::testing {
namespace {

template <int Dim>
std::vector<Coordinates> non_negative_coordinates() {
  std::vector<Coordinates> all{Coordinates::kMaxEntropy, Coordinates::kMaxLikelihood};
  if (Dim == 2) all.push_back(Coordinates::kBlended);
  return all;
}

// A regular polygon, or the regular octahedron.
template <int Dim>
Cage<Dim> regular_cage() {
  if constexpr (Dim == 2) {
    return regular_polygon(7);
  } else {
    return {
        PointList<3>{{1, -1, 0, 0, 0, 0}, {0, 0, 1, -1, 0, 0}, {0, 0, 0, 0, 1, -1}},
        FacetList<3>{{0, 2, 1, 3, 2, 1, 3, 0}, {2, 1, 3, 0, 0, 2, 1, 3}, {4, 4, 4, 4, 5, 5, 5, 5}}};
  }
}

// In a simplex, these promises have one solution: barycentric coordinates.
TEST_IN_2D_AND_3D(PointwiseTest, NonNegativeAndReproduceInEveryCage) {
  for (const auto& sample : cages<Dim>()) {
    for (const auto coordinates : non_negative_coordinates<Dim>()) {
      SCOPED_TRACE(sample.name + ", coordinates " + std::to_string(static_cast<int>(coordinates)));
      for (const auto& points : {sample.mesh.points, centers(sample.mesh)}) {
        const auto weights = pointwise_coordinates(sample.cage, points, coordinates);
        const auto quality = measure_quality(sample.cage.points, points, weights);
        EXPECT_LT(quality.max_partition_error, 1e-13);
        EXPECT_LT(quality.max_reproduction_error, 1e-12);
        EXPECT_GE(weights.minCoeff(), 0);
      }
    }
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, EqualAtTheCenterOfARegularCage) {
  const auto cage = regular_cage<Dim>();
  const PointList<Dim> center = PointList<Dim>::Zero(Dim, 1);
  for (const auto coordinates :
       {Coordinates::kMeanValue, Coordinates::kMaxEntropy, Coordinates::kMaxLikelihood}) {
    const auto weights = pointwise_coordinates(cage, center, coordinates);
    EXPECT_LT((weights.array() - 1.0 / cage.size()).abs().maxCoeff(), 1e-13);
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, LinearOnFacetsAndContinuousTowardThem) {
  for (const auto& sample : cages<Dim>()) {
    const auto& cage = sample.cage;
    const auto rest = control_points_and_normals<Dim>(cage, cage.points);
    auto all = non_negative_coordinates<Dim>();
    all.push_back(Coordinates::kMeanValue);
    for (const auto coordinates : all) {
      SCOPED_TRACE(sample.name + ", coordinates " + std::to_string(static_cast<int>(coordinates)));
      EXPECT_EQ(pointwise_coordinates(cage, cage.points, coordinates),
                WeightMatrix::Identity(cage.size(), cage.size()));
      for (Index f = 0; f < cage.facets.cols(); ++f) {
        Eigen::VectorXd expected = Eigen::VectorXd::Zero(cage.size());
        for (int k = 0; k < Dim; ++k) expected[cage.facets(k, f)] = 1 + 0.37 * k;
        expected /= expected.sum();
        const Vector<Dim> place = cage.points * expected;
        const auto on_facet = pointwise_coordinates<Dim>(cage, PointList<Dim>(place), coordinates);
        EXPECT_LT((on_facet - expected).cwiseAbs().maxCoeff(), 1e-12);
        for (int k = 3; k <= 11; ++k) {
          for (const double side : {-1.0, 1.0}) {
            const double distance = std::pow(10.0, -k);
            const PointList<Dim> near = place + side * distance * rest.col(cage.size() + f);
            if (k < 6 && !points_outside<Dim>(cage, near).empty()) continue;
            const auto there = pointwise_coordinates<Dim>(cage, near, coordinates);
            EXPECT_LT((there - expected).cwiseAbs().maxCoeff(), 200 * distance + 1e-11)
                << "facet " << f << " distance " << side * distance;
          }
        }
      }
    }
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, FollowRotationScaleAndOrientation) {
  for (const auto& sample : cages<Dim>()) {
    const auto points = centers(sample.mesh);
    Eigen::Matrix<double, Dim, Dim> rotation = Eigen::Matrix<double, Dim, Dim>::Identity();
    rotation.template topLeftCorner<2, 2>() = Eigen::Rotation2Dd(0.7).toRotationMatrix();
    // The blend depends on which vertices on a common circle are used.
    for (const auto coordinates :
         {Coordinates::kMeanValue, Coordinates::kMaxEntropy, Coordinates::kMaxLikelihood}) {
      const auto weights = pointwise_coordinates(sample.cage, points, coordinates);
      for (const double scale : {1e-25, 3.0, 1e25}) {
        auto moved = reversed(sample.cage);
        moved.points = scale * (rotation * moved.points);
        const PointList<Dim> moved_points = scale * (rotation * points);
        EXPECT_LT((pointwise_coordinates(moved, moved_points, coordinates) - weights)
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-9)
            << sample.name << " at scale " << scale;
      }
    }
  }
}

// At the maximum of entropy, log(w_i / m_i) is an affine function of c_i.
TEST_IN_2D_AND_3D(PointwiseTest, EntropyIsLargestRelativeToItsPriors) {
  for (const auto shape : {Shape::kBox, Shape::kCorner, Shape::kStar}) {
    const auto sample = make_sample<Dim>(shape, 2);
    const auto& cage = sample.cage;
    const auto points = centers(sample.mesh);
    const auto weights = maximum_entropy_coordinates(cage, points);
    const auto area = [](const Vector<Dim>& a, const Vector<Dim>& b) {
      Eigen::Matrix<double, Dim, 2> both;
      both << a, b;
      return std::sqrt((both.transpose() * both).determinant()) / 2;
    };
    for (Index p = 0; p < points.cols(); ++p) {
      Eigen::VectorXd relative = weights.col(p).array().log();
      for (Index f = 0; f < cage.facets.cols(); ++f) {
        std::vector<Vector<Dim>> seen;
        for (int k = 0; k < Dim; ++k) {
          seen.push_back(cage.points.col(cage.facets(k, f)) - points.col(p));
        }
        const double rho = Dim == 2 ? seen[0].norm() + seen[1].norm() - (seen[0] - seen[1]).norm()
                                    : area(seen[0], seen[1]) + area(seen[1], seen[2 % Dim]) +
                                          area(seen[2 % Dim], seen[0]) -
                                          area(seen[1] - seen[0], seen[2 % Dim] - seen[0]);
        const double unit =  // in 3D relative to the triangle
            Dim == 2 ? 1 : area(seen[1] - seen[0], seen[2 % Dim] - seen[0]);
        for (int k = 0; k < Dim; ++k) relative[cage.facets(k, f)] += std::log(rho / unit);
      }
      Eigen::MatrixXd affine(cage.size(), Dim + 1);
      affine << cage.points.transpose(), Eigen::VectorXd::Ones(cage.size());
      const Eigen::VectorXd fit = affine * least_squares(affine, relative);
      EXPECT_LT((relative - fit).cwiseAbs().maxCoeff(), 1e-7) << sample.name << " point " << p;
    }
  }
}

// The weights mu_i of the smoothed vectors u_i by a search along the gradient.
TEST(PointwiseTest2D, LikelihoodByAnotherImplementation) {
  for (const auto shape : {Shape::kBox, Shape::kCorner, Shape::kStar}) {
    const auto sample = make_sample<2>(shape, 2);
    const auto& cage = sample.cage;
    const auto n = cage.size();
    const auto points = centers(sample.mesh);
    const auto weights = maximum_likelihood_coordinates(cage, points);
    for (Index p = 0; p < points.cols(); ++p) {
      // Rows of a matrix express vectors by c_j - x.
      const Eigen::MatrixXd offsets = (cage.points.colwise() - points.col(p)).transpose();
      const auto unit_rows = [&](Eigen::MatrixXd rows) {
        const Eigen::MatrixXd vectors = rows * offsets;
        for (Index i = 0; i < rows.rows(); ++i) rows.row(i) /= vectors.row(i).norm();
        return rows;
      };
      const Eigen::MatrixXd projected = unit_rows(Eigen::MatrixXd::Identity(n, n));
      Eigen::MatrixXd edges = Eigen::MatrixXd::Zero(n, n);
      Eigen::MatrixXd incident = Eigen::MatrixXd::Zero(n, n);
      for (Index e = 0; e < n; ++e) {
        for (int k = 0; k < 2; ++k) {
          edges.row(e) += projected.row(cage.facets(k, e));
          incident(cage.facets(k, e), e) = 1;
        }
      }
      const Eigen::MatrixXd smoothed = unit_rows(incident * unit_rows(edges));
      const Eigen::MatrixXd vectors = smoothed * offsets;
      Vector<2> psi = Vector<2>::Zero();
      Eigen::VectorXd mu = Eigen::VectorXd::Ones(n);
      for (int step = 0; step < 20000; ++step) {
        psi += 0.02 / n * (vectors.transpose() * mu) / mu.maxCoeff();
        mu = (1 + (vectors * psi).array()).inverse();
      }
      Eigen::VectorXd expected = smoothed.transpose() * mu;
      expected /= expected.sum();
      EXPECT_LT((weights.col(p) - expected).cwiseAbs().maxCoeff(), 1e-6)
          << sample.name << " point " << p;
    }
  }
}

TEST(PointwiseTest2D, BlendOfAQuadrilateralIsItsMeanValue) {
  const auto cage = loop(PointList<2>{{0, 3, 1, 0.2}, {0, 0.3, 1, 2.5}});  // concave at 2
  PointList<2> points{{0.5, 1.5, 0.3}, {0.5, 0.4, 1.8}};
  EXPECT_LT((blended_coordinates(cage, points) - mean_value_coordinates(cage, points))
                .cwiseAbs()
                .maxCoeff(),
            1e-13);
}

TEST(PointwiseTest2D, BlendHasFewWeightsAndNoKinks) {
  for (const auto& sample : cages<2>()) {
    const auto points = centers(sample.mesh);
    const auto weights = blended_coordinates(sample.cage, points);
    for (Index p = 0; p < points.cols(); ++p) {
      EXPECT_LE((weights.col(p).array() > 0).count(), 6) << sample.name;
    }
  }
  // Along a line through several triangles, slopes change little between neighbors.
  const auto cage = regular_cage<2>();
  const Index count = 4001;
  PointList<2> line(2, count);
  for (Index k = 0; k < count; ++k) line.col(k) << -0.7 + 1.4 * k / count, 0.11 + 0.1 * k / count;
  const auto weights = blended_coordinates(cage, line);
  const Eigen::MatrixXd slopes =
      (weights.rightCols(count - 1) - weights.leftCols(count - 1)) * count;
  EXPECT_LT((slopes.rightCols(count - 2) - slopes.leftCols(count - 2)).cwiseAbs().maxCoeff(), 0.02);
}

TEST(PointwiseTest2D, TriangulationsFillThePolygonAndAreDelaunay) {
  for (const auto& sample : cages<2>()) {
    const auto& points = sample.cage.points;
    const auto triangulation = triangulate_polygon(sample.cage);
    const auto& triangles = triangulation.triangles;
    const auto& opposite = triangulation.opposite;
    double area = 0;
    for (Index t = 0; t < triangles.cols(); ++t) {
      const Vector<2> a = points.col(triangles(0, t)), b = points.col(triangles(1, t)),
                      c = points.col(triangles(2, t));
      Eigen::Matrix2d edges;
      edges << b - a, c - a;
      EXPECT_GT(edges.determinant(), 0);
      area += edges.determinant() / 2;
      for (int k = 0; k < 3; ++k) {
        if (opposite(k, t) < 0) continue;
        const auto angle = [&](Index at) {
          const Vector<2> u = points.col(triangles((k + 1) % 3, t)) - points.col(at);
          const Vector<2> v = points.col(triangles((k + 2) % 3, t)) - points.col(at);
          return std::acos(u.normalized().dot(v.normalized()));
        };
        EXPECT_LE(angle(triangles(k, t)) + angle(opposite(k, t)), kPi + 1e-7) << sample.name;
      }
    }
    EXPECT_NEAR(area, measure_cage(sample.cage).measure, 1e-12 * area) << sample.name;
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, NamesThePointOutside) {
  const auto cage = box_cage<Dim>(1);
  PointList<Dim> points = PointList<Dim>::Zero(Dim, 3);
  points(0, 1) = 1.5;
  for (const auto coordinates : non_negative_coordinates<Dim>()) {
    expect_error<InputError>([&] { pointwise_coordinates(cage, points, coordinates); },
                             {"point 1 at (1.5, 0"});
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, RefusesThoseThatNeedAMesh) {
  const auto cage = box_cage<Dim>(1);
  const PointList<Dim> points = PointList<Dim>::Zero(Dim, 1);
  EXPECT_THROW(pointwise_coordinates(cage, points, Coordinates::kHarmonic), OptionError);
  if (Dim == 3) {
    EXPECT_THROW(pointwise_coordinates(cage, points, Coordinates::kBlended), OptionError);
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, PartsHaveWeightsOfTheirOwn) {
  const auto left = box_cage<Dim>(1);
  auto right = left;
  right.points.row(0).array() += 5;
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 2, 0.3);
  points(0, 1) += 5;
  for (const auto coordinates : {Coordinates::kMeanValue, Coordinates::kMaxEntropy}) {
    const auto weights = pointwise_coordinates(join(left, right), points, coordinates);
    const PointList<Dim> first = points.leftCols(1);
    const auto alone = pointwise_coordinates(left, first, coordinates);
    EXPECT_EQ(weights.col(0).head(left.size()), alone);
    EXPECT_EQ(weights.col(0).tail(left.size()).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(weights.col(1).head(left.size()).cwiseAbs().maxCoeff(), 0);
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, PlacedPointsFollowThePolicy) {
  const auto cage = box_cage<Dim>(1);
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 3, 0.25);
  points(0, 1) = 1.5;
  points(0, 2) = 1 + 1e-8;
  EXPECT_THROW(place_points(cage, points), InputError);
  for (const auto policy : {OutsidePoints::kNearest, OutsidePoints::kExtend}) {
    const auto placement = place_points(cage, points, policy);
    EXPECT_EQ(placement.outside.size(), 1U);
    EXPECT_EQ(placement.on_cage.size(), 1U);
    const auto weights = pointwise_coordinates(cage, placement, Coordinates::kMaxEntropy, false);
    const PointList<Dim> first = points.leftCols(1);
    EXPECT_EQ(weights.at(0), pointwise_coordinates(cage, first, Coordinates::kMaxEntropy).col(0));
    const PointList<Dim> made = cage.points * weights.dense();
    EXPECT_LT((made - placement.points).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_NEAR(placement.points(0, 1), policy == OutsidePoints::kNearest ? 1 : 1.5, 1e-12);
  }
}

TEST_IN_2D_AND_3D(PointwiseTest, SameBitsForAnyNumberOfThreads) {
  const auto sample = make_sample<Dim>(Shape::kStar, 3);
  const auto points = centers(sample.mesh);
  auto all = non_negative_coordinates<Dim>();
  all.push_back(Coordinates::kMeanValue);
  for (const auto coordinates : all) {
    expect_same_for_any_threads(
        [&] { return pointwise_coordinates(sample.cage, points, coordinates); });
  }
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/green.h"

#include "flbc/coordinates.h"
#include "flbc/deform.h"
#include "support/cages_of_all_kinds.h"

namespace flbc::testing {
namespace {

template <int Dim>
Eigen::Matrix<double, Dim, Dim> some_rotation() {
  if constexpr (Dim == 2) return Eigen::Rotation2Dd(0.7).toRotationMatrix();
  if constexpr (Dim == 3) {
    return Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  }
}

TEST_IN_2D_AND_3D(GreenTest, ReproduceSimilaritiesInEveryCage) {
  for (const auto& sample : cages<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto& cage = sample.cage;
    for (const auto& points : {sample.mesh.points, centers(sample.mesh)}) {
      const auto weights = green_coordinates(cage, points);
      ASSERT_EQ(weights.rows(), cage.size() + cage.facets.cols());
      EXPECT_LT((weights.topRows(cage.size()).colwise().sum().array() - 1).abs().maxCoeff(), 1e-13);
      const auto move = [](const PointList<Dim>& places) -> PointList<Dim> {
        return ((2.5 * some_rotation<Dim>()) * places).array() + 0.3;
      };
      const auto posed = control_points_and_normals<Dim>(cage, move(cage.points));
      const auto moved = deform<Dim>(weights, posed);
      EXPECT_LT((moved - move(points)).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

// Sums over the pieces of a facet.
template <int Dim, class Action>
void for_pieces(const Eigen::Matrix<double, Dim, Dim>& corners, int pieces, const Action& action) {
  if constexpr (Dim == 2) {
    for (int k = 0; k < pieces; ++k) {
      const double t = (k + 0.5) / pieces;
      action(Vector<2>(1 - t, t), (corners.col(1) - corners.col(0)).norm() / pieces);
    }
  } else {
    const double area =
        (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm() / 2;
    for (int i = 0; i < pieces; ++i) {
      for (int j = 0; i + j < pieces; ++j) {
        for (const double third : {1.0 / 3, 2.0 / 3}) {
          if (third > 0.5 && i + j + 2 > pieces) continue;
          const Vector<3> place((i + third) / pieces, (j + third) / pieces,
                                1 - (i + j + 2 * third) / pieces);
          action(place, area / (pieces * pieces));
        }
      }
    }
  }
}

TEST_IN_2D_AND_3D(GreenTest, AreTheIntegralsThatDefineThem) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 1);
  const auto& cage = sample.cage;
  const PointList<Dim> points = Vector<Dim>::Constant(0.45);
  const auto normals =
      control_points_and_normals<Dim>(cage, cage.points).rightCols(cage.facets.cols());
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(cage.size() + cage.facets.cols());
  for (Index f = 0; f < cage.facets.cols(); ++f) {
    const Eigen::Matrix<double, Dim, Dim> corners = cage.points(Eigen::all, cage.facets.col(f));
    for_pieces<Dim>(corners, Dim == 2 ? 4000 : 300, [&](const Vector<Dim>& place, double measure) {
      const Vector<Dim> to = corners * place - points.col(0);
      const double r = to.norm();
      const double full_angle = Dim == 2 ? 2 * kPi : 4 * kPi;
      const double along = to.dot(normals.col(f)) / (full_angle * std::pow(r, Dim));
      for (int k = 0; k < Dim; ++k) expected[cage.facets(k, f)] += measure * along * place[k];
      expected[cage.size() + f] += measure * (Dim == 2 ? -std::log(r) : 1 / r) / full_angle;
    });
  }
  EXPECT_LT((green_coordinates(cage, points).col(0) - expected).cwiseAbs().maxCoeff(),
            Dim == 2 ? 1e-7 : 1e-5);
}

TEST_IN_2D_AND_3D(GreenTest, ContinuousUpToTheCageAndRefusedOutside) {
  for (const auto& sample : cages<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto& cage = sample.cage;
    const auto rest = control_points_and_normals<Dim>(cage, cage.points);
    for (Index f = 0; f < cage.facets.cols(); ++f) {
      Vector<Dim> place = Vector<Dim>::Zero();
      for (int k = 0; k < Dim; ++k) place += cage.points.col(cage.facets(k, f)) * (1 + 0.4 * k);
      place /= Dim == 2 ? 2.4 : 4.2;
      const Vector<Dim> normal = rest.col(cage.size() + f);
      const auto on_cage = green_coordinates<Dim>(cage, PointList<Dim>(place));
      const auto inside = green_coordinates<Dim>(cage, PointList<Dim>(place - 1e-9 * normal));
      EXPECT_LT((on_cage - inside).cwiseAbs().maxCoeff(), 2e-7);
      EXPECT_THROW(green_coordinates<Dim>(cage, PointList<Dim>(place + 1e-3 * normal)), InputError);
    }
    const auto at_corners = green_coordinates<Dim>(cage, cage.points);
    EXPECT_LT((deform<Dim>(at_corners, rest) - cage.points).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(GreenTest, NamesRefuseThemAndPosesNeedAllControlPoints) {
  const auto sample = make_sample<2>(Shape::kStar, 2);
  EXPECT_THROW(compute_coordinates(sample.cage, sample.mesh, Coordinates::kGreen), OptionError);
  EXPECT_THROW(control_points_and_normals<2>(sample.cage, PointList<2>::Zero(2, 3)), InputError);
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// From points back to control points.
#include <random>

#include "flbc/errors.h"
#include "support/box_column.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
struct FitTest {
  FitTest() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (auto* list : {&gradients, &pose}) {
      for (Eigen::Index k = 0; k < list->size(); ++k) list->data()[k] = number(random);
    }
    pose = binding.cage.points + 0.3 * pose;
  }
  Binding<Dim> binding = box_column<Dim>();
  PointList<Dim> gradients{Dim, binding.points.cols()}, pose{Dim, binding.cage.size()};
};

// <g, W dc> = <W^T g, dc>
TEST_IN_2D_AND_3D(FitTest, TheAdjointIsTheTransposeOfDeform) {
  FitTest<Dim> t;
  const auto expect_transposed = [&](const Binding<Dim>& binding, const PointList<Dim>& pose) {
    const PointList<Dim> moves = binding.deform(pose) - binding.rest();
    const double forward = t.gradients.cwiseProduct(moves).sum();
    const PointList<Dim> sums = binding.adjoint(t.gradients);
    EXPECT_NEAR(sums.cwiseProduct(pose - binding.cage.points).sum(), forward, 1e-12);
  };
  expect_transposed(t.binding, t.pose);
  const auto joined = t.binding.joined({});
  auto free = t.pose;
  for (const Index i : joined.held) free.col(i) = joined.cage.points.col(i);
  expect_transposed(joined, free);
  const PointList<Dim> of_joint = joined.adjoint(t.gradients);
  for (const Index i : joined.held) EXPECT_TRUE(of_joint.col(i).isZero(0));
}

TEST_IN_2D_AND_3D(FitTest, ThePoseOfTheTargetsComesBack) {
  FitTest<Dim> t;
  const auto targets = t.binding.deform(t.pose);
  const auto fit = t.binding.fit(targets, {{}, {}, 0});
  EXPECT_LT((fit.control_points - t.pose).cwiseAbs().maxCoeff(), 1e-12 * fit.condition);
  EXPECT_LT(fit.largest, 1e-10);
  EXPECT_LE(fit.rms, fit.largest);
  // Some points, and control points at rest.
  FitOptions some{{}, {0, 1}, 0};
  for (Index p = 0; p < t.binding.points.cols(); ++p) {
    if (t.binding.points(0, p) > -0.5) some.points.push_back(p);
  }
  auto pose = t.pose;
  for (const Index i : some.held) pose.col(i) = t.binding.cage.points.col(i);
  const PointList<Dim> some_targets = t.binding.deform(pose)(Eigen::all, some.points);
  EXPECT_LT((t.binding.fit(some_targets, some).control_points - pose).cwiseAbs().maxCoeff(), 1e-9);
}

// At the minimum, the residual is orthogonal to every movement of a control point.
TEST_IN_2D_AND_3D(FitTest, TheResidualIsOrthogonal) {
  FitTest<Dim> t;
  const PointList<Dim> targets = t.binding.deform(t.pose) + 0.01 * t.gradients;
  const auto fit = t.binding.fit(targets, {{}, {}, 0});
  const PointList<Dim> missing = targets - t.binding.deform(fit.control_points);
  EXPECT_LT(t.binding.adjoint(missing).cwiseAbs().maxCoeff(), 1e-11);
  EXPECT_NEAR(fit.rms, std::sqrt(missing.colwise().squaredNorm().mean()), 1e-14);
  EXPECT_NEAR(fit.largest, missing.col(fit.worst).norm(), 1e-14);
  // Stiffness smooths the pose, at the cost of the residual.
  const auto stiff = t.binding.fit(targets, {{}, {}, 1});
  EXPECT_GT(stiff.rms, fit.rms);
  EXPECT_LT(stiff.condition, fit.condition);
}

TEST_IN_2D_AND_3D(FitTest, RefusesWhatIsNotDetermined) {
  FitTest<Dim> t;
  const PointList<Dim> one = t.binding.points.rightCols(1);
  const auto last = static_cast<Index>(t.binding.points.cols() - 1);
  expect_error<InputError>(
      [&] {
        t.binding.fit(one, {{last}, {}, 0});
      },
      {"do not determine control point", "stiffness"});
  EXPECT_LT(t.binding.fit(one, {{last}, {}, 1e-5}).largest, 1e-9);
  expect_error<InputError>([&] { t.binding.fit(one); }, {"targets of 1 points"});
  expect_error<InputError>([&] { t.binding.fit(one, {{-1}, {}, 0}); }, {"no point -1"});
  expect_error<InputError>([&] { t.binding.fit(one, {{last}, {99}, 0}); }, {"control point 99"});
  expect_error<OptionError>([&] { t.binding.fit(one, {{last}, {}, -1}); }, {"stiffness"});
  expect_error<InputError>([&] { t.binding.adjoint(one); }, {"gradients of 1 points"});
}

}  // namespace
}  // namespace flbc::testing

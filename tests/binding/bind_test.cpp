// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/binding.h"
#include "flbc/rig.h"

#include <cmath>
#include <limits>

#include "support/refined_sample.h"

namespace flbc::testing {
namespace {

// Points inside a box of half size 1, and one outside.
template <int Dim>
PointList<Dim> model(bool with_outside) {
  PointList<Dim> points(Dim, 40);
  for (Index p = 0; p < 40; ++p) {
    for (int d = 0; d < Dim; ++d) points(d, p) = 0.9 * std::sin(1.7 * (p + 1) * (d + 1));
  }
  if (with_outside) points.col(7) = Vector<Dim>::Unit(0) * 1.5;
  return points;
}

template <int Dim>
Sample<Dim> box() {
  auto sample = refined_sample<Dim>(Shape::kBox, 2);
  const Vector<Dim> low = sample.cage.points.rowwise().minCoeff();
  const Vector<Dim> high = sample.cage.points.rowwise().maxCoeff();
  const auto fit = [&](auto& points) {
    points = (points.colwise() - (low + high) / 2).array().colwise() / ((high - low) / 2).array();
  };
  fit(sample.cage.points);
  fit(sample.mesh.points);
  return sample;
}

template <int Dim>
Binding<Dim> bound(OutsidePoints outside, bool with_outside, Index max_influences = 0) {
  const auto sample = box<Dim>();
  BindOptions options;
  options.outside = outside;
  options.max_influences = max_influences;
  return Rig<Dim>(sample.cage, sample.mesh, model<Dim>(with_outside), {}, options).bind();
}

// More points than are placed at once, some of them outside.
TEST_IN_2D_AND_3D(BindTest, ManyPointsMoveAsThoseOfATransferredBinding) {
  constexpr Index kMany = 70000;
  const auto binding = bound<Dim>(OutsidePoints::kFail, false);
  PointList<Dim> points(Dim, kMany);
  for (Index p = 0; p < kMany; ++p) {
    for (int d = 0; d < Dim; ++d) points(d, p) = 1.01 * std::sin(1.7 * (p + 1) * (d + 1));
  }
  const PointList<Dim> pose = binding.cage.points.array().sin();
  const auto policy = OutsidePoints::kNearest;
  EXPECT_EQ(binding.deform(pose, points, policy),
            binding.transferred(points, {}, policy).deform(pose));
  expect_error<InputError>([&] { binding.deform(pose, points, OutsidePoints::kFail); },
                           {"outside"});
}

TEST_IN_2D_AND_3D(BindTest, PointsOutsideFollowTheirPolicy) {
  const auto cage = box<Dim>().cage;
  const auto points = model<Dim>(true);
  const Vector<Dim> shift = Vector<Dim>::LinSpaced(0.2, 0.4);
  EXPECT_THROW(bound<Dim>(OutsidePoints::kFail, true), InputError);
  for (const auto policy :
       {OutsidePoints::kNearest, OutsidePoints::kKeep, OutsidePoints::kExtend}) {
    for (const Index few : {0, Dim + 1}) {
      const auto binding = bound<Dim>(policy, true, few);
      EXPECT_EQ(binding.outside, std::vector<Index>{7});
      EXPECT_EQ(binding.report.outside, 1);
      EXPECT_LT((binding.deform(cage.points) - points).cwiseAbs().maxCoeff(), 1e-13);
      const PointList<Dim> pose = cage.points.colwise() + shift;
      PointList<Dim> moved(Dim, points.cols());
      binding.deform_into(pose, moved);
      EXPECT_EQ(moved, binding.deform(pose));
      EXPECT_THROW(binding.deform_into(pose, moved.leftCols(3)), InputError);
      const Vector<Dim> expected = policy == OutsidePoints::kKeep ? Vector<Dim>::Zero() : shift;
      EXPECT_LT((moved.col(7) - points.col(7) - expected).cwiseAbs().maxCoeff(), 1e-13);
      EXPECT_EQ(binding.offsets.cols() > 0, policy != OutsidePoints::kExtend);
    }
  }
}

TEST_IN_2D_AND_3D(BindTest, MeshesTheCageAndSaysHow) {
  const auto sample = box<Dim>();
  BindOptions options;
  options.vertices = 77;
  const Meshers<Dim> meshers{
      {{"mine", [&](const Cage<Dim>& cage, const MeshingOptions<Dim>& meshing) {
          EXPECT_EQ(cage.points, sample.cage.points);
          EXPECT_EQ(meshing.vertices, 77);
          return sample.mesh;
        }}}};
  const auto binding = Rig<Dim>(sample.cage, model<Dim>(false), {}, options, meshers).bind();
  EXPECT_EQ(binding.report.mesher, "mine");
  EXPECT_TRUE(binding.weights ==
              Rig<Dim>(sample.cage, sample.mesh, model<Dim>(false), {}, options).bind().weights);
}

TEST_IN_2D_AND_3D(BindTest, RefusesWhatItCannotBind) {
  const auto sample = box<Dim>();
  const auto refused = [&](const char* words, const PointList<Dim>& points, const EdgeList& edges,
                           const BindOptions& options) {
    expect_refused<Error>(
        words, [&] { Rig<Dim>(sample.cage, sample.mesh, points, edges, options).bind(); });
  };
  refused("no vertices", PointList<Dim>(Dim, 0), {}, {});
  PointList<Dim> infinite = model<Dim>(false);
  infinite(0, 3) = std::numeric_limits<double>::infinity();
  refused("finite", infinite, {}, {});
  refused("edge 0 ends at point 40", model<Dim>(false), {{{0, 40}}}, {});
  BindOptions few;
  few.max_influences = Dim;
  refused("fewer cannot reproduce", model<Dim>(false), {}, few);
  few.max_influences = -1;
  refused("max_influences", model<Dim>(false), {}, few);
}

}  // namespace
}  // namespace flbc::testing

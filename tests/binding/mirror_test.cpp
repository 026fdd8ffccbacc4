// SPDX-License-Identifier: BSD-3-Clause
// Exact mirror symmetry, in a mesh that is not symmetric.
#include "flbc/mirror.h"

#include "flbc/rig.h"
#include "support/errors.h"
#include "support/refined_sample.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

// Points of a symmetric box with their images, points in the plane, and a point without an image.
template <int Dim>
PointList<Dim> mirrored_points() {
  PointList<Dim> points = PointList<Dim>::Constant(Dim, 49, 0.4);
  for (Index k = 0; k < 20; ++k) {
    points(0, 2 * k) = 0.05 + 0.02 * k;
    points(Dim - 1, 2 * k) = 0.1 + 0.04 * ((7 * k) % 20);
    points.col(2 * k + 1) = points.col(2 * k);
    points(0, 2 * k + 1) = 1 - points(0, 2 * k);
  }
  for (Index k = 40; k < 48; ++k) {
    points(0, k) = 0.5;
    points(Dim - 1, k) = 0.1 * (k - 39);
  }
  points(0, 48) = 0.77;
  return points;
}

EdgeList mirrored_edges() {
  EdgeList edges;
  for (Index k = 0; k < 38; ++k) edges.ends.push_back({k, k + 2});
  for (Index k = 40; k < 47; ++k) edges.ends.push_back({k, k + 1});
  edges.ends.push_back({38, 44});
  edges.ends.push_back({39, 44});
  return edges;
}

template <int Dim>
Index image_of(const PointList<Dim>& points, Index p) {
  Vector<Dim> image = points.col(p);
  image[0] = 1 - image[0];
  for (Index q = 0; q < points.cols(); ++q) {
    if ((points.col(q) - image).norm() < 1e-9) return q;
  }
  return -1;
}

TEST_IN_2D_AND_3D(MirrorTest, MirroredPointsHaveMirroredWeights) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 4, 8);
  const auto points = mirrored_points<Dim>();
  BindOptions options;
  options.mirror_axis = 0;
  for (const bool masked : {false, true}) {
    if (masked) options.masks = {{{0}, {2, 4, 6}}};
    for (const Index most : {0, 8, Dim + 1}) {
      options.max_influences = most;
      const auto binding = bind<Dim>(cage, mesh, points, mirrored_edges(), options);
      for (Index p = 0; p < points.cols(); ++p) {
        const Index q = image_of<Dim>(points, p);
        if (q < 0 || (q == p && most == Dim + 1)) continue;
        const Eigen::VectorXd here = binding.weights.at(p), there = binding.weights.at(q);
        for (Index i = 0; i < cage.size(); ++i) {
          ASSERT_EQ(here[i], there[image_of<Dim>(cage.points, i)]) << p << ' ' << i;
        }
        EXPECT_LE((here.array() != 0).count(), most > 0 ? most : cage.size());
      }
      for (const Index p : {2, 4, 6}) {
        if (!masked) break;
        EXPECT_EQ(binding.weights.at(p)[0], 0);
        EXPECT_EQ(binding.weights.at(p + 1)[image_of<Dim>(cage.points, 0)], 0);
      }
      EXPECT_GE(binding.report.quality.min_weight, 0);
      EXPECT_LT((binding.deform(cage.points) - points).cwiseAbs().maxCoeff(), 1e-13);
    }
  }
  options = {};
  options.max_influences = 0;
  const auto free = bind<Dim>(cage, mesh, points, mirrored_edges(), options).weights.dense();
  options.mirror_axis = 0;
  const auto alike = bind<Dim>(cage, mesh, points, mirrored_edges(), options).weights.dense();
  EXPECT_GT((free - alike).norm(), 1e-6) << "the mesh is symmetric";
  EXPECT_LT((free - alike).cwiseAbs().maxCoeff(), 0.1);
}

TEST_IN_2D_AND_3D(MirrorTest, OtherCagesAreRefused) {
  const auto [cage, mesh, name] = with_fine_cage<Dim>(Shape::kBox, 2, 4);
  const auto points = mirrored_points<Dim>();
  expect_refused<OptionError>("no mirror axis",
                              [&, &cage = cage] { MirroredModel<Dim>(cage, Dim, points); });
  Cage<Dim> lopsided = cage;
  lopsided.points(0, 0) -= 0.1;
  expect_refused("has no mirror image across x = ",
                 [&] { MirroredModel<Dim>(lopsided, 0, points); });
  BindOptions options;  // before a solve, too
  options.mirror_axis = 0;
  expect_refused("has no mirror image across x = ",
                 [&, &mesh = mesh] { Rig<Dim>(lopsided, mesh, points, {}, options); });
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// What triangulate() and tetrahedralize() have in common.
#include "flbc/meshing.h"

#include "support/feasible_vertices.h"
#include "support/mesh_checks.h"
#include "support/model_cages.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

// Of sides 2 and 1, the outer one with a control point in the middle of an edge in 2D.
template <int Dim>
Cage<Dim> box_with_hole() {
  const auto hole = reversed(box_cage<Dim>(0.5));
  if constexpr (Dim == 2) {
    return join(loop(PointList<2>{{-1, 0.3, 1, 1, -1}, {-1, -1, -1, 1, 1}}), hole);
  } else {
    return join(box_cage<3>(1), hole);
  }
}

TEST_IN_2D_AND_3D(MeshersTest, OpenCagesIslandsAndSeparatePartsAreRefused) {
  expect_refused("open at", [] { fill<Dim>(without_facet(box_cage<Dim>(1), 1), {}); });
  const auto island = join(join(box_cage<Dim>(1), box_cage<Dim>(0.75)), box_cage<Dim>(0.5));
  EXPECT_THROW(fill<Dim>(island, {}), InputError);
  EXPECT_THROW(fill<Dim>(join(box_cage<Dim>(0, 1), box_cage<Dim>(2, 3)), {}), InputError);
}

TEST_IN_2D_AND_3D(MeshersTest, EmbeddedPointsFollowTheControlPoints) {
  const PointList<3> places{{0.1 + 0.2, -0.7, 0.123456789, -0.9999},
                            {0.75, 0.7, 0.987654321, 0.1 + 0.2},
                            {0.6, 0.1, 0.1, 0.33333}};
  const PointList<Dim> points = places.topRows<Dim>();
  const auto cage = box_with_hole<Dim>();
  for (const Index count : {0, 3000}) {
    const auto mesh = fill<Dim>(cage, vertices<Dim>(count, points));
    expect_fills(cage, mesh, Dim == 2 ? 3 : 7);
    expect_vertices<Dim>(mesh, cage.size(), points);
    if (count > 0) expect_count(mesh, count, Dim == 2 ? 0.05 : 0.10);
  }
}

TEST_IN_2D_AND_3D(MeshersTest, UnitsDoNotMatter) {
  auto cage = boundary_of(make_sample<Dim>(Shape::kStar, 1).mesh);
  Numbers numbers(5);
  cage.points += numbers.matrix(Dim, cage.size(), -0.02, 0.02);
  cage.points = (1e6 * cage.points).array().round() / 1e6;  // decimals, as in files
  const double size = bounding_box_diagonal(cage.points);
  const auto mesh = fill<Dim>(cage, vertices<Dim>(1500));
  for (const double unit : {0.001, 1000.0}) {
    SCOPED_TRACE(unit);
    const Cage<Dim> other{unit * cage.points, cage.facets};
    const auto scaled = fill<Dim>(other, vertices<Dim>(1500));
    expect_fills(other, scaled, std::abs(enclosed_measure(other)));
    ASSERT_EQ(scaled.num_vertices(), mesh.num_vertices());
    ASSERT_EQ(scaled.num_cells(), mesh.num_cells());
    EXPECT_LT((scaled.points / unit - mesh.points).cwiseAbs().maxCoeff(), 1e-12 * size);
  }
}

TEST_IN_2D_AND_3D(MeshersTest, PointsThatCannotBeEmbedded) {
  const auto cage = box_with_hole<Dim>();
  const auto refused = [&](const Vector<3>& second, const std::string& words) {
    PointList<Dim> points = PointList<Dim>::Constant(Dim, 2, 0.75);
    points.col(1) = second.head<Dim>();
    expect_refused(words, [&] { fill<Dim>(cage, vertices<Dim>(0, points)); });
  };
  const std::string place = Dim == 2 ? "(2, 0.5)" : "(2, 0.5, 0)";
  refused({2, 0.5, 0}, "point 1 at " + place + " cannot be embedded: it is outside");
  refused({0, 0.1, 0.2}, "outside");  // in the hole
  refused({1, 0.2, 0.1}, "on the cage");
  refused({1, 1, 1}, "control point " + std::to_string(Dim == 2 ? 3 : 7));
  refused({1, 1, 1}, "distinct points");
  refused({0.75, 0.75, 0.75}, "coincides with point 0");
  refused({std::nan(""), 0.75, 0.75}, "not finite");
}

TEST_IN_2D_AND_3D(MeshersTest, WhatPollThrowsEndsThem) {
  struct Cancelled {};
  auto options = vertices<Dim>(3000);
  options.poll = [calls = 0]() mutable {
    if (++calls == 2) throw Cancelled();
  };
  EXPECT_THROW(fill<Dim>(box_with_hole<Dim>(), options), Cancelled);
}

TEST_IN_2D_AND_3D(MeshersTest, OptionsOutOfRange) {
  auto cage = box_with_hole<Dim>();
  // Bent, because where facets are coplanar the smallest mesh need not be the one returned.
  for (Index i = 0; i < cage.size(); ++i) cage.points(i % Dim, i) *= 1 + 0.01 * i;
  const Index fewest = fill<Dim>(cage, {}).num_vertices();
  expect_error<TooFewVertices>([&] { fill<Dim>(cage, vertices<Dim>(fewest / 2)); },
                               {"vertices: ", std::to_string(fewest)});
  EXPECT_THROW(fill<Dim>(cage, vertices<Dim>(-1)), OptionError);
  EXPECT_THROW(fill<Dim>(cage, vertices<Dim>(2000000000)), OptionError);
  MeshingOptions<Dim> no_time;
  no_time.time_limit = 0;
  EXPECT_THROW(fill<Dim>(cage, no_time), OptionError);
}

TEST_IN_2D_AND_3D(MeshersTest, RunsAgreeBitByBit) {
  expect_reproducible([] { return fill<Dim>(box_with_hole<Dim>(), vertices<Dim>(2000)); });
}

TEST_IN_2D_AND_3D(MeshersTest, RealModelEmbedded) {
  if (!has_model("3d/shark.obj")) GTEST_SKIP() << "the real models are absent";
  const auto cage = load_cage<Dim>(Dim == 2 ? "2d/woody-control-edgeset.obj" : "3d/shark_cage.obj");
  const auto model = load_cage<Dim>(Dim == 2 ? "2d/woody_model.obj" : "3d/shark.obj").points;
  const auto mesh = fill<Dim>(cage, vertices<Dim>(0, model));
  expect_fills(cage, mesh, std::abs(enclosed_measure(cage)));
  expect_vertices<Dim>(mesh, cage.size(), model);
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/meshing.h"

#include "flbc/cage_facts.h"
#include "support/mesh_checks.h"

namespace flbc::testing {
namespace {

// A box with a hole in which there is another box; and a large separate box.
template <int Dim>
Cage<Dim> three_parts() {
  return join(join(join(box_cage<Dim>(0.3), box_cage<Dim>(1)), reversed(box_cage<Dim>(0.6))),
              box_cage<Dim>(3, 6));
}

TEST_IN_2D_AND_3D(MeshInPartsTest, PartsAreThoseMadeAlone) {
  const auto cage = three_parts<Dim>();
  MeshingOptions<Dim> options{Dim == 2 ? 2000 : 6000};
  auto mesh = mesh_in_parts<Dim>(cage, options, fill<Dim>);
  EXPECT_NO_THROW(normalize_and_validate(mesh));
  const double measure = measure_cage(cage).measure;
  EXPECT_NEAR(total_volume(mesh), measure, 1e-10 * measure);
  EXPECT_EQ(PointList<Dim>(mesh.points.leftCols(cage.size())), cage.points);
  EXPECT_NEAR(mesh.num_vertices(), options.vertices, 0.15 * options.vertices);

  const auto parts = mesh_parts(mesh);
  const auto cages = cage_parts(cage);
  ASSERT_EQ(parts.size(), cages.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const double share = total_volume(parts[p].mesh) / measure;
    MeshingOptions<Dim> alone{static_cast<Index>(std::lround(share * options.vertices))};
    const auto expected = fill<Dim>(cages[p].cage, alone);
    EXPECT_EQ(parts[p].mesh.points, expected.points) << p;
    EXPECT_EQ(parts[p].mesh.cells, expected.cells) << p;
  }
}

// They follow all control points in the order given, whichever part they are in.
TEST_IN_2D_AND_3D(MeshInPartsTest, EmbedsEachPointInItsPart) {
  const auto cage = three_parts<Dim>();
  MeshingOptions<Dim> options;
  options.embedded_points.resize(Dim, 5);
  const double places[] = {4.1, 0.11, 0.81, -0.13, 5.3};
  for (int i = 0; i < 5; ++i) options.embedded_points.col(i).setConstant(places[i]);
  auto mesh = mesh_in_parts<Dim>(cage, options, fill<Dim>);
  EXPECT_NO_THROW(normalize_and_validate(mesh));
  EXPECT_EQ(PointList<Dim>(mesh.points.middleCols(cage.size(), 5)), options.embedded_points);

  options.embedded_points.col(3).setConstant(0.45);  // in the hole
  expect_refused("point 3 ", [&] { mesh_in_parts<Dim>(cage, options, fill<Dim>); });
}

TEST_IN_2D_AND_3D(MeshInPartsTest, NamesThePartThatFails) {
  const auto cage = three_parts<Dim>();
  const PartMesher<Dim> failing = [](const Cage<Dim>& part, const MeshingOptions<Dim>& options) {
    if (part.points.minCoeff() > 1) throw InputError("no");
    return fill<Dim>(part, options);
  };
  expect_error<InputError>(
      [&] { mesh_in_parts<Dim>(cage, {}, failing); },
      {"part 3 of 3, with control point " + std::to_string(3 << Dim) + " at (", ": no"});
}

}  // namespace
}  // namespace flbc::testing

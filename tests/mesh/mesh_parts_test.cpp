// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/domain_mesh.h"

#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
DomainMesh<Dim> moved(DomainMesh<Dim> mesh, double distance) {
  mesh.points.array() += distance;
  return mesh;
}

// Three meshes whose vertices take turns: v of mesh p is number 3 v + p as long as all have one.
template <int Dim>
std::vector<MeshPart<Dim>> three_parts() {
  std::vector<MeshPart<Dim>> parts{{moved(make_sample<Dim>(Shape::kBox, 3, 0.1).mesh, 0), {}},
                                   {moved(make_sample<Dim>(Shape::kSimplex, 4).mesh, 10), {}},
                                   {moved(make_sample<Dim>(Shape::kRing, 1).mesh, 20), {}}};
  Index next = 0, left = 3;
  for (Index v = 0; left > 0; ++v) {
    left = 0;
    for (auto& [mesh, vertices] : parts) {
      if (v >= mesh.num_vertices()) continue;
      vertices.push_back(next++);
      ++left;
    }
  }
  return parts;
}

TEST_IN_2D_AND_3D(MeshPartsTest, PartsOfTheJoinedAreTheParts) {
  const auto parts = three_parts<Dim>();
  auto whole = join_parts(parts);
  EXPECT_EQ(count_parts(whole), 3);
  ASSERT_NO_THROW(normalize_and_validate(whole));
  const auto found = mesh_parts(whole);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t p = 0; p < 3; ++p) {
    EXPECT_EQ(found[p].vertices, parts[p].vertices);
    EXPECT_EQ(found[p].mesh.points, parts[p].mesh.points);
    auto expected = parts[p].mesh;
    normalize_and_validate(expected);  // the whole's cells were turned
    EXPECT_EQ(found[p].mesh.cells, expected.cells);
  }
}

TEST_IN_2D_AND_3D(MeshPartsTest, OnePartIsTheWhole) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    EXPECT_EQ(count_parts(sample.mesh), 1);
    const auto parts = mesh_parts(sample.mesh);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].mesh.points, sample.mesh.points);
    EXPECT_EQ(parts[0].mesh.cells, sample.mesh.cells);
    EXPECT_NO_THROW(require_connected(sample.mesh));
  }
}

TEST_IN_2D_AND_3D(MeshPartsTest, RefusalNamesAPlaceInEachOfTwoParts) {
  expect_error<InputError>([&] { require_connected(join_parts(three_parts<Dim>())); },
                           {"3 parts, one with (0, 0", ", one with (10, 10"});
}

}  // namespace
}  // namespace flbc::testing

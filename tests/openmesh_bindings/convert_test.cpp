// SPDX-License-Identifier: BSD-3-Clause
// Conversion to a mesh and back is lossless.
#include "flbc/openmesh/convert.h"

#include "flbc/cage_facts.h"
#include "support/hollow_sample.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

using PlanePoly = OpenMesh::PolyMesh_ArrayKernelT<PlanePoints>;
using openmesh::TetMesh;

// Simplices from the vertex with the least number on. \param is_sorted  else in the same sense
template <class Simplices>
std::multiset<std::vector<Index>> turned(const Simplices& simplices, bool is_sorted = false) {
  std::multiset<std::vector<Index>> all;
  for (const auto& simplex : simplices.colwise()) {
    std::vector<Index> vertices(simplex.begin(), simplex.end());
    std::rotate(vertices.begin(), std::min_element(vertices.begin(), vertices.end()),
                vertices.end());
    if (is_sorted) std::sort(vertices.begin(), vertices.end());
    all.insert(vertices);
  }
  return all;
}

template <class Mesh>
class ConvertSurface : public ::testing::Test {};
using Surfaces = ::testing::Types<DoubleTri, DoublePoly, FloatTri>;
TYPED_TEST_SUITE(ConvertSurface, Surfaces);

TYPED_TEST(ConvertSurface, CagesOfTrianglesComeBack) {
  const double exact = std::is_same_v<typename TypeParam::Scalar, double> ? 0 : 1e-6;
  auto all = samples<3>();
  all.push_back(make_hollow_sample<3>());
  for (const auto& sample : all) {
    SCOPED_TRACE(sample.name);
    const auto mesh = openmesh::to_mesh<TypeParam>(sample.cage);
    EXPECT_EQ(mesh.n_faces(), static_cast<std::size_t>(sample.cage.facets.cols()));
    const auto cage = openmesh::to_cage(mesh);
    EXPECT_LE((cage.points - sample.cage.points).cwiseAbs().maxCoeff(), exact);
    EXPECT_EQ(turned(cage.facets), turned(sample.cage.facets));
  }
}

TEST(ConvertCage, QuadsAreCut) {
  DoublePoly cube;
  for (int v = 0; v < 8; ++v) cube.add_vertex({v & 1, (v >> 1) & 1, (v >> 2) & 1});
  for (const auto& quad : std::vector<std::array<int, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const int vertex : quad) corners.emplace_back(vertex);
    cube.add_face(corners);
  }
  const auto cage = openmesh::to_cage(cube);
  EXPECT_EQ(cage.facets.cols(), 12);
  EXPECT_NO_THROW(validate(cage));
  EXPECT_NEAR(measure_cage(cage).measure, 1, 1e-14);
}

TEST(ConvertCage, SinglePolygonsAndDefectsAreNamed) {
  DoubleTri one;
  for (int v = 0; v < 3; ++v) one.add_vertex({v & 1, v >> 1, 0});
  one.add_face(one.vertex_handle(0), one.vertex_handle(1), one.vertex_handle(2));
  expect_refused("single polygon", [&] { openmesh::to_cage(one); });
  auto open = make_sample<3>(Shape::kBox, 1).cage;
  open.facets.conservativeResize(3, open.facets.cols() - 1);
  EXPECT_THROW(openmesh::to_mesh<DoubleTri>(open), InputError);
}

template <class Mesh>
class ConvertPlane : public ::testing::Test {};
using Planes = ::testing::Types<DoubleTri, PlaneTri>;
TYPED_TEST_SUITE(ConvertPlane, Planes);

TYPED_TEST(ConvertPlane, DomainsComeBackAndHaveTheCageAsOutline) {
  auto all = samples<2>();
  all.push_back(make_hollow_sample<2>());
  for (auto& sample : all) {
    SCOPED_TRACE(sample.name);
    normalize_and_validate(sample.mesh);
    const auto mesh = openmesh::to_mesh<TypeParam>(sample.mesh);
    const auto domain = openmesh::to_domain(mesh);
    EXPECT_EQ(domain.points, sample.mesh.points);
    EXPECT_EQ(turned(domain.cells), turned(sample.mesh.cells));

    const auto outline = openmesh::to_outline(mesh);
    EXPECT_NO_THROW(validate(outline));
    const auto facts = measure_cage(outline), expected = measure_cage(sample.cage);
    EXPECT_NEAR(facts.measure, expected.measure, 1e-12);
    EXPECT_EQ(facts.parts, expected.parts);
    EXPECT_EQ(facts.holes, expected.holes);
    const auto vertices = openmesh::outline_vertices(mesh);
    ASSERT_EQ(static_cast<Eigen::Index>(vertices.size()), outline.points.cols());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      EXPECT_EQ(outline.points.col(i), sample.mesh.points.col(vertices[i].idx()));
    }
  }
}

TEST(ConvertOutline, PolygonsComeBack) {
  for (const auto shape : {Shape::kBox, Shape::kCorner}) {
    const auto cage = make_sample<2>(shape, 1).cage;
    const auto mesh = openmesh::to_mesh<PlanePoly>(cage);
    EXPECT_EQ(mesh.n_faces(), 1U);
    const auto back = openmesh::to_outline(mesh);
    EXPECT_EQ(back.points, cage.points);
    EXPECT_EQ(turned(back.facets, true), turned(cage.facets, true));
    // Facets of free orientation make the same polygon.
    auto mixed = cage;
    std::swap(mixed.facets(0, 1), mixed.facets(1, 1));
    EXPECT_EQ(openmesh::to_outline(openmesh::to_mesh<PlanePoly>(mixed)).facets, back.facets);
  }
  expect_refused("several loops",
                 [] { openmesh::to_mesh<PlanePoly>(make_hollow_sample<2>().cage); });
}

TEST(ConvertTets, DomainsComeBack) {
  for (auto& sample : samples<3>()) {
    auto expected = sample.mesh;
    normalize_and_validate(expected);
    const auto domain = openmesh::to_domain(openmesh::to_mesh(expected));
    EXPECT_EQ(domain.points, expected.points);
    EXPECT_EQ(domain.cells, expected.cells);
  }
}

TEST(ConvertMatrices, PointsAreSetAndTheirNumberIsChecked) {
  const auto sample = make_sample<2>(Shape::kBox, 2);
  auto mesh = openmesh::to_mesh<DoubleTri>(sample.mesh);
  for (const auto v : mesh.vertices()) mesh.set_point(v, mesh.point(v) + OpenMesh::Vec3d(0, 0, 7));
  const PointList<2> moved = 2 * sample.mesh.points;
  openmesh::set_points(mesh, moved);
  EXPECT_EQ(openmesh::points_of<2>(mesh), moved);
  EXPECT_EQ(openmesh::points_of<3>(mesh).row(2).minCoeff(), 7);
  expect_refused("are not those of a mesh with",
                 [&] { openmesh::set_points(mesh, PointList<2>(moved.leftCols(3))); });
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_mesh.h"

#include "flbc/openmesh/domain.h"
#include "support/io_files.h"
#include "support/test.h"

namespace flbc::openmesh {
namespace {

using flbc::testing::bit_equal;
using flbc::testing::expect_error;
using flbc::testing::Shape;
using OpenMesh::EPropHandleT;
using OpenMesh::FPropHandleT;
using OpenMesh::MPropHandleT;
using OpenMesh::VPropHandleT;
using Vertex = OpenMesh::VertexHandle;

std::vector<DomainMesh<3>> meshes() {
  std::vector<DomainMesh<3>> result;
  for (const Shape shape :
       {Shape::kSimplex, Shape::kBox, Shape::kCorner, Shape::kRing, Shape::kStar}) {
    for (const Index k : {1, 3}) {
      result.push_back(flbc::testing::make_sample<3>(shape, k).mesh);
      normalize_and_validate(result.back());
    }
  }
  return result;
}

template <class Range>
std::vector<int> indices(const Range& range) {
  std::vector<int> result;
  for (const auto handle : range) result.push_back(handle.idx());
  return result;
}

template <class Range>
std::vector<int> sorted(const Range& range) {
  auto result = indices(range);
  std::sort(result.begin(), result.end());
  return result;
}

TEST(TetMesh, KeepsPointsAndCells) {
  for (const auto& mesh : meshes()) {
    const auto tets = TetMesh::from(mesh);
    EXPECT_TRUE(bit_equal(tets.domain().points, mesh.points));
    EXPECT_EQ(tets.domain().cells, mesh.cells);
    EXPECT_EQ(tets.n_vertices(), static_cast<std::size_t>(mesh.num_vertices()));
    EXPECT_EQ(tets.n_cells(), static_cast<std::size_t>(mesh.num_cells()));
    EXPECT_EQ(tets.vertices().size(), tets.n_vertices());
    EXPECT_EQ(indices(tets.cells()).size(), tets.n_cells());
    EXPECT_EQ(indices(tets.cells()).back(), mesh.num_cells() - 1);
  }
}

TEST(TetMesh, FacesAndCells) {
  for (const auto& mesh : meshes()) {
    const auto tets = TetMesh::from(mesh);
    for (const auto c : tets.cells()) {
      const auto vertices = tets.cv_range(c);
      const auto faces = tets.cf_range(c);
      ASSERT_EQ(faces.size(), 4u);
      bool on_boundary = false;
      for (std::size_t k = 0; k < 4; ++k) {
        auto expected = sorted(vertices);
        expected.erase(std::find(expected.begin(), expected.end(), vertices[k].idx()));
        ASSERT_EQ(sorted(tets.fv_range(faces[k])), expected);
        const auto cells = indices(tets.fc_range(faces[k]));
        ASSERT_EQ(std::count(cells.begin(), cells.end(), c.idx()), 1);
        on_boundary |= cells.size() == 1;
      }
      EXPECT_EQ(tets.is_boundary(c), on_boundary);
    }
    std::set<std::vector<int>> different;
    for (const auto f : tets.faces()) {
      different.insert(sorted(tets.fv_range(f)));
      const auto cells = indices(tets.fc_range(f));
      ASSERT_TRUE(cells.size() == 1 || (cells.size() == 2 && cells[0] < cells[1]));
      ASSERT_EQ(tets.fc_range(f).size(), cells.size());
      EXPECT_EQ(tets.is_boundary(f), cells.size() == 1);
      for (const int c : cells) {
        const auto faces = indices(tets.cf_range(CellHandle(c)));
        EXPECT_EQ(std::count(faces.begin(), faces.end(), f.idx()), 1);
      }
    }
    EXPECT_EQ(different.size(), tets.n_faces());
  }
}

TEST(TetMesh, NeighboursOfVerticesAgainstBruteForce) {
  for (const auto& mesh : meshes()) {
    const auto tets = TetMesh::from(mesh);
    std::set<std::pair<int, int>> pairs;
    std::vector<std::vector<int>> cells(tets.n_vertices());
    std::vector<std::set<int>> neighbours(tets.n_vertices());
    for (Index s = 0; s < mesh.num_cells(); ++s) {
      for (const Index a : mesh.cells.col(s)) {
        cells[a].push_back(s);
        for (const Index b : mesh.cells.col(s)) {
          if (a != b) neighbours[a].insert(b);
          if (a < b) pairs.emplace(a, b);
        }
      }
    }
    EXPECT_EQ(tets.n_edges(), pairs.size());
    for (const auto v : tets.vertices()) {
      EXPECT_EQ(indices(tets.vc_range(v)), cells[v.idx()]);
      EXPECT_EQ(tets.vc_range(v).size(), cells[v.idx()].size());
      const auto others = indices(tets.vv_range(v));
      EXPECT_EQ(others.size(), neighbours[v.idx()].size());
      EXPECT_EQ(std::set<int>(others.begin(), others.end()), neighbours[v.idx()]);
      const auto edges = indices(tets.ve_range(v));
      ASSERT_EQ(edges.size(), others.size());
      for (std::size_t k = 0; k < edges.size(); ++k) {
        const auto ends = tets.ev_range(OpenMesh::EdgeHandle(edges[k]));
        EXPECT_LT(ends[0], ends[1]);
        EXPECT_EQ(sorted(ends),
                  (std::vector<int>{std::min(v.idx(), others[k]), std::max(v.idx(), others[k])}));
        EXPECT_EQ(tets.find_edge(v, Vertex(others[k])).idx(), edges[k]);
      }
    }
  }
}

TEST(TetMesh, ManyCellsAroundOneEdge) {
  // A fan around the edge of vertices 0 and 1: its faces crowd at two vertices.
  constexpr int kCells = 20000;
  DomainMesh<3> fan{PointList<3>(3, kCells + 2), CellList<3>(4, kCells)};
  fan.points.col(0) << 0, 0, 0;
  fan.points.col(1) << 0, 0, 1;
  for (int k = 0; k < kCells; ++k) {
    const double angle = 2 * M_PI * k / kCells;
    fan.points.col(2 + k) << std::cos(angle), std::sin(angle), 0;
    fan.cells.col(k) << 0, 2 + k, 2 + (k + 1) % kCells, 1;
  }
  TetMesh tets;
  tets.assign_valid(fan);
  EXPECT_EQ(tets.n_faces(), 3u * kCells);
  EXPECT_EQ(tets.n_edges(), 3u * kCells + 1);
  EXPECT_EQ(tets.vc_range(Vertex(0)).size(), static_cast<std::size_t>(kCells));
  EXPECT_FALSE(tets.is_boundary(tets.find_edge(Vertex(0), Vertex(1))));
  EXPECT_FALSE(tets.find_edge(Vertex(2), Vertex(4)).is_valid());
  EXPECT_FALSE(tets.find_edge(Vertex(2), Vertex(2)).is_valid());
  EXPECT_TRUE(tets.is_boundary(Vertex(0)));
}

TEST(TetMesh, RefusesDefectsAndKeepsItsElements) {
  const auto good = meshes()[0];
  TetMesh tets = TetMesh::from(good);
  auto flat = good;
  flat.points.row(2).setZero();
  expect_error<InputError>([&] { tets.assign(flat); }, {"cell 0", "degenerate"});
  expect_error<InputError>([&] { tets.assign({}); }, {"no cells"});
  auto crowded = good;
  crowded.cells = good.cells.col(0).replicate(1, 3);
  expect_error<InputError>([&] { tets.assign_valid(crowded); },
                           {"cells 0, 1 and 2", "share one facet"});
  EXPECT_EQ(tets.n_faces(), 4u);
  EXPECT_TRUE(bit_equal(tets.domain().points, good.points));
  EXPECT_EQ(tets.domain().cells, good.cells);
}

// The facets of a domain, in their own numbering and their own order of vertices.
TEST(TetMesh, DomainIsThatOfTheDomainMesh) {
  for (const auto& mesh : meshes()) {
    const auto expected = build_topology(mesh);
    const auto domain = make_domain(TetMesh::from(mesh));
    EXPECT_TRUE(bit_equal(domain.mesh.points, mesh.points));
    EXPECT_EQ(domain.mesh.cells, mesh.cells);
    EXPECT_EQ(domain.topology.facets, expected.facets);
    EXPECT_EQ(domain.topology.sides, expected.sides);
    EXPECT_EQ(domain.topology.cell_facets, expected.cell_facets);
  }
}

TEST(TetMesh, DomainTurnsInvertedCells) {
  for (const auto& mesh : meshes()) {
    DomainMesh<3> inverted = mesh;
    for (Index s = 0; s < mesh.num_cells(); s += 2) {
      std::swap(inverted.cells(s % 4, s), inverted.cells((s + 1) % 4, s));
    }
    TetMesh tets;
    tets.assign_valid(inverted);
    const auto domain = make_domain(tets);
    const auto& turned = domain.mesh;
    const auto& topology = domain.topology;
    normalize_and_validate(inverted);
    EXPECT_EQ(turned.cells, inverted.cells);
    for (Index s = 0; s < turned.num_cells(); ++s) {
      ASSERT_GT(signed_measure(turned, s), 0);
      for (Index k = 0; k < 4; ++k) {
        const Index f = topology.cell_facets(k, s);
        std::set<Index> corners(turned.cells.col(s).begin(), turned.cells.col(s).end());
        corners.erase(turned.cells(k, s));
        ASSERT_EQ(std::set<Index>(topology.facets.col(f).begin(), topology.facets.col(f).end()),
                  corners);
        ASSERT_TRUE(topology.sides(0, f) == s || topology.sides(1, f) == s);
        ASSERT_EQ(sorted(tets.fv_range(OpenMesh::FaceHandle(f))),
                  std::vector<int>(corners.begin(), corners.end()));
      }
    }
  }
}

TEST(TetMesh, DomainNamesDefects) {
  expect_error<InputError>([] { make_domain(TetMesh()); }, {"no cells"});
  auto mesh = meshes()[0];
  mesh.points.conservativeResize(3, 5);
  mesh.points.col(4).setConstant(7);
  TetMesh tets;
  tets.assign_valid(mesh);
  EXPECT_TRUE(tets.vc_range(Vertex(4)).empty() && tets.vv_range(Vertex(4)).empty());
  EXPECT_FALSE(tets.is_boundary(Vertex(4)));
  expect_error<InputError>([&] { make_domain(tets); }, {"vertex 4", "belongs to no cell"});
}

// ------------------------------------------------------------------------------------ properties

DomainMesh<3> box(Index subdivisions) {
  return flbc::testing::make_sample<3>(Shape::kBox, subdivisions).mesh;
}

template <class PropHandle>
class TetProperty : public ::testing::Test {};
using Handles =
    ::testing::Types<VPropHandleT<int>, EPropHandleT<int>, FPropHandleT<int>, CPropHandleT<int>>;
TYPED_TEST_SUITE(TetProperty, Handles);

TYPED_TEST(TetProperty, AddLookUpRemove) {
  using Handle = typename TypeParam::Handle;
  TetMesh mesh = TetMesh::from(box(2));
  TypeParam added;
  mesh.add_property(added, "numbers");
  ASSERT_TRUE(added.is_valid());
  EXPECT_EQ(mesh.property(added).n_elements(), mesh.n_elements<Handle>());
  EXPECT_EQ(mesh.property(added).name(), "numbers");
  mesh.property(added, Handle(2)) = 5;

  const TetMesh& constant = mesh;
  TypeParam found;
  EXPECT_TRUE(constant.get_property_handle(found, "numbers"));
  EXPECT_EQ(constant.property(found, Handle(2)), 5);
  EXPECT_EQ(constant.property(found)[2], 5);
  EXPECT_EQ(constant.property(found)[1], 0);

  // A property with another type, kind, or name is another property.
  CPropHandleT<float> of_other_type;
  MPropHandleT<int> of_mesh;
  EXPECT_FALSE(constant.get_property_handle(of_other_type, "numbers"));
  EXPECT_FALSE(constant.get_property_handle(of_mesh, "numbers"));
  EXPECT_FALSE(constant.get_property_handle(found, "Numbers"));
  EXPECT_FALSE(found.is_valid());

  mesh.remove_property(added);
  EXPECT_FALSE(added.is_valid());
  EXPECT_FALSE(mesh.get_property_handle(found, "numbers"));
}

TYPED_TEST(TetProperty, CopiesAreIndependent) {
  using Handle = typename TypeParam::Handle;
  TetMesh mesh = TetMesh::from(box(1));
  TypeParam handle;
  mesh.add_property(handle, "numbers");
  mesh.property(handle, Handle(1)) = 7;
  TetMesh copy(mesh), assigned = TetMesh::from(box(2));
  assigned = mesh;
  mesh.property(handle, Handle(1)) = 8;
  for (const TetMesh* other : {&copy, &assigned}) {
    EXPECT_EQ(other->n_cells(), mesh.n_cells());
    ASSERT_EQ(other->property(handle).n_elements(), mesh.n_elements<Handle>());
    EXPECT_EQ(other->property(handle, Handle(1)), 7);
  }
}

TYPED_TEST(TetProperty, AssigningKeepsAndResizes) {
  using Handle = typename TypeParam::Handle;
  TetMesh mesh = TetMesh::from(box(1));
  TypeParam handle;
  mesh.add_property(handle, "numbers");
  const int count = static_cast<int>(mesh.n_elements<Handle>());
  for (int k = 0; k < count; ++k) mesh.property(handle, Handle(k)) = 10 + k;
  for (const Index subdivisions : {3, 1}) {
    mesh.assign(box(subdivisions));
    ASSERT_EQ(mesh.property(handle).n_elements(), mesh.n_elements<Handle>());
    for (int k = 0; k < static_cast<int>(mesh.n_elements<Handle>()); ++k) {
      ASSERT_EQ(mesh.property(handle, Handle(k)), k < count ? 10 + k : 0);
    }
  }
}

}  // namespace
}  // namespace flbc::openmesh

// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "flbc/errors.h"
#include "flbc/openmesh/domain.h"
#include "support/io_files.h"
#include "support/sample_meshes.h"

namespace flbc::openmesh {
namespace {

using flbc::testing::bit_equal;
using flbc::testing::expect_error;
using flbc::testing::Shape;
using Vertex = OpenMesh::VertexHandle;

// The shapes and how many tunnels go through them.
std::vector<std::pair<DomainMesh<3>, int>> meshes() {
  std::vector<std::pair<DomainMesh<3>, int>> result;
  for (const Shape shape :
       {Shape::kSimplex, Shape::kBox, Shape::kCorner, Shape::kRing, Shape::kStar}) {
    for (const Index k : {1, 3}) {
      auto mesh = flbc::testing::make_sample<3>(shape, k).mesh;
      normalize_and_validate(mesh);
      result.emplace_back(std::move(mesh), shape == Shape::kRing ? 1 : 0);
    }
  }
  return result;
}

// By adding one element after the other.
TetMesh grown(const DomainMesh<3>& mesh) {
  TetMesh result;
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    result.add_vertex({mesh.points(0, v), mesh.points(1, v), mesh.points(2, v)});
  }
  for (const auto& cell : mesh.cells.colwise()) {
    result.add_cell(Vertex(cell[0]), Vertex(cell[1]), Vertex(cell[2]), Vertex(cell[3]));
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

// Everything there is to know about a mesh's neighbours.
std::vector<std::vector<int>> all_neighbours(const TetMesh& mesh) {
  std::vector<std::vector<int>> result;
  for (const auto c : mesh.cells()) {
    result.push_back(indices(mesh.cv_range(c)));
    result.push_back(indices(mesh.cf_range(c)));
    result.push_back({mesh.is_boundary(c)});
  }
  for (const auto f : mesh.faces()) {
    result.push_back(indices(mesh.fv_range(f)));
    result.push_back(indices(mesh.fc_range(f)));
    result.push_back({mesh.is_boundary(f)});
  }
  for (const auto e : mesh.edges()) {
    result.push_back(indices(mesh.ev_range(e)));
    result.push_back({mesh.is_boundary(e)});
  }
  for (const auto v : mesh.vertices()) {
    result.push_back(indices(mesh.vc_range(v)));
    result.push_back(indices(mesh.ve_range(v)));
    result.push_back(indices(mesh.vv_range(v)));
    result.push_back({mesh.is_boundary(v)});
  }
  return result;
}

TEST(TetMesh, KeepsPointsAndCells) {
  for (const auto& [mesh, tunnels] : meshes()) {
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

TEST(TetMesh, EulerCharacteristics) {
  for (const auto& [mesh, tunnels] : meshes()) {
    const auto tets = TetMesh::from(mesh);
    const auto count = [](std::size_t n) { return static_cast<int>(n); };
    EXPECT_EQ(count(tets.n_vertices()) - count(tets.n_edges()) + count(tets.n_faces()) -
                  count(tets.n_cells()),
              1 - tunnels);
    int vertices = 0, edges = 0, faces = 0;
    for (const auto v : tets.vertices()) vertices += tets.is_boundary(v);
    for (const auto e : tets.edges()) edges += tets.is_boundary(e);
    for (const auto f : tets.faces()) faces += tets.is_boundary(f);
    EXPECT_EQ(vertices - edges + faces, 2 - 2 * tunnels);
    EXPECT_EQ(2 * edges, 3 * faces);
  }
}

TEST(TetMesh, FacesAndCells) {
  for (const auto& [mesh, tunnels] : meshes()) {
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

// Faces look out of their first cell, so the boundary is a closed surface that looks outwards.
TEST(TetMesh, BoundaryIsAClosedSurface) {
  for (const auto& [mesh, tunnels] : meshes()) {
    const auto tets = TetMesh::from(mesh);
    std::map<std::pair<int, int>, int> directed_edges;
    double volume = 0;
    for (const auto f : tets.faces()) {
      if (!tets.is_boundary(f)) continue;
      const auto v = tets.fv_range(f);
      for (std::size_t k = 0; k < 3; ++k) ++directed_edges[{v[k].idx(), v[(k + 1) % 3].idx()}];
      volume += mesh.points.col(v[0].idx())
                    .dot(mesh.points.col(v[1].idx()).cross(mesh.points.col(v[2].idx()))) /
                6;
    }
    for (const auto& [edge, count] : directed_edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(directed_edges.count({edge.second, edge.first}), 1u);
    }
    double expected = 0;
    for (Index s = 0; s < mesh.num_cells(); ++s) expected += signed_measure(mesh, s);
    EXPECT_NEAR(volume, expected, 1e-12 * expected);
  }
}

TEST(TetMesh, NeighboursOfVerticesAgainstBruteForce) {
  for (const auto& [mesh, tunnels] : meshes()) {
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

TEST(TetMesh, BoundaryAgainstBruteForce) {
  for (const auto& [mesh, tunnels] : meshes()) {
    const auto tets = TetMesh::from(mesh);
    std::set<int> vertices;
    std::set<int> edges;
    for (const auto f : tets.faces()) {
      if (!tets.is_boundary(f)) continue;
      const auto v = tets.fv_range(f);
      for (std::size_t k = 0; k < 3; ++k) {
        vertices.insert(v[k].idx());
        edges.insert(tets.find_edge(v[k], v[(k + 1) % 3]).idx());
      }
    }
    for (const auto v : tets.vertices()) EXPECT_EQ(tets.is_boundary(v), vertices.count(v.idx()));
    for (const auto e : tets.edges()) EXPECT_EQ(tets.is_boundary(e), edges.count(e.idx()));
  }
}

TEST(TetMesh, FindsEdgesAndFaces) {
  const auto tets = TetMesh::from(meshes()[3].first);
  std::set<std::vector<int>> faces;
  for (const auto f : tets.faces()) {
    const auto v = tets.fv_range(f);
    faces.insert(sorted(v));
    EXPECT_EQ(tets.find_face(v[0], v[1], v[2]), f);
    EXPECT_EQ(tets.find_face(v[2], v[0], v[1]), f);
    EXPECT_EQ(tets.find_face(v[1], v[0], v[2]), f);
  }
  int missing = 0;
  for (const auto a : tets.vertices()) {
    EXPECT_FALSE(tets.find_edge(a, a).is_valid());
    for (const auto b : tets.vertices()) {
      const std::vector<int> key = {0, a.idx(), b.idx()};
      if (!(0 < a.idx() && a < b) || faces.count(key)) continue;
      EXPECT_FALSE(tets.find_face(Vertex(0), a, b).is_valid());
      ++missing;
    }
  }
  EXPECT_GT(missing, 0);
}

TEST(TetMesh, GrowsToTheSameMesh) {
  for (const auto& [mesh, tunnels] : meshes()) {
    const auto expected = all_neighbours(TetMesh::from(mesh));
    EXPECT_EQ(all_neighbours(grown(mesh)), expected);

    // The second half of the cells added to a mesh that was made at once.
    DomainMesh<3> half = mesh;
    half.cells.conservativeResize(4, mesh.num_cells() - mesh.num_cells() / 2);
    TetMesh tets;
    tets.assign_valid(half);
    for (Index s = half.num_cells(); s < mesh.num_cells(); ++s) {
      const auto v = mesh.cells.col(s);
      tets.add_cell(Vertex(v[0]), Vertex(v[1]), Vertex(v[2]), Vertex(v[3]));
    }
    EXPECT_EQ(all_neighbours(tets), expected);
  }
}

TEST(TetMesh, ManyCellsRoundOneVertexAndOneEdge) {
  // A fan round the edge of vertices 0 and 1: its faces crowd at two vertices.
  constexpr int kCells = 20000;
  TetMesh tets;
  tets.add_vertex({0, 0, 0});
  tets.add_vertex({0, 0, 1});
  for (int k = 0; k < kCells; ++k) {
    const double angle = 2 * M_PI * k / kCells;
    tets.add_vertex({std::cos(angle), std::sin(angle), 0});
  }
  for (int k = 0; k < kCells; ++k) {
    tets.add_cell(Vertex(0), Vertex(2 + k), Vertex(2 + (k + 1) % kCells), Vertex(1));
  }
  EXPECT_EQ(tets.n_faces(), 3u * kCells);
  EXPECT_EQ(tets.n_edges(), 3u * kCells + 1);
  EXPECT_EQ(tets.vc_range(Vertex(0)).size(), static_cast<std::size_t>(kCells));
  EXPECT_FALSE(tets.is_boundary(tets.find_edge(Vertex(0), Vertex(1))));
  EXPECT_TRUE(tets.is_boundary(Vertex(0)));
}

TEST(TetMesh, TurnsCellsRound) {
  auto mesh = meshes()[3].first;
  for (Index s = 0; s < mesh.num_cells(); s += 2) std::swap(mesh.cells(0, s), mesh.cells(1, s));
  const auto tets = TetMesh::from(mesh);
  for (Index s = 0; s < mesh.num_cells(); ++s) EXPECT_GT(signed_measure(tets.domain(), s), 0);
}

TEST(TetMesh, RefusesWhatIsNoMesh) {
  TetMesh tets = TetMesh::from(meshes()[0].first);
  const auto before = all_neighbours(tets);
  auto flat = meshes()[0].first;
  flat.points.row(2).setZero();
  expect_error<InputError>([&] { tets.assign(flat); }, {"cell 0", "degenerate"});
  expect_error<InputError>([&] { TetMesh::from({}); }, {"no cells"});

  const auto add = [&](int a, int b, int c, int d) {
    tets.add_cell(Vertex(a), Vertex(b), Vertex(c), Vertex(d));
  };
  expect_error<InputError>([&] { add(0, 1, 2, 4); }, {"cell 1", "vertex 4", "4 vertices"});
  expect_error<InputError>([&] { add(0, 1, -1, 3); }, {"cell 1", "vertex -1"});
  expect_error<InputError>([&] { add(0, 3, 2, 3); }, {"cell 1", "(0, 3, 2, 3)", "vertex 3 twice"});
  EXPECT_EQ(all_neighbours(tets), before);

  const auto apex = tets.add_vertex({5, 5, 5});
  const auto other = tets.add_vertex({6, 5, 5});
  const auto f = tets.fv_range(OpenMesh::FaceHandle(0));
  const std::array<Vertex, 3> face = {f[0], f[1], f[2]};
  tets.add_cell(face[0], face[1], face[2], apex);
  const auto with_two = all_neighbours(tets);
  expect_error<InputError>([&] { tets.add_cell(face[1], face[0], face[2], other); },
                           {"cells 0, 1 and 2", "share one face"});
  EXPECT_EQ(all_neighbours(tets), with_two);
}

TEST(TetMesh, HandlesAreInvalidByDefault) {
  EXPECT_FALSE(CellHandle().is_valid());
  EXPECT_FALSE(CPropHandleT<double>().is_valid());
  EXPECT_FALSE(TetMesh::VertexHandle().is_valid());
  EXPECT_TRUE(CellHandle(0).is_valid());
  EXPECT_EQ(CellHandle(3), CellHandle(3));
  EXPECT_EQ(std::hash<CellHandle>()(CellHandle(3)), std::hash<CellHandle>()(CellHandle(3)));
  TetMesh tets;
  OpenMesh::VPropHandleT<int> property;
  EXPECT_FALSE(tets.get_property_handle(property, "none"));
  tets.remove_property(property);
  EXPECT_TRUE(tets.vertices().begin() == tets.vertices().end());
}

TEST(TetMesh, IsolatedVerticesHaveNoNeighbours) {
  TetMesh tets;
  const auto v = tets.add_vertex({1, 2, 3});
  EXPECT_TRUE(tets.vc_range(v).empty());
  EXPECT_EQ(indices(tets.ve_range(v)).size() + tets.vv_range(v).size(), 0u);
  EXPECT_FALSE(tets.is_boundary(v));
  tets.set_point(v, {4, 5, 6});
  EXPECT_EQ(tets.point(v), OpenMesh::Vec3d(4, 5, 6));
  tets.clear();
  EXPECT_EQ(tets.n_vertices(), 0u);
}

// The facets of a domain, in their own numbering and their own order of vertices.
TEST(TetMesh, DomainIsThatOfTheDomainMesh) {
  for (const auto& [mesh, tunnels] : meshes()) {
    const auto expected = build_topology(mesh);
    const auto domain = make_domain(TetMesh::from(mesh));
    EXPECT_TRUE(bit_equal(domain.mesh.points, mesh.points));
    EXPECT_EQ(domain.mesh.cells, mesh.cells);
    EXPECT_EQ(domain.topology.facets, expected.facets);
    EXPECT_EQ(domain.topology.sides, expected.sides);
    EXPECT_EQ(domain.topology.cell_facets, expected.cell_facets);
  }
}

TEST(TetMesh, DomainOfCellsThatAreTurnedRound) {
  for (const auto& [mesh, tunnels] : meshes()) {
    DomainMesh<3> inverted = mesh;
    for (Index s = 0; s < mesh.num_cells(); s += 2) {
      std::swap(inverted.cells(s % 4, s), inverted.cells((s + 1) % 4, s));
    }
    const auto tets = grown(inverted);
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
  TetMesh tets = TetMesh::from(meshes()[0].first);
  tets.add_vertex({7, 7, 7});
  expect_error<InputError>([&] { make_domain(tets); }, {"vertex 4", "belongs to no cell"});
}

}  // namespace
}  // namespace flbc::openmesh

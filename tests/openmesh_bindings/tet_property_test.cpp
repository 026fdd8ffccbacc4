// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "flbc/openmesh/tet_mesh.h"
#include "flbc/openmesh/wide_property.h"
#include "support/sample_meshes.h"

namespace flbc::openmesh {
namespace {

using flbc::testing::Shape;
using OpenMesh::EPropHandleT;
using OpenMesh::FPropHandleT;
using OpenMesh::MPropHandleT;
using OpenMesh::VPropHandleT;

TetMesh box(Index subdivisions = 2) {
  return TetMesh::from(flbc::testing::make_sample<3>(Shape::kBox, subdivisions).mesh);
}

// Fills a property of every kind with numbers that tell kind and element.
void fill(TetMesh& mesh) {
  TetVProp<int> of_vertices(mesh, "number");
  TetEProp<int> of_edges(mesh, "number");
  TetFProp<int> of_faces(mesh, "number");
  TetCProp<int> of_cells(mesh, "number");
  for (const auto v : mesh.vertices()) of_vertices[v] = 10 * v.idx() + 1;
  for (const auto e : mesh.edges()) of_edges[e] = 10 * e.idx() + 2;
  for (const auto f : mesh.faces()) of_faces[f] = 10 * f.idx() + 3;
  for (const auto c : mesh.cells()) of_cells[c] = 10 * c.idx() + 4;
  TetMProp<std::string>(mesh, "number")() = "five";
}

// Whether the first elements have what fill() gave them, and those after them `rest`.
template <class Property, class Range>
void expect_numbers(TetMesh& mesh, const Range& range, int kind, std::size_t count, int rest) {
  ASSERT_TRUE(Property::exists(mesh, "number"));
  const Property property(mesh, "number");
  for (const auto element : range) {
    const bool is_old = static_cast<std::size_t>(element.idx()) < count;
    ASSERT_EQ(property[element], is_old ? 10 * element.idx() + kind : rest);
    ASSERT_EQ(property(element), property[element]);
  }
}

struct Counts {
  explicit Counts(const TetMesh& m)
      : vertices(m.n_vertices()), edges(m.n_edges()), faces(m.n_faces()), cells(m.n_cells()) {}
  std::size_t vertices, edges, faces, cells;
};

void expect_filled(TetMesh& mesh, const Counts& counts) {
  expect_numbers<TetVProp<int>>(mesh, mesh.vertices(), 1, counts.vertices, 0);
  expect_numbers<TetEProp<int>>(mesh, mesh.edges(), 2, counts.edges, 0);
  expect_numbers<TetFProp<int>>(mesh, mesh.faces(), 3, counts.faces, 0);
  expect_numbers<TetCProp<int>>(mesh, mesh.cells(), 4, counts.cells, 0);
  EXPECT_EQ(*TetMProp<std::string>(mesh, "number"), "five");
}

template <class PropHandle>
std::size_t size_of_property(const TetMesh& mesh, const std::string& name) {
  PropHandle handle;
  EXPECT_TRUE(mesh.get_property_handle(handle, name));
  return mesh.property(handle).n_elements();
}

void expect_sizes(const TetMesh& mesh) {
  EXPECT_EQ(size_of_property<VPropHandleT<int>>(mesh, "number"), mesh.n_vertices());
  EXPECT_EQ(size_of_property<EPropHandleT<int>>(mesh, "number"), mesh.n_edges());
  EXPECT_EQ(size_of_property<FPropHandleT<int>>(mesh, "number"), mesh.n_faces());
  EXPECT_EQ(size_of_property<CPropHandleT<int>>(mesh, "number"), mesh.n_cells());
  MPropHandleT<std::string> handle;
  ASSERT_TRUE(mesh.get_property_handle(handle, "number"));
  EXPECT_EQ(mesh.mproperty(handle).n_elements(), 1u);
}

TEST(TetProperty, AddLookUpRemove) {
  TetMesh mesh = box();
  CPropHandleT<double> added;
  mesh.add_property(added, "volume");
  ASSERT_TRUE(added.is_valid());
  EXPECT_EQ(mesh.property(added).n_elements(), mesh.n_cells());
  EXPECT_EQ(mesh.property(added).name(), "volume");
  mesh.property(added, CellHandle(2)) = 2.5;

  const TetMesh& constant = mesh;
  CPropHandleT<double> found;
  EXPECT_TRUE(constant.get_property_handle(found, "volume"));
  EXPECT_EQ(constant.property(found, CellHandle(2)), 2.5);
  EXPECT_EQ(constant.property(found)[2], 2.5);

  // Another type, kind or name is another property.
  CPropHandleT<float> of_other_type;
  EXPECT_FALSE(constant.get_property_handle(of_other_type, "volume"));
  VPropHandleT<double> of_vertices;
  EXPECT_FALSE(constant.get_property_handle(of_vertices, "volume"));
  EXPECT_FALSE(constant.get_property_handle(found, "Volume"));
  EXPECT_FALSE(found.is_valid());

  mesh.remove_property(added);
  EXPECT_FALSE(added.is_valid());
  EXPECT_FALSE(TetCProp<double>::exists(mesh, "volume"));
}

TEST(TetProperty, OfTheMesh) {
  TetMesh mesh;
  MPropHandleT<std::string> handle;
  mesh.add_property(handle, "note");
  mesh.property(handle) = "text";
  const TetMesh& constant = mesh;
  EXPECT_EQ(constant.property(handle), "text");
  EXPECT_EQ(constant.mproperty(handle)[0], "text");
  mesh.mproperty(handle)[0] += "s";
  EXPECT_EQ(TetMProp<std::string>(mesh, "note")(), "texts");
}

TEST(TetProperty, BitsAndVectors) {
  TetMesh mesh = box();
  TetFProp<bool> marked(mesh, "marked");
  marked[OpenMesh::FaceHandle(3)] = true;
  const auto& constant = marked;
  EXPECT_TRUE(constant[OpenMesh::FaceHandle(3)]);
  EXPECT_FALSE(constant[OpenMesh::FaceHandle(2)]);
  TetMProp<bool> flag(true, mesh, "flag");
  EXPECT_TRUE(flag());
  *flag = false;
  EXPECT_FALSE(*TetMProp<bool>(true, mesh, "flag"));  // it was there already

  TetVProp<std::vector<double>> rows({1, 2}, mesh, "rows");
  rows[OpenMesh::VertexHandle(0)].push_back(3);
  EXPECT_EQ(rows[OpenMesh::VertexHandle(0)].size(), 3u);
  EXPECT_EQ(rows[OpenMesh::VertexHandle(1)].size(), 2u);
  EXPECT_EQ(TetVProp<std::vector<double>>(mesh, rows.handle())[OpenMesh::VertexHandle(0)][2], 3.0);
}

template <class PropHandle>
void expect_wide_rows_work() {
  TetMesh mesh = box();
  PropHandle handle;
  mesh.add_property(handle, "rows");
  mesh.property(handle).set_shape(3, 5);
  using Handle = typename PropHandle::Handle;
  const Handle last(static_cast<int>(mesh.n_elements<Handle>()) - 1);
  mesh.property(handle, last)(2, 4) = 7;
  const auto* const data = mesh.property(handle).data();

  const TetMesh copy(mesh);
  mesh.property(handle, last)(2, 4) = 8;
  EXPECT_EQ(copy.property(handle, last)(2, 4), 7);
  EXPECT_NE(copy.property(handle).data(), data);
  TetMesh moved(std::move(mesh));
  EXPECT_EQ(moved.property(handle).data(), data);
  EXPECT_EQ(TetProperty<PropHandle>(moved, "rows")[last](2, 4), 8);
  moved.assign(box(3).domain());
  EXPECT_EQ(moved.property(handle).n_elements(), moved.n_elements<Handle>());
  EXPECT_EQ(moved.property(handle, last)(2, 4), 8);
  const auto vertex = moved.add_vertex({9, 9, 9});
  const auto face = moved.fv_range(*std::find_if(moved.faces().begin(), moved.faces().end(),
                                                 [&](auto f) { return moved.is_boundary(f); }));
  const OpenMesh::VertexHandle a = face[0], b = face[1], c = face[2];
  moved.add_cell(a, b, c, vertex);
  ASSERT_EQ(moved.property(handle).n_elements(), moved.n_elements<Handle>());
  const Handle newest(static_cast<int>(moved.n_elements<Handle>()) - 1);
  EXPECT_EQ(moved.property(handle, newest)(2, 4), 0);
  EXPECT_EQ(moved.property(handle, last)(2, 4), 8);
}

TEST(TetProperty, WideRows) {
  expect_wide_rows_work<VPropHandleT<Wide<double>>>();
  expect_wide_rows_work<EPropHandleT<Wide<float>>>();
  expect_wide_rows_work<FPropHandleT<Wide<double>>>();
  expect_wide_rows_work<CPropHandleT<Wide<float>>>();
  TetMesh mesh = box();
  MPropHandleT<Wide<double>> handle;
  mesh.add_property(handle, "row");
  mesh.mproperty(handle).set_shape(1, 4);
  mesh.property(handle)[3] = 2;
  EXPECT_EQ(mesh.mproperty(handle)[0][3], 2);
}

TEST(TetProperty, CopiesAreIndependent) {
  TetMesh mesh = box();
  fill(mesh);
  const Counts counts(mesh);
  TetMesh copy(mesh);
  TetMesh assigned = box(1);
  TetVProp<double>(assigned, "other");
  assigned = mesh;
  EXPECT_FALSE(TetVProp<double>::exists(assigned, "other"));
  TetVProp<int>(mesh, "number")[OpenMesh::VertexHandle(0)] = -1;
  TetMProp<std::string>(mesh, "number")() = "changed";
  for (TetMesh* other : {&copy, &assigned}) {
    EXPECT_EQ(other->n_cells(), counts.cells);
    expect_sizes(*other);
    expect_filled(*other, counts);
  }
  const TetMesh& same = copy;
  copy = same;
  expect_filled(copy, counts);
}

TEST(TetProperty, MovesKeepTheData) {
  TetMesh mesh = box();
  fill(mesh);
  const Counts counts(mesh);
  CPropHandleT<int> handle;
  ASSERT_TRUE(mesh.get_property_handle(handle, "number"));
  const int* const data = mesh.property(handle).data();

  TetMesh moved(std::move(mesh));
  EXPECT_EQ(moved.property(handle).data(), data);
  expect_filled(moved, counts);
  // The rest can be used again. NOLINTNEXTLINE(bugprone-use-after-move)
  EXPECT_EQ(mesh.n_vertices() + mesh.n_edges() + mesh.n_faces() + mesh.n_cells(), 0u);
  EXPECT_FALSE(TetCProp<int>::exists(mesh, "number"));
  for (int k = 0; k < 4; ++k)
    mesh.add_vertex({k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0, k == 3 ? 1.0 : 0});
  using V = OpenMesh::VertexHandle;
  mesh.add_cell(V(0), V(1), V(2), V(3));
  EXPECT_EQ(mesh.n_edges(), 6u);
  fill(mesh);
  expect_sizes(mesh);

  TetMesh target = box(1);
  target = std::move(moved);
  EXPECT_EQ(target.property(handle).data(), data);
  expect_filled(target, counts);

  swap(target, mesh);
  EXPECT_EQ(mesh.property(handle).data(), data);
  expect_filled(mesh, counts);
  EXPECT_EQ(target.n_cells(), 1u);
  expect_sizes(target);
  std::swap(target, mesh);
  EXPECT_EQ(target.property(handle).data(), data);
  expect_filled(target, counts);
}

TEST(TetProperty, GrowsWithTheMesh) {
  TetMesh mesh = box(1);
  fill(mesh);
  const Counts counts(mesh);
  const auto face = mesh.fv_range(*std::find_if(mesh.faces().begin(), mesh.faces().end(),
                                                [&](auto f) { return mesh.is_boundary(f); }));
  const OpenMesh::VertexHandle a = face[0], b = face[1], c = face[2];
  const auto apex = mesh.add_vertex({9, 9, 9});
  expect_sizes(mesh);
  expect_filled(mesh, counts);
  mesh.add_cell(a, b, c, apex);
  EXPECT_EQ(mesh.n_faces(), counts.faces + 3);
  EXPECT_EQ(mesh.n_edges(), counts.edges + 3);
  expect_sizes(mesh);
  expect_filled(mesh, counts);
}

TEST(TetProperty, AssigningResizes) {
  TetMesh mesh = box(1);
  fill(mesh);
  const Counts counts(mesh);
  mesh.assign(box(3).domain());
  expect_sizes(mesh);
  expect_filled(mesh, counts);
  mesh.assign(box(1).domain().points, box(1).domain().cells);
  expect_sizes(mesh);
  expect_filled(mesh, counts);
  mesh.clear();
  expect_sizes(mesh);
  EXPECT_TRUE(TetCProp<int>::exists(mesh, "number"));
  EXPECT_EQ(*TetMProp<std::string>(mesh, "number"), "five");
}

TEST(TetProperty, ReservingKeepsTheDataInPlace) {
  const auto domain = box(2).domain();
  TetMesh mesh;
  TetVProp<int> numbers(mesh, "number");
  TetCProp<int> of_cells(mesh, "number");
  mesh.reserve(100, 500, 500, 100);
  using V = OpenMesh::VertexHandle;
  mesh.add_vertex({0, 0, 0});
  const int* const data = mesh.property(numbers.handle()).data();
  for (Index v = 1; v < domain.num_vertices(); ++v) mesh.add_vertex({1.0 * v, 0, 0});
  ASSERT_LE(mesh.n_vertices(), 100u);
  EXPECT_EQ(mesh.property(numbers.handle()).data(), data);
  for (const auto& cell : domain.cells.colwise()) {
    mesh.add_cell(V(cell[0]), V(cell[1]), V(cell[2]), V(cell[3]));
  }
  EXPECT_EQ(mesh.property(of_cells.handle()).n_elements(), mesh.n_cells());
}

}  // namespace
}  // namespace flbc::openmesh

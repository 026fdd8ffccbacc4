// SPDX-License-Identifier: BSD-3-Clause
// Wide properties do in memory what other properties of OpenMesh do.
#include "flbc/openmesh/wide_property.h"

#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

using openmesh::Wide;

template <class Case>
struct WideProperty : WidePropertyTest<Case> {};
TYPED_TEST_SUITE(WideProperty, WideCases);

TYPED_TEST(WideProperty, LaysRowsOutElementMajor) {
  using Scalar = typename TypeParam::Scalar;
  typename TestFixture::Faces handle;
  this->mesh_.add_property(handle, "rows");
  auto& rows = this->mesh_.property(handle);
  for (const std::size_t width : {1, 7, 8, 9, 16, 31}) {
    rows.set_shape(3, width);
    ASSERT_EQ(rows.n_elements(), this->mesh_.n_faces());
    EXPECT_EQ(rows.bytes(), rows.n_elements() * 3 * width * sizeof(Scalar));
    EXPECT_TRUE(is_zero(rows, 0, rows.n_elements()));
    const std::size_t e = 5, c = 2, i = width - 1;
    this->mesh_.property(handle, OpenMesh::FaceHandle(5))(c, i) = Scalar(0.5);
    EXPECT_EQ(rows.data()[(e * 3 + c) * width + i], Scalar(0.5));
    EXPECT_EQ(rows[5].row(2)[i], Scalar(0.5));
    rows[5][i] = Scalar(0.25);
    EXPECT_EQ(rows[5](0, i), Scalar(0.25));
    const auto matrix = std::as_const(rows)[5].matrix();
    ASSERT_EQ(matrix.rows(), 3);
    ASSERT_EQ(matrix.cols(), static_cast<Eigen::Index>(width));
    EXPECT_EQ(matrix(0, matrix.cols() - 1), Scalar(0.25));
    EXPECT_EQ(matrix(2, matrix.cols() - 1), Scalar(0.5));
  }
  rows.set_shape(0, 5);
  EXPECT_EQ(rows.bytes(), 0U);
  EXPECT_EQ(rows.n_elements(), this->mesh_.n_faces());
}

TYPED_TEST(WideProperty, RefusesShapesThatCannotBeAddressedAndKeepsItsRows) {
  const auto handle = add_filled<typename TestFixture::Vertices>(this->mesh_, "rows", 2, 9);
  const auto most = std::numeric_limits<std::size_t>::max();
  auto& rows = this->mesh_.property(handle);
  for (const auto& [components, width] : std::vector<std::pair<std::size_t, std::size_t>>{
           {1, most}, {1, most / 2}, {most, 1}, {most / 32, 1}, {1UL << 32, 1UL << 32}}) {
    EXPECT_THROW(rows.set_shape(components, width), std::bad_alloc);
    EXPECT_THROW(rows.reserve(most / 2), std::bad_alloc);
    EXPECT_THROW(rows.resize(most), std::bad_alloc);
    expect_filled(this->mesh_, handle, 2, 9);
  }
}

TYPED_TEST(WideProperty, GivesNewElementsZeroRows) {
  const auto handle = add_filled<typename TestFixture::Vertices>(this->mesh_, "rows", 2, 9);
  auto& rows = this->mesh_.property(handle);
  const auto old = this->mesh_.n_vertices();
  for (int k = 0; k < 100; ++k) {
    this->mesh_.add_vertex(typename TypeParam::Mesh::Point(50, 50, 0));
    ASSERT_EQ(rows.n_elements(), this->mesh_.n_vertices());
    ASSERT_TRUE(is_zero(rows, old, rows.n_elements()));
  }
  // Also where there were numbers before.
  rows.resize(10);
  rows.resize(20);
  EXPECT_TRUE(is_zero(rows, 10, 20));
  rows.push_back();
  EXPECT_EQ(rows.n_elements(), 21U);
  EXPECT_TRUE(is_zero(rows, 10, 21));
  for (int v = 0; v < 10; ++v) {
    EXPECT_TRUE(is_filled<typename TypeParam::Scalar>(
        rows[v], key(this->mesh_, OpenMesh::VertexHandle(v)), 2, 9));
  }
}

TYPED_TEST(WideProperty, SwapsAndCopiesElements) {
  using Scalar = typename TypeParam::Scalar;
  const auto handle = add_filled<typename TestFixture::Edges>(this->mesh_, "rows", 4, 13);
  auto& rows = this->mesh_.property(handle);
  const auto has_rows_of = [&](int e, int original) {
    return is_filled<Scalar>(rows[e], key(this->mesh_, OpenMesh::EdgeHandle(original)), 4, 13);
  };
  rows.swap(3, 8);
  rows.swap(5, 5);
  EXPECT_TRUE(has_rows_of(3, 8) && has_rows_of(8, 3) && has_rows_of(5, 5));
  rows.copy(3, 9);
  rows.copy(9, 9);
  EXPECT_TRUE(has_rows_of(3, 8) && has_rows_of(9, 8) && has_rows_of(10, 10));
  this->mesh_.copy_all_properties(OpenMesh::EdgeHandle(10), OpenMesh::EdgeHandle(11));
  EXPECT_TRUE(has_rows_of(11, 10) && has_rows_of(10, 10));
  this->mesh_.copy_property(handle, OpenMesh::EdgeHandle(12), OpenMesh::EdgeHandle(13));
  EXPECT_TRUE(has_rows_of(13, 12) && has_rows_of(12, 12) && has_rows_of(14, 14));
}

TYPED_TEST(WideProperty, RefusesToCopyRowsOfAnotherShape) {
  const auto one = add_filled<typename TestFixture::Vertices>(this->mesh_, "one", 1, 5);
  const auto two = add_filled<typename TestFixture::Vertices>(this->mesh_, "two", 1, 6);
  EXPECT_THROW(this->mesh_.property(one)[0] = this->mesh_.property(two)[0], InputError);
  expect_filled(this->mesh_, one, 1, 5);
}

TYPED_TEST(WideProperty, FollowsItsElementsThroughGarbageCollection) {
  using Mesh = typename TypeParam::Mesh;
  const auto of_vertices = add_filled<typename TestFixture::Vertices>(this->mesh_, "v", 1, 9);
  const auto of_halfedges = add_filled<typename TestFixture::Halfedges>(this->mesh_, "h", 1, 2);
  const auto of_edges = add_filled<typename TestFixture::Edges>(this->mesh_, "e", 4, 8);
  const auto of_faces = add_filled<typename TestFixture::Faces>(this->mesh_, "f", 3, 31);
  Mesh& mesh = this->mesh_;
  request_status(mesh);
  const auto vertices = mesh.n_vertices(), faces = mesh.n_faces();
  mesh.delete_vertex(OpenMesh::VertexHandle(0));
  mesh.delete_vertex(OpenMesh::VertexHandle(24), false);
  mesh.delete_face(OpenMesh::FaceHandle(4));
  mesh.garbage_collection();
  ASSERT_LT(mesh.n_vertices(), vertices);
  ASSERT_LT(mesh.n_faces(), faces - 2);
  EXPECT_EQ(mesh.property(of_vertices).n_elements(), mesh.n_vertices());
  EXPECT_EQ(mesh.property(of_edges).n_elements(), mesh.n_edges());
  EXPECT_EQ(mesh.property(of_faces).n_elements(), mesh.n_faces());
  expect_filled(mesh, of_vertices, 1, 9);
  expect_filled(mesh, of_halfedges, 1, 2);
  expect_filled(mesh, of_edges, 4, 8);
  expect_filled(mesh, of_faces, 3, 31);
}

TYPED_TEST(WideProperty, IsCopiedWithItsMesh) {
  using Mesh = typename TypeParam::Mesh;
  const auto handle = add_filled<typename TestFixture::Vertices>(this->mesh_, "rows", 2, 9);
  typename TestFixture::OfMesh of_mesh;
  this->mesh_.add_property(of_mesh, "rows of the mesh");
  this->mesh_.mproperty(of_mesh).set_shape(1, 3);
  fill(this->mesh_.property(of_mesh), 7);

  const Mesh copy(this->mesh_);
  Mesh assigned = make_squares<Mesh>(2);
  assigned = copy;
  this->mesh_.property(handle).set_shape(1, 1);
  this->mesh_.property(of_mesh)[0] = 0;
  for (const auto* other : {&copy, const_cast<const Mesh*>(&assigned)}) {
    expect_filled(*other, handle, 2, 9);
    EXPECT_TRUE(is_filled(other->property(of_mesh), 7, 1, 3));
  }
  EXPECT_NE(copy.property(handle).data(), assigned.property(handle).data());

  std::swap(assigned, this->mesh_);
  expect_filled(this->mesh_, handle, 2, 9);
  EXPECT_EQ(assigned.property(handle).width(), 1U);
}

TYPED_TEST(WideProperty, HasItsTypeAndNameAsItsCloneHas) {
  using Property = OpenMesh::PropertyT<typename TestFixture::Numbers>;
  using Scalar = typename TypeParam::Scalar;
  const auto handle = add_filled<typename TestFixture::Vertices>(this->mesh_, "rows", 2, 9);
  OpenMesh::VPropHandleT<Wide<std::conditional_t<std::is_same_v<Scalar, float>, double, float>>>
      other;
  EXPECT_FALSE(this->mesh_.get_property_handle(other, "rows"));
  expect_refused<Error>("is not stored in .om files",
                        [&] { this->mesh_.property(handle).set_persistent(true); });
  const Property& rows = this->mesh_.property(handle);
  const std::unique_ptr<OpenMesh::BaseProperty> clone(rows.clone());
  EXPECT_EQ(clone->name(), "rows");
  EXPECT_EQ(clone->internal_type_name(), rows.internal_type_name());
  EXPECT_EQ(clone->n_elements(), rows.n_elements());
  auto& copy = dynamic_cast<Property&>(*clone);
  EXPECT_TRUE(is_filled(std::as_const(copy)[4], key(this->mesh_, OpenMesh::VertexHandle(4)), 2, 9));
  copy.set_shape(1, 1);
  expect_filled(this->mesh_, handle, 2, 9);
  typename TestFixture::Vertices same;
  EXPECT_TRUE(this->mesh_.get_property_handle(same, "rows"));
  this->mesh_.remove_property(same);
  EXPECT_FALSE(this->mesh_.get_property_handle(same, "rows"));
}

TYPED_TEST(WideProperty, WorksThroughPropertyManagers) {
  using Rows = typename TestFixture::Numbers;
  auto& mesh = this->mesh_;
  using Manager = OpenMesh::VProp<Rows>;
  Manager named(mesh, "rows");
  mesh.property(named.getRawProperty()).set_shape(1, 4);
  for (const auto v : mesh.vertices()) fill(named[v], key(mesh, v));
  expect_filled(mesh, Manager(mesh, "rows").getRawProperty(), 1, 4);
  const auto& readable = named;
  EXPECT_EQ(readable[OpenMesh::VertexHandle(3)].width(), 4U);
  EXPECT_TRUE((OpenMesh::hasProperty<OpenMesh::VertexHandle, Rows>(mesh, "rows")));
  EXPECT_FALSE((OpenMesh::hasProperty<OpenMesh::FaceHandle, Rows>(mesh, "rows")));

  Manager temporary(mesh);
  mesh.property(temporary.getRawProperty()).set_shape(1, 4);
  named.copy_to(mesh.vertices(), temporary, mesh.vertices());
  expect_filled(mesh, temporary.getRawProperty(), 1, 4);
  Manager other(mesh);
  other.swap(temporary);
  expect_filled(mesh, other.getRawProperty(), 1, 4);
  EXPECT_EQ(mesh.property(temporary.getRawProperty()).width(), 0U);
  Manager third(mesh);
  third = std::move(other);
  expect_filled(mesh, third.getRawProperty(), 1, 4);

  OpenMesh::EProp<Rows>(mesh, "rows")[OpenMesh::EdgeHandle(0)].components();
  OpenMesh::HProp<Rows>(mesh, "rows")[OpenMesh::HalfedgeHandle(0)].components();
  OpenMesh::FProp<Rows>(mesh, "rows")[OpenMesh::FaceHandle(0)].components();
  OpenMesh::MProp<Rows> of_mesh(mesh, "rows");
  mesh.mproperty(of_mesh.getRawProperty()).set_shape(2, 5);
  fill(of_mesh(), 11);
  EXPECT_TRUE(is_filled(std::as_const(mesh).property(of_mesh.getRawProperty()), 11, 2, 5));
}

}  // namespace
}  // namespace flbc::testing

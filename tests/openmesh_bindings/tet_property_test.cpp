// SPDX-License-Identifier: BSD-3-Clause
#include "flbc/openmesh/tet_mesh.h"
#include "flbc/openmesh/wide_property.h"
#include "support/test.h"

namespace flbc::openmesh {
namespace {

using flbc::testing::Shape;
using OpenMesh::EPropHandleT;
using OpenMesh::FPropHandleT;
using OpenMesh::MPropHandleT;
using OpenMesh::VPropHandleT;

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

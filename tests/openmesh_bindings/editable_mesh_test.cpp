// SPDX-License-Identifier: BSD-3-Clause
// Editing the rest cage of a mesh: its points and weights follow, bit by bit those on plain arrays.
#include "flbc/openmesh/editing.h"

#include <gtest/gtest.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "flbc/bounding_box.h"
#include "support/judge.h"
#include "support/sample_meshes.h"

namespace flbc::testing {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
using DoubleMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using openmesh::EditableMesh;
using openmesh::TetMesh;

template <class Mesh>
class EditableMeshTest : public ::testing::Test {};
using Meshes = ::testing::Types<DoubleMesh, FloatMesh, TetMesh>;
TYPED_TEST_SUITE(EditableMeshTest, Meshes);

template <class Mesh>
constexpr int kDim = openmesh::kDimension<Mesh>;

template <class Mesh>
Mesh build(const Sample<kDim<Mesh>>& sample) {
  if constexpr (kDim<Mesh> == 3) {
    return TetMesh::from(sample.mesh);
  } else {
    return openmesh::to_mesh<Mesh>(sample.mesh);
  }
}

template <int Dim>
Sample<Dim> sample_of() {
  auto sample = make_sample<Dim>(Shape::kCorner, Dim == 2 ? 12 : 4, 0.2);
  normalize_and_validate(sample.mesh);
  return sample;
}

template <int Dim>
PointList<Dim> reshaped(const Cage<Dim>& cage) {
  PointList<Dim> moved = cage.points;
  moved.col(2) += 0.02 * bounding_box_diagonal(cage.points) * Vector<Dim>::Ones();
  return moved;
}

TYPED_TEST(EditableMeshTest, PointsAndWeightsFollowTheRestCage) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = sample_of<kDimension>();
  auto mesh = build<TypeParam>(sample);
  EditableMesh<TypeParam> editable(mesh, sample.cage);
  const auto moved = reshaped(sample.cage);
  const auto& report = editable.move(moved);
  EXPECT_EQ(report.status, SolveStatus::kConverged);

  const auto weights = openmesh::get_weights(mesh);
  const double size = bounding_box_diagonal(sample.cage.points);
  const auto points = openmesh::points_of<kDimension>(mesh);
  EXPECT_LT((moved * weights - points).cwiseAbs().maxCoeff(), 2e-6 * size);
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_EQ(openmesh::get_rest_cage(mesh), Eigen::MatrixXd(moved));
  EXPECT_LT((points - sample.mesh.points).cwiseAbs().maxCoeff(), 0.03 * size);
  EXPECT_GT((points - sample.mesh.points).cwiseAbs().maxCoeff(), 1e-3 * size);
}

TYPED_TEST(EditableMeshTest, StepsEqualThoseOnArrays) {
  constexpr int kDimension = kDim<TypeParam>;
  if constexpr (std::is_same_v<TypeParam, FloatMesh>) {
    GTEST_SKIP() << "the first points differ in single precision";
  } else {
    const auto sample = sample_of<kDimension>();
    auto mesh = build<TypeParam>(sample);
    EditableMesh<TypeParam> editable(mesh, sample.cage);
    EditableCoordinates<kDimension> plain(sample.cage, sample.mesh);
    EXPECT_EQ(openmesh::get_weights(mesh), plain.solution().weights);
    EditBudget few;
    few.iterations = 3;
    EXPECT_EQ(editable.move(reshaped(sample.cage), few).iterations, 3);
    plain.move(reshaped(sample.cage), few);
    EXPECT_EQ(openmesh::get_weights(mesh), plain.solution().weights);
    editable.refine();
    plain.refine();
    EXPECT_EQ(openmesh::get_weights(mesh), plain.solution().weights);
    EXPECT_EQ(openmesh::points_of<kDimension>(mesh), plain.mesh().points);
  }
}

TYPED_TEST(EditableMeshTest, ARefusedStepLeavesTheMeshAsItWas) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = sample_of<kDimension>();
  auto mesh = build<TypeParam>(sample);
  EditableMesh<TypeParam> editable(mesh, sample.cage);
  const auto weights = openmesh::get_weights(mesh);
  const auto points = openmesh::points_of<kDimension>(mesh);
  PointList<kDimension> inside_out = -sample.cage.points;
  inside_out.row(0) = sample.cage.points.row(0);
  EXPECT_THROW(editable.move(kDimension == 2 ? inside_out : PointList<kDimension>(-sample.cage.points)),
               InputError);
  EXPECT_EQ(openmesh::get_weights(mesh), weights);
  EXPECT_EQ(openmesh::points_of<kDimension>(mesh), points);
  EXPECT_EQ(openmesh::get_rest_cage(mesh), Eigen::MatrixXd(sample.cage.points));
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// Sparse weights on a mesh: kept through all that OpenMesh does, and moving it as arrays would.
#include "flbc/openmesh/influences.h"

#include "flbc/openmesh/deform.h"
#include "flbc/openmesh/lbc.h"
#include "flbc/openmesh/sparsify.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

using openmesh::Influences;
using openmesh::TetMesh;

// Distinct weights for every vertex: up to `most` of n.
Eigen::VectorXd row_of(int key, Index n, int most) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
  for (int j = 0; j < key % (most + 1); ++j) row[(key + 3 * j) % n] = 1 + key + 0.125 * j;
  return row;
}

constexpr Index kCage = 17;
constexpr int kMost = 4;

OpenMesh::VPropHandleT<Influences> add_influences(DoubleTri& mesh) {
  WeightMatrix weights(kCage, mesh.n_vertices());
  for (const auto v : mesh.vertices()) weights.col(v.idx()) = row_of(key(mesh, v), kCage, kMost);
  openmesh::set_influences(mesh, SparseWeights(weights), kMost);
  OpenMesh::VPropHandleT<Influences> handle;
  EXPECT_TRUE(mesh.get_property_handle(handle, openmesh::kWeights));
  return handle;
}

void expect_influences(const DoubleTri& mesh) {
  const auto weights = openmesh::get_weights(mesh).dense();
  for (const auto v : mesh.vertices()) {
    ASSERT_EQ(weights.col(v.idx()), row_of(key(mesh, v), kCage, kMost)) << v.idx();
  }
}

TEST(InfluencesProperty, HoldsPairsInOrder) {
  auto mesh = make_squares<DoubleTri>();
  add_influences(mesh);
  expect_influences(mesh);
  OpenMesh::VProp<Influences> influences(mesh, openmesh::kWeights);
  for (const auto v : mesh.vertices()) {
    const auto pairs = influences[v];
    EXPECT_EQ(pairs.size(), static_cast<std::size_t>(kMost));
    EXPECT_EQ(pairs.count(), static_cast<std::size_t>(key(mesh, v) % (kMost + 1)));
    for (std::size_t j = 1; j < pairs.count(); ++j) {
      EXPECT_LT(pairs.control_point(j - 1), pairs.control_point(j));
    }
  }
  expect_refused<Error>("has 4 weights, more than 3",
                        [&] { openmesh::set_influences(mesh, openmesh::get_weights(mesh), 3); });
}

TEST(InfluencesProperty, FollowsItsVertices) {
  auto mesh = make_squares<DoubleTri>();
  auto handle = add_influences(mesh);
  auto& property = mesh.property(handle);
  property.swap(3, 8);
  property.swap(8, 3);
  expect_influences(mesh);
  const DoubleTri copy = mesh;
  request_status(mesh);
  mesh.delete_vertex(OpenMesh::VertexHandle(0));
  mesh.delete_vertex(OpenMesh::VertexHandle(24));
  mesh.garbage_collection();
  ASSERT_LT(mesh.n_vertices(), copy.n_vertices());
  expect_influences(mesh);
  expect_influences(copy);
  const OpenMesh::VertexHandle added = mesh.add_vertex({50, 50, 0});
  EXPECT_EQ(mesh.property(handle, added).count(), 0U);
  mesh.copy_property(handle, OpenMesh::VertexHandle(5), added);
  EXPECT_EQ(mesh.property(handle, added).weight(0),
            mesh.property(handle, OpenMesh::VertexHandle(5)).weight(0));
}

template <class Mesh>
class MeshWeights : public ::testing::Test {
 protected:
  static constexpr int kDim = openmesh::kDimension<Mesh>;
  static constexpr bool kExact = !std::is_same_v<Mesh, FloatTri>;

  MeshWeights() : sample_(make_sample<kDim>(Shape::kCorner, 4, 0.2)) {
    normalize_and_validate(sample_.mesh);
    mesh_ = openmesh::to_mesh<Mesh>(sample_.mesh);
    openmesh::solve(mesh_, sample_.cage);
    weights_ = openmesh::get_weights(mesh_).dense();
    pose_ = sample_.cage;
    for (Eigen::Index i = 0; i < pose_.points.cols(); ++i) {
      pose_.points(0, i) += 0.125 * static_cast<double>(i % 5);
      pose_.points(kDim - 1, i) *= 1.5;
    }
  }

  PointList<kDim> points() const { return openmesh::points_of<kDim>(mesh_); }

  Sample<kDim> sample_;
  Mesh mesh_;
  WeightMatrix weights_;
  Cage<kDim> pose_;
};
using MeshesWithWeights = ::testing::Types<FloatTri, DoubleTri, PlaneTri, TetMesh>;
TYPED_TEST_SUITE(MeshWeights, MeshesWithWeights);

TYPED_TEST(MeshWeights, DeformAsArraysDo) {
  constexpr int kDimension = TestFixture::kDim;
  const SparseWeights sparse(this->weights_, 0.05);
  const auto expected = deform(sparse, this->pose_.points);
  openmesh::set_influences(this->mesh_, sparse);
  for (const int threads : {0, 1, 2}) {
    openmesh::DeformOptions options;
    options.threads = threads;
    openmesh::deform(this->mesh_, this->pose_, options);
    if (TestFixture::kExact) {
      EXPECT_EQ(this->points(), expected);
    } else {
      EXPECT_LT((this->points() - expected).cwiseAbs().maxCoeff(), 1e-6);
    }
  }
  openmesh::set_weights(this->mesh_, this->weights_);
  openmesh::deform(this->mesh_, this->pose_);
  const PointList<kDimension> dense = this->pose_.points * this->weights_;
  EXPECT_LT((this->points() - dense).cwiseAbs().maxCoeff(), TestFixture::kExact ? 1e-13 : 1e-6);
  Cage<kDimension> other = this->pose_;
  other.points.conservativeResize(kDimension, other.points.cols() - 1);
  expect_refused<Error>("do not match a cage with", [&] { openmesh::deform(this->mesh_, other); });
}

TYPED_TEST(MeshWeights, SparsifyLeavesTheOthersIfAsked) {
  openmesh::ReductionOptions options;
  options.into = "few";
  openmesh::sparsify(this->mesh_, 5, options);
  EXPECT_EQ(openmesh::get_weights(this->mesh_).dense(), this->weights_);
  EXPECT_EQ(openmesh::get_weights(this->mesh_, "few").num_control_points(), this->weights_.rows());
  EXPECT_EQ(openmesh::get_rest_cage(this->mesh_, "few"), this->sample_.cage.points);
  // Again, from what was left.
  options.weights = options.into;
  EXPECT_NO_THROW(openmesh::sparsify(this->mesh_, 4, options));
  expect_refused<Error>("must be at least", [&] { openmesh::sparsify(this->mesh_, 2); });
  openmesh::set_weights(this->mesh_, this->weights_, "mine");
  options.weights = "mine";
  expect_refused<Error>("does not know the cage",
                        [&] { openmesh::sparsify(this->mesh_, 5, options); });
  EXPECT_NO_THROW(openmesh::sparsify(this->mesh_, this->sample_.cage.points, 5, options));
}

// Threads come in where there is much to do.
TEST(ManyVertices, ThreadsChangeNothing) {
  constexpr int kVertices = 520000;
  FloatTri mesh;
  mesh.reserve(kVertices, 0, 0);
  for (int v = 0; v < kVertices; ++v) mesh.add_vertex({0, 0, 0});
  auto& property = openmesh::internal::get_property<Influences>(mesh, openmesh::kWeights);
  property.set_shape(8, 8);
  PointList<3> pose(3, 8);
  for (int i = 0; i < 8; ++i) pose.col(i) << i, i * i, 1;
  for (int v = 0; v < kVertices; ++v) {
    for (std::size_t j = 0; j < 8; ++j) {
      property[v].control_point(j) = static_cast<std::uint32_t>((v + j) % 8);
      property[v].weight(j) = 1.0 / static_cast<double>(j + 1 + v % 3);
    }
  }
  const auto points_with = [&](int threads) {
    openmesh::DeformOptions options;
    options.threads = threads;
    openmesh::deform(mesh, pose, options);
    return openmesh::points_of<3>(mesh);
  };
  const auto alone = points_with(1);
  EXPECT_EQ(points_with(0), alone);
  EXPECT_EQ(points_with(3), alone);
  double sum = 0;
  for (std::size_t j = 0; j < 8; ++j) sum += property[kVertices - 1].weight(j);
  EXPECT_NEAR(alone(2, kVertices - 1), sum, 1e-6);
}

}  // namespace
}  // namespace flbc::testing

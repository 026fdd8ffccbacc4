// SPDX-License-Identifier: BSD-3-Clause
// Solving on meshes of OpenMesh and on TetMesh: the same results as on plain arrays, in properties.
#include "flbc/openmesh/lbc.h"

#include <OpenMesh/Core/Geometry/EigenVectorT.hh>

#include "flbc/openmesh/bind.h"
#include "support/scratch.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

struct EigenTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
};
using EigenMesh = OpenMesh::TriMesh_ArrayKernelT<EigenTraits>;
using openmesh::TetMesh;
using openmesh::Wide;

template <class Mesh>
constexpr int kDim = openmesh::kDimension<Mesh>;
template <class Mesh>
constexpr bool kExact = !std::is_same_v<Mesh, FloatTri>;

template <class Mesh>
Mesh by_hand(const DomainMesh<2>& domain) {
  Mesh mesh;
  for (Index v = 0; v < domain.num_vertices(); ++v) {
    typename Mesh::Point point;
    using Coordinate = std::decay_t<decltype(point[0])>;
    for (std::size_t d = 0; d < OpenMesh::vector_traits<typename Mesh::Point>::size_; ++d) {
      point[d] = d < 2 ? static_cast<Coordinate>(domain.points(d, v)) : Coordinate(0.5);
    }
    mesh.add_vertex(point);
  }
  for (Index s = 0; s < domain.num_cells(); ++s) {
    mesh.add_face(mesh.vertex_handle(domain.cells(0, s)), mesh.vertex_handle(domain.cells(1, s)),
                  mesh.vertex_handle(domain.cells(2, s)));
  }
  return mesh;
}

template <class Mesh>
Mesh by_hand(const DomainMesh<3>& domain) {
  return TetMesh::from(domain);
}

template <class Mesh>
class LbcTest : public ::testing::Test {};
using SolvedMeshes = ::testing::Types<FloatTri, DoubleTri, PlaneTri, EigenMesh, TetMesh>;
TYPED_TEST_SUITE(LbcTest, SolvedMeshes);

template <int Dim>
DomainMesh<Dim> oriented(DomainMesh<Dim> mesh) {
  normalize_and_validate(mesh);
  return mesh;
}

TYPED_TEST(LbcTest, EqualsTheSolveOnArrays) {
  constexpr int kDimension = kDim<TypeParam>;
  for (const auto& sample : samples<kDimension>()) {
    SCOPED_TRACE(sample.name);
    auto mesh = by_hand<TypeParam>(sample.mesh);
    const auto report = openmesh::solve(mesh, sample.cage);
    const auto expected = solve(sample.cage, oriented(sample.mesh));
    const auto weights = openmesh::get_weights(mesh).dense();
    EXPECT_EQ(report.vertices, sample.mesh.num_vertices());
    EXPECT_LT((weights - expected.weights.dense()).cwiseAbs().maxCoeff(),
              kExact<TypeParam> ? 1e-12 : 1e-3);
    const auto judgement = judge(sample.cage, sample.mesh, weights);
    EXPECT_LT(judgement.partition_error, 1e-13);
    EXPECT_LT(judgement.reproduction_error, kExact<TypeParam> ? 1e-13 : 1e-6);
    EXPECT_GE(judgement.min_weight, 0);
  }
}

template <class Mesh>
using CellRows = typename openmesh::Elements<Mesh>::template CellProperty<Wide<double>>;

// On each cell the weights of all methods differ by gradient times edge, in the unit of the mesh.
TYPED_TEST(LbcTest, GradientsAreAPropertyOnRequest) {
  constexpr int kDimension = kDim<TypeParam>;
  auto sample = make_sample<kDimension>(Shape::kCorner, 3, 0.2);
  sample.mesh.points *= 4;
  sample.cage.points *= 4;
  auto mesh = by_hand<TypeParam>(sample.mesh);
  const auto cells = openmesh::make_domain(mesh).mesh.cells;
  CellRows<TypeParam> handle;
  openmesh::PropertyOptions properties;
  properties.gradients = true;
  for (const auto method :
       {Method::kWeights, Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SolverOptions options{method};
    openmesh::solve(mesh, sample.cage, options, properties);
    ASSERT_TRUE(mesh.get_property_handle(handle, openmesh::gradients_name()));
    const auto weights = openmesh::get_weights(mesh).dense();
    for (Index s = 0; s < sample.mesh.num_cells(); ++s) {
      const Eigen::MatrixXd gradients = mesh.property(handle)[s].matrix();
      ASSERT_EQ(gradients.rows(), kDimension);
      const Index first = cells(0, s);
      for (int k = 1; k <= kDimension; ++k) {
        const Vector<kDimension> edge =
            sample.mesh.points.col(cells(k, s)) - sample.mesh.points.col(first);
        const Eigen::VectorXd difference = weights.col(cells(k, s)) - weights.col(first);
        EXPECT_LT((gradients.transpose() * edge - difference).cwiseAbs().maxCoeff(),
                  kExact<TypeParam> ? 1e-13 : 1e-4);
      }
    }
  }
  // Weights that are replaced take their gradients along; they can be made of any weights.
  openmesh::solve(mesh, sample.cage);
  EXPECT_FALSE(mesh.get_property_handle(handle, openmesh::gradients_name()));
  openmesh::set_gradients(mesh);
  EXPECT_TRUE(mesh.get_property_handle(handle, openmesh::gradients_name()));
  openmesh::set_influences(mesh, openmesh::get_weights(mesh));
  EXPECT_FALSE(mesh.get_property_handle(handle, openmesh::gradients_name()));
}

template <class Mesh>
class LbcTriangleTest : public ::testing::Test {};
using TriangleMeshes = ::testing::Types<FloatTri, DoubleTri, PlaneTri, EigenMesh>;
TYPED_TEST_SUITE(LbcTriangleTest, TriangleMeshes);

TYPED_TEST(LbcTriangleTest, DeletedElementsAndLooseVerticesAreNamed) {
  const auto sample = make_sample<2>(Shape::kBox, 3);
  auto mesh = by_hand<TypeParam>(sample.mesh);
  request_status(mesh);
  EXPECT_NO_THROW(openmesh::solve(mesh, sample.cage));
  mesh.delete_face(mesh.face_handle(5), false);
  expect_refused("face 5; call garbage_collection()", [&] { openmesh::solve(mesh, sample.cage); });

  auto loose = by_hand<TypeParam>(sample.mesh);
  const auto point = loose.point(loose.vertex_handle(0));  // a copy: points move as they are added
  const auto added = loose.add_vertex(point);
  expect_refused("vertex " + std::to_string(added.idx()),
                 [&] { openmesh::solve(loose, sample.cage); });

  // The hole that is left after collection is no part of the cage.
  mesh.garbage_collection();
  EXPECT_THROW(openmesh::solve(mesh, sample.cage), InputError);
}

TYPED_TEST(LbcTriangleTest, ClockwiseTrianglesAndHoles) {
  const auto sample = make_sample<2>(Shape::kRing, 3, 0.2);
  auto turned = sample.mesh;
  turned.cells.row(1).swap(turned.cells.row(2));
  auto mesh = by_hand<TypeParam>(turned);
  openmesh::solve(mesh, sample.cage);
  const auto judgement = judge(sample.cage, sample.mesh, openmesh::get_weights(mesh).dense());
  EXPECT_LT(judgement.partition_error, 1e-13);
  EXPECT_GE(judgement.min_weight, 0);
}

TEST(LbcProperties, WhatBelongedToOlderWeightsIsRemoved) {
  const auto sample = make_sample<3>(Shape::kCorner, 3, 0.2);
  auto mesh = TetMesh::from(sample.mesh);
  openmesh::bind(mesh, sample.cage, sample.mesh);
  EXPECT_NO_THROW(openmesh::restore_rest(mesh));
  openmesh::solve(mesh, sample.cage);
  EXPECT_THROW(openmesh::restore_rest(mesh), InputError);
  OpenMesh::VPropHandleT<openmesh::Influences> influences;
  EXPECT_FALSE(mesh.get_property_handle(influences, openmesh::kWeights));
}

TEST(LbcPlane, MeshesOutOfAPlaneAreNamed) {
  const auto sample = make_sample<2>(Shape::kBox, 2);
  auto mesh = by_hand<DoubleTri>(sample.mesh);
  mesh.set_point(mesh.vertex_handle(3),
                 mesh.point(mesh.vertex_handle(3)) + OpenMesh::Vec3d(0, 0, 1));
  expect_refused("vertex 3 has z", [&] { openmesh::solve(mesh, sample.cage); });
}

}  // namespace
}  // namespace flbc::testing

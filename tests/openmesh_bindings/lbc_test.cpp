// SPDX-License-Identifier: BSD-3-Clause
// Solving on meshes of OpenMesh's and on TetMesh: the same results as on plain arrays, kept in
// properties.
#include "flbc/openmesh/lbc.h"

#include <gtest/gtest.h>
#include <OpenMesh/Core/Geometry/EigenVectorT.hh>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "flbc/published_penalty.h"
#include "support/hollow_sample.h"
#include "support/judge.h"
#include "support/sample_meshes.h"
#include "support/scratch.h"

namespace flbc::testing {
namespace {

struct Vec3dTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
};
struct Vec2dTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec2d;
};
struct EigenTraits : OpenMesh::DefaultTraits {
  using Point = Eigen::Vector3d;
  using Normal = Eigen::Vector3d;
};
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using DoubleMesh = OpenMesh::TriMesh_ArrayKernelT<Vec3dTraits>;
using PlaneMesh = OpenMesh::TriMesh_ArrayKernelT<Vec2dTraits>;
using EigenMesh = OpenMesh::TriMesh_ArrayKernelT<EigenTraits>;
using openmesh::TetMesh;
using openmesh::Wide;

template <class Mesh>
constexpr int kDim = openmesh::kDimension<Mesh>;
template <class Mesh>
constexpr bool kExact = !std::is_same_v<Mesh, FloatMesh>;

template <class Mesh>
Mesh build(const DomainMesh<2>& domain) {
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
Mesh build(const DomainMesh<3>& domain) {
  return TetMesh::from(domain);
}

template <class Mesh>
class LbcTest : public ::testing::Test {};
using Meshes = ::testing::Types<FloatMesh, DoubleMesh, PlaneMesh, EigenMesh, TetMesh>;
TYPED_TEST_SUITE(LbcTest, Meshes);

template <int Dim>
DomainMesh<Dim> oriented(DomainMesh<Dim> mesh) {
  normalize_and_validate(mesh);
  return mesh;
}

TYPED_TEST(LbcTest, EqualsTheSolveOnArrays) {
  constexpr int kDimension = kDim<TypeParam>;
  for (const auto& sample : samples<kDimension>()) {
    SCOPED_TRACE(sample.name);
    auto mesh = build<TypeParam>(sample.mesh);
    const auto report = openmesh::solve(mesh, sample.cage);
    const auto expected = solve(sample.cage, oriented(sample.mesh));
    const auto weights = openmesh::get_weights(mesh);
    EXPECT_EQ(report.vertices, sample.mesh.num_vertices());
    EXPECT_LT((weights - expected.weights).cwiseAbs().maxCoeff(), kExact<TypeParam> ? 1e-12 : 1e-3);
    const auto judgement = judge(sample.cage, sample.mesh, weights);
    EXPECT_LT(judgement.partition_error, 1e-13);
    EXPECT_LT(judgement.reproduction_error, kExact<TypeParam> ? 1e-13 : 1e-6);
    EXPECT_GE(judgement.min_weight, 0);
  }
}

template <class Mesh, class T>
bool has_cell_property(const Mesh& mesh, const std::string& name) {
  typename openmesh::PropertyHandles<Mesh>::template Cell<T> handle;
  return mesh.get_property_handle(handle, name);
}

TYPED_TEST(LbcTest, StateIsKeptOnlyIfAskedFor) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kCorner, 3, 0.2);
  auto mesh = build<TypeParam>(sample.mesh);
  SolverOptions options;
  options.max_iterations = 10;
  openmesh::solve(mesh, sample.cage, options);
  EXPECT_FALSE((has_cell_property<TypeParam, Wide<float>>(mesh, "flbc:splitting_state")));
  openmesh::PropertyOptions properties;
  properties.keep_state = true;
  openmesh::solve(mesh, sample.cage, options, properties);
  EXPECT_TRUE((has_cell_property<TypeParam, Wide<float>>(mesh, "flbc:splitting_state")));
  options.method = Method::kGradient;
  openmesh::solve(mesh, sample.cage, options, properties);
  EXPECT_TRUE((has_cell_property<TypeParam, Wide<float>>(mesh, "flbc:gradient")));
  typename openmesh::PropertyHandles<TypeParam>::template Facet<Wide<float>> facets;
  EXPECT_TRUE(mesh.get_property_handle(facets, "flbc:integrability_dual"));
}

// A run interrupted and gone on with equals one in one piece, bit by bit: the state is complete,
// and what the properties hold is what the iteration works on.
TYPED_TEST(LbcTest, ResumesWhereItStopped) {
  constexpr int kDimension = kDim<TypeParam>;
  for (const auto& sample : {make_sample<kDimension>(Shape::kCorner, 3, 0.2),
                             make_sample<kDimension>(Shape::kRing, 2)}) {
    for (const auto method : {Method::kValue, Method::kLbc2014, Method::kGradient}) {
      for (const auto precision : {Precision::kSingle, Precision::kDouble}) {
        SCOPED_TRACE(sample.name + ", method " + std::to_string(static_cast<int>(method)));
        SolverOptions options;
        options.method = method;
        options.precision = precision;
        options.penalty = method == Method::kGradient ? 1e-6 : 0.02;
        options.tolerance = 1e-20;
        openmesh::PropertyOptions properties;
        properties.keep_state = true;
        const auto run = [&](TypeParam& mesh, int iterations) {
          options.max_iterations = iterations;
          openmesh::solve(mesh, sample.cage, options, properties);
          return openmesh::get_weights(mesh);
        };
        auto whole = build<TypeParam>(sample.mesh);
        auto parts = build<TypeParam>(sample.mesh);
        const auto expected = run(whole, 40);
        const auto first = run(parts, 25);
        EXPECT_GT((first - expected).cwiseAbs().maxCoeff(), 0);
        EXPECT_EQ((run(parts, 15) - expected).cwiseAbs().maxCoeff(), 0);
        properties.restart = true;
        EXPECT_EQ((run(parts, 25) - first).cwiseAbs().maxCoeff(), 0);
      }
    }
  }
}

template <class Action>
void expect_refused(const std::string& words, const Action& action) {
  try {
    action();
    FAIL() << "accepted, expected: " << words;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TYPED_TEST(LbcTest, RefusesAStateThatBelongsToSomethingElse) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kBox, 3, 0.2);
  auto mesh = build<TypeParam>(sample.mesh);
  SolverOptions options;
  options.max_iterations = 10;
  openmesh::PropertyOptions properties;
  properties.keep_state = true;
  openmesh::solve(mesh, sample.cage, options, properties);

  Index inner = 0;
  const auto topology = build_topology(sample.mesh);
  const auto on_boundary = boundary_vertices(topology, sample.mesh.num_vertices());
  while (on_boundary[inner]) ++inner;
  const auto vertex = OpenMesh::VertexHandle(inner);
  const auto place = mesh.point(vertex);
  auto moved = place;
  moved[0] += static_cast<std::decay_t<decltype(moved[0])>>(0.001);
  mesh.set_point(vertex, moved);
  expect_refused("points have moved",
                 [&] { openmesh::solve(mesh, sample.cage, options, properties); });
  mesh.set_point(vertex, place);

  auto cage = sample.cage;
  cage.points(0, 0) += 1e-9;
  expect_refused("cage has changed", [&] { openmesh::solve(mesh, cage, options, properties); });
  properties.restart = true;
  EXPECT_NO_THROW(openmesh::solve(mesh, cage, options, properties));
}

TYPED_TEST(LbcTest, ReportsWhetherItWentOn) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kBox, 3, 0.2);
  auto mesh = build<TypeParam>(sample.mesh);
  SolverOptions options;
  options.max_iterations = 10;
  openmesh::PropertyOptions properties;
  properties.keep_state = true;
  const auto expect = [&](bool resumed, const std::string& reason) {
    const auto report = openmesh::solve(mesh, sample.cage, options, properties);
    EXPECT_EQ(report.resumed, resumed) << report.restart;
    EXPECT_EQ(report.restart, reason);
  };
  expect(false, "there is no state");
  expect(true, "");
  properties.restart = true;
  expect(false, "it was asked for");
  properties.restart = false;
  options.phi = DistanceScheme::kLinear;
  expect(false, "the phi was square, is linear");
  options.precision = Precision::kDouble;
  expect(false, "the precision was single, is double");
  options.method = Method::kGradient;
  expect(false, "the method was value, non-negative, is gradient");
  expect(true, "");
  properties.keep_state = false;
  expect(true, "");
  expect(false, "there is no state");
}

// The duals that solve the problem do not depend on the penalty: whoever is at the optimum stays
// there under another one.
TYPED_TEST(LbcTest, GoesOnUnderAnotherPenaltyOrRefuses) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kCorner, 3, 0.2);
  SolverOptions options;
  options.method = Method::kGradient;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-6;
  options.max_iterations = 200000;
  const double penalty =
      published_penalty(sample.cage, sample.mesh, Method::kGradient, kDimension == 2 ? 1000 : 3000);
  options.penalty = penalty;
  openmesh::PropertyOptions properties;
  properties.keep_state = true;
  auto mesh = build<TypeParam>(sample.mesh);
  const auto first = openmesh::solve(mesh, sample.cage, options, properties);
  ASSERT_EQ(first.status, SolveStatus::kConverged);
  const auto weights = openmesh::get_weights(mesh);
  options.tolerance = 1e-5;
  for (const double factor : {4., 0.5, 0.}) {
    options.penalty = factor * penalty;
    const auto report = openmesh::solve(mesh, sample.cage, options, properties);
    EXPECT_TRUE(report.resumed);
    EXPECT_EQ(report.status, SolveStatus::kConverged);
    EXPECT_LE(report.iterations, first.iterations / 4 + options.check_interval);
    EXPECT_LT(mean_squared_difference(sample.mesh, openmesh::get_weights(mesh), weights), 1e-5);
  }

  options.method = Method::kValue;
  options.tolerance = 0;
  options.penalty = 0.02;
  openmesh::solve(mesh, sample.cage, options, properties);
  options.penalty = 0.04;
  expect_refused("under another penalty",
                 [&] { openmesh::solve(mesh, sample.cage, options, properties); });
  options.penalty = 0;
  EXPECT_TRUE(openmesh::solve(mesh, sample.cage, options, properties).resumed);
}

// What an exception leaves half done is no state to go on from.
TYPED_TEST(LbcTest, AnInterruptedRunLeavesNoState) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kBox, 3, 0.2);
  for (const auto method : {Method::kValue, Method::kGradient}) {
    auto mesh = build<TypeParam>(sample.mesh);
    SolverOptions options;
    options.method = method;
    options.tolerance = 1e-20;
    options.max_iterations = 20;
    openmesh::PropertyOptions properties;
    properties.keep_state = true;
    openmesh::solve(mesh, sample.cage, options, properties);
    const auto weights = openmesh::get_weights(mesh);
    auto interrupted = options;
    interrupted.progress = [](const Progress&) -> bool { throw SolverError("interrupted"); };
    EXPECT_THROW(openmesh::solve(mesh, sample.cage, interrupted, properties), SolverError);
    EXPECT_EQ(openmesh::get_weights(mesh), weights);
    EXPECT_FALSE((has_cell_property<TypeParam, Wide<float>>(mesh, "flbc:splitting_state")));
    EXPECT_FALSE((has_cell_property<TypeParam, Wide<float>>(mesh, "flbc:gradient")));
    const auto report = openmesh::solve(mesh, sample.cage, options, properties);
    EXPECT_FALSE(report.resumed);
    EXPECT_EQ(report.restart, "the run that left the state did not come to its end");
    EXPECT_EQ(openmesh::get_weights(mesh), weights);
  }
}

TYPED_TEST(LbcTest, PhiIsAPropertyOnRequest) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kCorner, 3, 0.2);
  auto mesh = build<TypeParam>(sample.mesh);
  openmesh::PropertyOptions properties;
  properties.phi = "phi";
  SolverOptions options;
  openmesh::solve(mesh, sample.cage, options, properties);
  const auto weights = openmesh::get_weights(mesh);
  typename openmesh::PropertyHandles<TypeParam>::template Cell<Wide<double>> handle;
  ASSERT_TRUE(mesh.get_property_handle(handle, "phi"));
  auto& phi = mesh.property(handle);
  // What was left is what was used, whatever the options say.
  options.phi = DistanceScheme::kConstant;
  properties.keep_state = true;
  properties.restart = true;
  openmesh::solve(mesh, sample.cage, options, properties);
  properties.restart = false;
  EXPECT_TRUE(openmesh::solve(mesh, sample.cage, options, properties).resumed);
  properties.restart = true;
  openmesh::solve(mesh, sample.cage, options, properties);
  EXPECT_EQ(openmesh::get_weights(mesh), weights);
  // A user's own: constant, which the options have as well.
  for (std::size_t s = 0; s < phi.n_elements(); ++s) {
    for (std::size_t i = 0; i < phi.width(); ++i) phi[static_cast<int>(s)][i] = 1;
  }
  openmesh::solve(mesh, sample.cage, options, properties);
  const auto constant = openmesh::get_weights(mesh);
  properties.phi.clear();
  openmesh::solve(mesh, sample.cage, options, properties);
  EXPECT_EQ(openmesh::get_weights(mesh), constant);
  EXPECT_GT((constant - weights).cwiseAbs().maxCoeff(), 1e-3);
  properties.phi = "phi";
  phi[2][1] = -1;
  expect_refused("for cell 2, control point 1",
                 [&] { openmesh::solve(mesh, sample.cage, options, properties); });
}

TYPED_TEST(LbcTest, OtherFormsOfTheWeights) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kCorner, 3, 0.2);
  auto mesh = build<TypeParam>(sample.mesh);
  openmesh::solve(mesh, sample.cage);
  const auto weights = openmesh::get_weights(mesh);
  openmesh::write_vectors(mesh, "dense");
  openmesh::write_pairs(mesh, "sparse", 1e-4);
  OpenMesh::VPropHandleT<std::vector<double>> dense;
  OpenMesh::VPropHandleT<std::vector<double>> values;
  OpenMesh::VPropHandleT<std::vector<std::uint32_t>> indices;
  ASSERT_TRUE(mesh.get_property_handle(dense, "dense"));
  ASSERT_TRUE(mesh.get_property_handle(values, "sparse_values"));
  ASSERT_TRUE(mesh.get_property_handle(indices, "sparse_indices"));
  for (const auto v : mesh.vertices()) {
    Eigen::VectorXd from_pairs = Eigen::VectorXd::Zero(weights.rows());
    for (std::size_t k = 0; k < mesh.property(indices, v).size(); ++k) {
      from_pairs[mesh.property(indices, v)[k]] = mesh.property(values, v)[k];
    }
    const auto& row = mesh.property(dense, v);
    ASSERT_EQ(static_cast<Eigen::Index>(row.size()), weights.rows());
    for (Eigen::Index i = 0; i < weights.rows(); ++i) {
      EXPECT_EQ(row[i], weights(i, v.idx()));
      EXPECT_EQ(from_pairs[i], weights(i, v.idx()) > 1e-4 ? weights(i, v.idx()) : 0);
    }
  }
}

// An affine motion of the cage moves every point along.
TYPED_TEST(LbcTest, DeformFollowsTheCage) {
  constexpr int kDimension = kDim<TypeParam>;
  const auto sample = make_sample<kDimension>(Shape::kCorner, 3, 0.2);
  auto mesh = build<TypeParam>(sample.mesh);
  openmesh::solve(mesh, sample.cage);
  Eigen::Matrix<double, kDimension, kDimension> linear =
      Eigen::Matrix<double, kDimension, kDimension>::Identity();
  linear(0, 1) = 0.5;
  linear(1, 0) = -0.25;
  auto cage = sample.cage;
  cage.points = (linear * cage.points).colwise() + Vector<kDimension>::Constant(0.75);
  openmesh::deform(mesh, cage);
  for (const auto v : mesh.vertices()) {
    const Vector<kDimension> expected =
        linear * sample.mesh.points.col(v.idx()) + Vector<kDimension>::Constant(0.75);
    for (int d = 0; d < kDimension; ++d) {
      EXPECT_NEAR(mesh.point(v)[d], expected[d], kExact<TypeParam> ? 1e-12 : 1e-5);
    }
  }
  cage.points.conservativeResize(kDimension, cage.points.cols() - 1);
  expect_refused("do not belong to a cage with", [&] { openmesh::deform(mesh, cage); });
  auto bare = build<TypeParam>(sample.mesh);
  expect_refused("has no weights", [&] { openmesh::deform(bare, sample.cage); });
}

template <class Mesh>
class LbcTriangleTest : public ::testing::Test {};
using TriangleMeshes = ::testing::Types<FloatMesh, DoubleMesh, PlaneMesh, EigenMesh>;
TYPED_TEST_SUITE(LbcTriangleTest, TriangleMeshes);

TYPED_TEST(LbcTriangleTest, DeletedElementsAndLooseVerticesAreNamed) {
  const auto sample = make_sample<2>(Shape::kBox, 3);
  auto mesh = build<TypeParam>(sample.mesh);
  mesh.request_face_status();
  mesh.request_edge_status();
  mesh.request_vertex_status();
  EXPECT_NO_THROW(openmesh::solve(mesh, sample.cage));
  mesh.delete_face(mesh.face_handle(5), false);
  expect_refused("face 5; call garbage_collection()", [&] { openmesh::solve(mesh, sample.cage); });

  auto loose = build<TypeParam>(sample.mesh);
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
  auto mesh = build<TypeParam>(turned);
  openmesh::solve(mesh, sample.cage);
  const auto judgement = judge(sample.cage, sample.mesh, openmesh::get_weights(mesh));
  EXPECT_LT(judgement.partition_error, 1e-13);
  EXPECT_GE(judgement.min_weight, 0);
}

// Weights and state live on in an .om file, to the bit, and a loaded mesh goes on where it was.
TEST(LbcFile, StateAndWeightsSurvive) {
  const auto sample = make_sample<2>(Shape::kRing, 3, 0.2);
  for (const auto method : {Method::kValue, Method::kGradient}) {
    auto mesh = build<DoubleMesh>(sample.mesh);
    SolverOptions options;
    options.method = method;
    options.tolerance = 1e-20;
    options.max_iterations = 30;
    options.penalty = method == Method::kGradient ? 1e-6 : 0.02;
    openmesh::PropertyOptions properties;
    properties.keep_state = true;
    properties.persistent = true;
    openmesh::solve(mesh, sample.cage, options, properties);
    const std::string path = scratch_path("lbc_state.om");
    ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path));
    DoubleMesh loaded;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(loaded, path));
    EXPECT_EQ((openmesh::get_weights(loaded) - openmesh::get_weights(mesh)).cwiseAbs().maxCoeff(),
              0);
    openmesh::solve(mesh, sample.cage, options, properties);
    // What is loaded and saved again is still there.
    ASSERT_TRUE(OpenMesh::IO::write_mesh(loaded, path));
    DoubleMesh again;
    ASSERT_TRUE(OpenMesh::IO::read_mesh(again, path));
    EXPECT_EQ(openmesh::get_rest_cage(again), sample.cage.points);
    EXPECT_TRUE(openmesh::solve(again, sample.cage, options, properties).resumed);
    const auto report = openmesh::solve(loaded, sample.cage, options, properties);
    EXPECT_EQ(openmesh::get_weights(again), openmesh::get_weights(loaded));
    EXPECT_EQ(report.iterations, 30);
    EXPECT_EQ((openmesh::get_weights(loaded) - openmesh::get_weights(mesh)).cwiseAbs().maxCoeff(),
              0);
    properties.restart = true;
    const auto resumed = openmesh::get_weights(loaded);
    openmesh::solve(loaded, sample.cage, options, properties);
    EXPECT_GT((openmesh::get_weights(loaded) - resumed).cwiseAbs().maxCoeff(), 0);
  }
}

TEST(LbcPlane, MeshesOutOfAPlaneAreNamed) {
  const auto sample = make_sample<2>(Shape::kBox, 2);
  auto mesh = build<DoubleMesh>(sample.mesh);
  mesh.set_point(mesh.vertex_handle(3),
                 mesh.point(mesh.vertex_handle(3)) + OpenMesh::Vec3d(0, 0, 1));
  expect_refused("vertex 3 has z", [&] { openmesh::solve(mesh, sample.cage); });
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// From a model and a cage to a model that follows the cage.
#include "flbc/openmesh/bind.h"

#include "flbc/cell_locator.h"
#include "flbc/solver.h"
#include "support/test.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

template <class MeshType, int Dimension>
struct ModelCase {
  using Mesh = MeshType;
  static constexpr int kDim = Dimension;
  static constexpr double kRounding =
      std::is_same_v<typename OpenMesh::vector_traits<typename Mesh::Point>::value_type, float>
          ? 1e-6
          : 1e-12;
};
template <class Case>
class Bind : public ::testing::Test {
 protected:
  static constexpr int kDim = Case::kDim;
  using Mesh = typename Case::Mesh;

  Bind() : sample_(make_sample<kDim>(Shape::kBox, 4, 0.2)) {
    options_.max_influences = 5;
    // A sheet in the middle of any box.
    const Vector<kDim> middle = sample_.cage.points.rowwise().mean();
    const PointList<kDim> spread = sample_.cage.points.colwise() - middle;
    constexpr int kSide = 6;
    model_ = make_squares<Mesh>(kSide);
    for (const auto v : model_.vertices()) {
      auto point = model_.point(v);
      // Inside: a mean of control points with non-negative weights.
      const Vector<kDim> place =
          middle + spread.leftCols(2) * Vector<2>(0.05 * point[0] - 0.15, 0.05 * point[1] - 0.15);
      for (int d = 0; d < 3; ++d) {
        point[d] = static_cast<typename Mesh::Scalar>(d < kDim ? place[d] : 0.25);
      }
      model_.set_point(v, point);
    }
    rest_ = points();
  }

  PointList<kDim> points() const { return openmesh::points_of<kDim>(model_); }

  PointList<kDim> random_pose(unsigned seed) const {
    std::srand(seed);
    return sample_.cage.points + 0.2 * PointList<kDim>::Random(kDim, sample_.cage.size());
  }

  Sample<kDim> sample_;
  Mesh model_;
  PointList<kDim> rest_;
  openmesh::BindOptions options_;
};
using Cases = ::testing::Types<ModelCase<FloatTri, 2>, ModelCase<DoublePoly, 2>,
                               ModelCase<DoubleTri, 3>, ModelCase<FloatPoly, 3>>;
TYPED_TEST_SUITE(Bind, Cases);

TYPED_TEST(Bind, LeavesTheWeightsThatTheStepsGive) {
  constexpr int kDimension = TypeParam::kDim;
  const auto& [cage, domain, name] = this->sample_;
  const auto solution = solve(cage, domain);
  auto valid = domain;
  normalize_and_validate(valid);
  const auto all =
      interpolate(valid, solution.weights.dense(), locate_points<kDimension>(valid, this->rest_))
          .dense();
  const auto edges = edges_of_polygons(this->rest_, openmesh::polygons_of(this->model_));
  for (const auto reduction : {openmesh::Reduction::kPoisson, openmesh::Reduction::kQuadratic}) {
    this->options_.reduction = reduction;
    const auto report = openmesh::bind(this->model_, cage, domain, this->options_);
    const auto expected =
        reduction == openmesh::Reduction::kPoisson
            ? reduce_by_poisson<kDimension>(cage.points, this->rest_, edges, all, {}, {5}).dense()
            : sparsify<kDimension>(cage.points, this->rest_, all, {5}).dense();
    EXPECT_EQ(openmesh::get_weights(this->model_).dense(), expected);
    EXPECT_EQ(report.solve.iterations, solution.report.iterations);
    EXPECT_EQ(report.solve.vertices, domain.num_vertices());
    EXPECT_LT(report.quality.max_reproduction_error, 1e-12);
    EXPECT_LT(report.quality.max_partition_error, 1e-12);
    EXPECT_GE(report.quality.min_weight, 0);
    EXPECT_EQ(report.outside, 0);
  }
  this->options_.max_influences = 0;
  openmesh::bind(this->model_, cage, domain, this->options_);
  EXPECT_EQ(openmesh::get_weights(this->model_).dense(), all);
}

TYPED_TEST(Bind, TheObserverSeesTheSolveAndMayCancelIt) {
  const auto& [cage, domain, name] = this->sample_;
  auto options = this->options_;
  options.solver.threads = 1;
  options.max_influences = 5;
  int calls = 0, last = -1;
  options.observer.poll = [&] {
    if (++calls == last) throw std::runtime_error("cancelled");
  };
  bind(this->model_, cage, domain, options);
  const int all = calls;

  auto fresh = this->model_;
  options.weights = "others";
  // In the beginning, and during the reduction.
  for (const int call : {1, all - 1}) {
    last = call;
    calls = 0;
    EXPECT_THROW(bind(fresh, cage, domain, options), std::runtime_error);
    EXPECT_EQ(calls, last);
    EXPECT_EQ(openmesh::get_rest_cage(fresh, "others").size(), 0);
  }
}

TYPED_TEST(Bind, FramesFollowTheCageAndDoNotAccumulate) {
  constexpr int kDimension = TypeParam::kDim;
  const auto& cage = this->sample_.cage;
  openmesh::bind(this->model_, cage, this->sample_.mesh, this->options_);
  EXPECT_EQ(this->points(), this->rest_);
  const auto weights = openmesh::get_weights(this->model_).dense();
  for (unsigned frame = 1; frame < 4; ++frame) {
    const auto pose = this->random_pose(frame);
    openmesh::deform(this->model_, pose);
    const PointList<kDimension> expected = pose * weights;
    EXPECT_LT((this->points() - expected).cwiseAbs().maxCoeff(), TypeParam::kRounding);
  }
  openmesh::deform(this->model_, cage);
  EXPECT_LT((this->points() - this->rest_).cwiseAbs().maxCoeff(), TypeParam::kRounding);
  openmesh::deform(this->model_, this->random_pose(9));
  openmesh::restore_rest(this->model_);
  EXPECT_EQ(this->points(), this->rest_);
}

// Vertices that tools of OpenMesh add have no weights: they stay, until they are bound as well.
TYPED_TEST(Bind, NewVerticesStayUntilTheyAreBound) {
  constexpr int kDimension = TypeParam::kDim;
  const auto& cage = this->sample_.cage;
  for (const Index most : {5, 0}) {
    auto model = this->model_;
    this->options_.max_influences = most;
    openmesh::bind(model, cage, this->sample_.mesh, this->options_);
    EXPECT_EQ(openmesh::bind_new_vertices(model), 0);
    const auto face = model.face_handle(3);
    const auto fresh = model.add_vertex(model.calc_face_centroid(face));
    model.split(face, fresh);
    const auto inner = model.add_vertex(model.point(fresh));
    model.split(*model.vf_iter(fresh), inner);
    const auto rest = model.point(fresh);

    const auto pose = this->random_pose(2);
    EXPECT_EQ(openmesh::deform(model, pose), 2);
    EXPECT_EQ(model.point(fresh), rest);
    EXPECT_EQ(model.point(inner), rest);
    const auto before = openmesh::get_weights(model).dense();
    expect_refused<Error>("the model is not at rest; call restore_rest()",
                          [&] { openmesh::bind_new_vertices(model); });
    EXPECT_EQ(openmesh::get_weights(model).dense(), before);
    openmesh::restore_rest(model);
    EXPECT_EQ(model.point(fresh), rest);
    EXPECT_EQ(openmesh::points_of<kDimension>(model).leftCols(this->rest_.cols()), this->rest_);

    EXPECT_EQ(openmesh::bind_new_vertices(model), 2);
    const PointList<kDimension> all = openmesh::points_of<kDimension>(model);
    const auto weights = openmesh::get_weights(model).dense();
    if (most > 0) {
      EXPECT_LE((weights.array() != 0).colwise().count().maxCoeff(), most);
    }
    EXPECT_GE(weights.minCoeff(), 0);
    EXPECT_LT((cage.points * weights - all).cwiseAbs().maxCoeff(), TypeParam::kRounding);
    EXPECT_EQ(openmesh::deform(model, pose), 0);
    EXPECT_LT((openmesh::points_of<kDimension>(model) - pose * weights).cwiseAbs().maxCoeff(),
              TypeParam::kRounding);
    openmesh::restore_rest(model);
    EXPECT_EQ(openmesh::points_of<kDimension>(model), all);

    model.add_vertex(rest);
    expect_refused<Error>("vertex 51 is not connected",
                          [&] { openmesh::bind_new_vertices(model); });
  }
  typename TypeParam::Mesh unbound;
  expect_refused<Error>("has no weights", [&] { openmesh::bind_new_vertices(unbound); });
}

// bind() without a domain mesh needs a mesher.
#ifdef FLBC_LINKS_TETGEN

// As the readers of OpenMesh make them at edges where more than two faces meet.
TEST(BindCage, DoubledVerticesOfACageAreNamed) {
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
  Mesh model;
  auto cage = openmesh::to_mesh<Mesh>(make_sample<3>(Shape::kBox, 1).cage);
  cage.add_vertex(cage.point(OpenMesh::VertexHandle(2)));
  model.add_vertex({0, 0, 0});
  expect_refused<Error>("OpenMesh doubles vertices", [&] { openmesh::bind(model, cage); });
}

TEST(BindCage, CrossingFacetsAreNamed) {
  if (!internal::kLinksCgal) GTEST_SKIP() << "without CGAL";
  OpenMesh::TriMesh_ArrayKernelT<> model;
  model.add_vertex({0, 1.7F, 0});  // in one of the boxes
  const Cage<3> cage = join(box_cage<3>(Vector<3>(-1, -2, -1), Vector<3>(1, 2, 1)),
                            box_cage<3>(Vector<3>(-2, -1, -2), Vector<3>(2, 1, 2)));
  expect_refused<InputError>("of the cage intersect near", [&] { openmesh::bind(model, cage); });
}

#endif

// The vertex at `index` is put before the middle of a facet, at a tenth of the cage's size.
template <int Dim, class Mesh>
Vector<Dim> put_outside(Mesh& model, const Cage<Dim>& cage, int index, Index facet) {
  Vector<Dim> middle = Vector<Dim>::Zero();
  for (int k = 0; k < Dim; ++k) middle += cage.points.col(cage.facets(k, facet)) / Dim;
  const Vector<Dim> centre = cage.points.rowwise().mean();
  Eigen::Matrix<double, Dim, Dim - 1> edges;
  for (int k = 1; k < Dim; ++k) {
    edges.col(k - 1) =
        cage.points.col(cage.facets(k, facet)) - cage.points.col(cage.facets(0, facet));
  }
  // What is left of the way from the center is normal to the facet.
  Vector<Dim> normal = middle - centre;
  normal -= edges * (edges.transpose() * edges).inverse() * (edges.transpose() * normal).eval();
  const Vector<Dim> place = middle + 0.1 * normal.normalized();
  auto point = model.point(OpenMesh::VertexHandle(index));
  for (int d = 0; d < Dim; ++d) point[d] = static_cast<typename Mesh::Scalar>(place[d]);
  model.set_point(OpenMesh::VertexHandle(index), point);
  return middle;
}

TYPED_TEST(Bind, VerticesOutsideAreNamedOrFollowTheCage) {
  constexpr int kDimension = TypeParam::kDim;
  const auto& cage = this->sample_.cage;
  constexpr int kVertex = 11;
  constexpr Index kFacet = 1;
  put_outside<kDimension>(this->model_, cage, kVertex, kFacet);
  const auto rest = this->points();
  expect_refused<Error>("1 of 49 vertices are outside the cage; the farthest is vertex 11", [&] {
    openmesh::bind(this->model_, cage, this->sample_.mesh, this->options_);
  });
  EXPECT_THROW(openmesh::get_weights(this->model_), InputError);

  this->options_.outside = openmesh::OutsidePoints::kNearest;
  const auto report = openmesh::bind(this->model_, cage, this->sample_.mesh, this->options_);
  EXPECT_EQ(report.outside, 1);
  openmesh::deform(this->model_, cage);
  EXPECT_LT((this->points() - rest).cwiseAbs().maxCoeff(), TypeParam::kRounding);
  const auto pose = this->random_pose(5);
  openmesh::deform(this->model_, pose);
  // By symmetry the nearest point is the middle of the facet, which moves as its corners do.
  Vector<kDimension> moved = rest.col(kVertex);
  for (int k = 0; k < kDimension; ++k) {
    const Index corner = cage.facets(k, kFacet);
    moved += (pose.col(corner) - cage.points.col(corner)) / kDimension;
  }
  EXPECT_LT((this->points().col(kVertex) - moved).norm(), 1e-5);
  // Fewer influences later, or other weights, do not leave it behind or carry it along.
  openmesh::sparsify(this->model_, 4);
  openmesh::deform(this->model_, pose);
  EXPECT_LT((this->points().col(kVertex) - moved).norm(), 1e-5);
  const auto weights = openmesh::get_weights(this->model_).dense();
  openmesh::set_weights(this->model_, weights);
  openmesh::deform(this->model_, pose);
  EXPECT_LT((this->points().col(kVertex) - pose * weights.col(kVertex)).norm(),
            TypeParam::kRounding);
}

TYPED_TEST(Bind, AKeptVertexAtTheOriginIsBound) {
  auto cage = this->sample_.cage;
  constexpr int kVertex = 11;
  put_outside<TypeParam::kDim>(this->model_, cage, kVertex, 1);
  const Vector<TypeParam::kDim> origin = this->points().col(kVertex);
  for (const auto v : this->model_.vertices()) {
    auto point = this->model_.point(v);
    for (int d = 0; d < TypeParam::kDim; ++d) {
      point[d] -= static_cast<typename TestFixture::Mesh::Scalar>(origin[d]);
    }
    this->model_.set_point(v, point);
  }
  cage.points.colwise() -= origin;
  auto mesh = this->sample_.mesh;
  mesh.points.colwise() -= origin;
  this->options_.outside = openmesh::OutsidePoints::kKeep;
  openmesh::bind(this->model_, cage, mesh, this->options_);
  EXPECT_TRUE(this->points().col(kVertex).isZero(0));
  EXPECT_EQ(openmesh::deform(this->model_, cage), 0);
  EXPECT_EQ(openmesh::bind_new_vertices(this->model_), 0);
}

TYPED_TEST(Bind, WeightsAreRefusedAfterClean) {
  openmesh::bind(this->model_, this->sample_.cage, this->sample_.mesh, this->options_);
  this->model_.clean();
  expect_refused<InputError>("the mesh has 0 vertices, but weights of 49",
                             [&] { openmesh::deform(this->model_, this->sample_.cage); });
  for (int v = 0; v < 3; ++v) {
    this->model_.add_vertex({0, 0, 0});
    expect_refused<InputError>("vertices was bound",
                               [&] { openmesh::deform(this->model_, this->sample_.cage); });
  }
}

TYPED_TEST(Bind, BindingsOfOtherMeshesAreRefused) {
  auto& model = this->model_;
  openmesh::bind(model, this->sample_.cage, this->sample_.mesh, this->options_);
  const auto binding = openmesh::get_binding<TypeParam::kDim>(model);
  openmesh::deform(model, this->random_pose(3));
  const auto set = [&] { openmesh::set_binding(model, binding, 8); };
  expect_refused<Error>("but the binding has it at", set);  // not at rest
  openmesh::restore_rest(model);
  EXPECT_NO_THROW(set());
  const auto first = model.point(OpenMesh::VertexHandle(0));
  model.add_vertex(first);
  expect_refused<Error>("vertices, but the binding is of", set);
}

TYPED_TEST(Bind, NormalsFollowOnRequest) {
  openmesh::bind(this->model_, this->sample_.cage, this->sample_.mesh, this->options_);
  auto& model = this->model_;
  model.request_vertex_normals();
  model.request_halfedge_normals();
  openmesh::DeformOptions options;
  options.normals = true;
  const auto pose = this->random_pose(7);
  openmesh::deform(model, pose, options);
  EXPECT_FALSE(model.has_face_normals());
  auto copy = model;
  copy.request_face_normals();
  copy.update_normals();
  for (const auto v : model.vertices()) {
    EXPECT_NEAR((model.normal(v) - copy.normal(v)).norm(), 0, 1e-5);
    EXPECT_NEAR(model.normal(v).norm(), 1, 1e-5);
  }
  for (const auto h : model.halfedges()) {
    EXPECT_NEAR((model.normal(h) - copy.normal(h)).norm(), 0, 1e-5);
  }

  model.request_face_normals();
  openmesh::deform(model, pose, options);
  for (const auto f : model.faces()) {
    EXPECT_NEAR((model.normal(f) - copy.normal(f)).norm(), 0, 1e-5);
  }
}

TYPED_TEST(Bind, BadInputIsNamed) {
  auto& model = this->model_;
  const auto& cage = this->sample_.cage;
  const auto& domain = this->sample_.mesh;
  const auto bind = [&] { openmesh::bind(model, cage, domain, this->options_); };
  this->options_.max_influences = 2;
  expect_refused<Error>("max_influences must be at least", bind);
  this->options_.max_influences = -1;
  expect_refused<Error>("max_influences", bind);
  this->options_.max_influences = 5;
  const typename TypeParam::Mesh::VertexHandle vertex(7);
  const auto place = model.point(vertex);
  auto nowhere = place;
  nowhere[1] = std::numeric_limits<float>::quiet_NaN();
  model.set_point(vertex, nowhere);
  expect_refused<Error>("point 7 at ", bind);
  model.set_point(vertex, place);
  request_status(model);
  model.delete_face(model.face_handle(5), false);
  expect_refused<Error>("face 5; call garbage_collection()", bind);
  typename TypeParam::Mesh empty;
  expect_refused<Error>("no vertices",
                        [&] { openmesh::bind(empty, cage, domain, this->options_); });
  expect_refused<Error>("has no weights", [&] { openmesh::deform(empty, cage); });
  expect_refused<Error>("has no weights", [&] { openmesh::restore_rest(empty); });
}

}  // namespace
}  // namespace flbc::testing

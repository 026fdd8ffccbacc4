// SPDX-License-Identifier: BSD-3-Clause
// The iteration on a mesh against that of the core on arrays, and its state in the properties of
// the mesh.
#include "flbc/openmesh/gradient_admm.h"

#include "flbc/openmesh/convert.h"
#include "flbc/solver.h"
#include "solver/methods/gradient/gradient_admm.h"
#include "support/hollow_sample.h"
#include "support/scratch.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

using openmesh::GradientAdmmOptions;
using openmesh::TetMesh;
template <class Mesh>
using Admm = openmesh::GradientAdmm<Mesh>;

template <class Mesh>
class MeshAdmm : public ::testing::Test {};
using IterationMeshes = ::testing::Types<DoubleTri, TetMesh>;
TYPED_TEST_SUITE(MeshAdmm, IterationMeshes);

// In a unit of length and a place that are not those of the solver.
template <int Dim>
Sample<Dim> moved(Sample<Dim> sample) {
  normalize_and_validate(sample.mesh);
  for (auto* points : {&sample.cage.points, &sample.mesh.points}) {
    *points = (3 * *points).colwise() + Vector<Dim>::Constant(0.5);
  }
  return sample;
}

// A ring has a hole in 2D and a handle in 3D; a hollow box has two components of the boundary.
template <int Dim>
std::vector<Sample<Dim>> all_samples() {
  return {moved(make_sample<Dim>(Shape::kBox, 3, 0.2)),
          moved(make_sample<Dim>(Shape::kCorner, 3, 0.2)), moved(make_sample<Dim>(Shape::kRing, 2)),
          moved(make_hollow_sample<Dim>())};
}

// Lets some balls of the Z-step be active and some not. For sizes of about 3.
template <int Dim>
constexpr double kPenalty = Dim == 2 ? 1e-3 : 1e-4;

template <class Mesh>
void expect_iterates_of_kernel(const Sample<Admm<Mesh>::kDim>& sample, double relaxation) {
  constexpr int kDim = Admm<Mesh>::kDim;
  auto mesh = openmesh::to_mesh<Mesh>(sample.mesh);
  GradientAdmmOptions options;
  options.penalty = kPenalty<kDim>;
  options.relaxation = relaxation;
  Admm<Mesh> admm(mesh, sample.cage, options);
  const auto problem = make_problem(sample.cage, sample.mesh, options.phi, 0);
  const double s = problem.scale;
  gradient::GradientAdmm<double, kDim> kernel(problem, options.penalty * std::pow(s, kDim + 1),
                                              relaxation, gradient::boundary_periods(problem));
  kernel.start_from_weights(harmonic_coordinates(problem));
  double active = 0;
  for (int iteration = 1; iteration <= 40; ++iteration) {
    const auto expected = kernel.residuals(kernel.iterate());
    const auto residuals = admm.iterate();
    double difference = 0, largest = 0;
    for (const auto cell : openmesh::Elements<Mesh>::cells(mesh)) {
      const auto gradient = kernel.gradients().cell(cell.idx());
      largest = std::max(largest, gradient.cwiseAbs().maxCoeff());
      difference = std::max(difference, (admm.gradient(cell) / s - gradient).cwiseAbs().maxCoeff());
      active = std::max(active, admm.cell_dual(cell).cwiseAbs().maxCoeff());
    }
    ASSERT_LT(difference, 1e-10 * largest) << "iteration " << iteration;
    EXPECT_NEAR(residuals.primal / s, expected.primal, 1e-6 * expected.primal + 1e-12);
    EXPECT_NEAR(residuals.dual * std::pow(s, kDim), expected.dual, 1e-6 * expected.dual);
  }
  EXPECT_GT(active, 0);
}

TYPED_TEST(MeshAdmm, HasTheIteratesOfTheArrayKernel) {
  for (const auto& sample : all_samples<Admm<TypeParam>::kDim>()) {
    SCOPED_TRACE(sample.name);
    expect_iterates_of_kernel<TypeParam>(sample, 1);
    expect_iterates_of_kernel<TypeParam>(sample, 1.7);
  }
}

// In units of the paper, the thresholds of its section 5 need no conversion, and other units give
// the same number of iterations.
TYPED_TEST(MeshAdmm, ConvergesByTheCriterionOfThePaper) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  auto sample = make_sample<kDim>(Shape::kCorner, 2, 0.1);
  const Vector<kDim> center =
      (sample.mesh.points.rowwise().minCoeff() + sample.mesh.points.rowwise().maxCoeff()) / 2;
  const double radius = (sample.mesh.points.colwise() - center).colwise().norm().maxCoeff();
  std::vector<int> iterations;
  for (const double scale : {250 / radius, 1.0}) {
    auto scaled = sample;
    scaled.cage.points *= scale;
    scaled.mesh.points *= scale;
    auto mesh = openmesh::to_mesh<TypeParam>(scaled.mesh);
    Admm<TypeParam> admm(mesh, scaled.cage);
    EXPECT_FALSE(admm.converged());
    const double components =
        static_cast<double>(scaled.cage.size()) * kDim * (kDim + 2) * scaled.mesh.num_cells();
    int made = 0;
    for (; made < 20000 && !admm.converged(); ++made) {
      const auto [primal, dual] = admm.iterate();
      if (scale == 1) continue;
      EXPECT_EQ(admm.converged(), primal <= 1e-7 * components && dual <= 1e-6 * components);
    }
    iterations.push_back(made);
  }
  EXPECT_GT(iterations[0], 1);
  EXPECT_LT(iterations[0], 20000);
  EXPECT_NEAR(iterations[1], iterations[0], 1);
}

TYPED_TEST(MeshAdmm, ResidualsDoNotDependOnThreads) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  const auto sample = moved(make_sample<kDim>(Shape::kRing, kDim == 2 ? 8 : 3, 0.2));
  std::vector<double> alone;
  for (const int threads : {1, 2, 3, 4}) {
    SCOPED_TRACE(threads);
    const ThreadScope scope(threads);
    auto mesh = openmesh::to_mesh<TypeParam>(sample.mesh);
    Admm<TypeParam> admm(mesh, sample.cage);
    ASSERT_GE(sample.mesh.num_cells(), kFewestInParallel);
    for (std::size_t k = 0; k < 20; ++k) {
      const auto [primal, dual] = admm.iterate();
      if (threads == 1) alone.insert(alone.end(), {primal, dual});
      EXPECT_EQ(primal, alone[2 * k]);
      EXPECT_EQ(dual, alone[2 * k + 1]);
    }
  }
}

TYPED_TEST(MeshAdmm, ReachesTheSolutionWithThePenaltyOfTheSolver) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  const auto sample = moved(make_sample<kDim>(Shape::kRing, 2));
  SolverOptions options{Method::kGradient};
  options.smoothness = 0;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-12;  // the error is larger, because the optimum is flat
  options.max_iterations = 100000;
  options.non_negative = NonNegative::kOff;
  const auto expected = solve(sample.cage, sample.mesh, options);
  auto mesh = openmesh::to_mesh<TypeParam>(sample.mesh);
  GradientAdmmOptions relaxed;
  relaxed.relaxation = 1.8;
  Admm<TypeParam> admm(mesh, sample.cage, relaxed);
  EXPECT_NEAR(admm.penalty() / std::pow(bounding_box_diagonal(sample.cage.points), kDim + 1),
              expected.report.penalty, 1e-9 * expected.report.penalty);
  admm.iterate(6000);
  admm.recover_weights();
  EXPECT_LT(mean_squared_difference(sample.mesh, openmesh::get_weights(mesh).dense(),
                                    expected.weights.dense()),
            1e-8);
  EXPECT_EQ(openmesh::get_rest_cage(mesh), sample.cage.points);
  // At the optimum a dual is phi A long where the gradient is not 0, and points against it.
  const auto phi = make_problem(sample.cage, sample.mesh, relaxed.phi, 0).phi.dense();
  for (const auto cell : openmesh::Elements<TypeParam>::cells(mesh)) {
    for (Index i = 0; i < sample.cage.size(); ++i) {
      const Vector<kDim> dual = admm.cell_dual(cell).col(i), gradient = admm.gradient(cell).col(i);
      const double radius = phi(i, cell.idx()) * signed_measure(sample.mesh, cell.idx());
      EXPECT_LE(dual.norm(), radius * (1 + 1e-9));
      if (gradient.norm() < 0.05) continue;
      EXPECT_NEAR(dual.dot(gradient), -radius * gradient.norm(), 0.01 * radius * gradient.norm());
    }
  }
}

// All gradients, by the vertices of their cells.
template <class Mesh>
std::map<std::set<int>, Eigen::MatrixXd> gradients_of(const Mesh& mesh, const Admm<Mesh>& admm) {
  std::map<std::set<int>, Eigen::MatrixXd> gradients;
  for (const auto cell : openmesh::Elements<Mesh>::cells(mesh)) {
    std::set<int> vertices;
    if constexpr (std::is_same_v<Mesh, TetMesh>) {
      for (const auto vertex : mesh.cv_range(cell)) vertices.insert(vertex.idx());
    } else {
      for (const auto vertex : mesh.fv_range(cell)) vertices.insert(vertex.idx());
    }
    gradients[vertices] = admm.gradient(cell);
  }
  return gradients;
}

template <class Mesh>
double largest_difference(const std::map<std::set<int>, Eigen::MatrixXd>& expected,
                          const Mesh& mesh, const Admm<Mesh>& admm) {
  double largest = 0;
  for (const auto& [vertices, gradient] : gradients_of(mesh, admm)) {
    largest = std::max(largest, (gradient - expected.at(vertices)).cwiseAbs().maxCoeff());
  }
  return largest;
}

TYPED_TEST(MeshAdmm, ResumesFromItsProperties) {
  for (const auto& sample : all_samples<Admm<TypeParam>::kDim>()) {
    SCOPED_TRACE(sample.name);
    auto whole = openmesh::to_mesh<TypeParam>(sample.mesh);
    Admm<TypeParam> uninterrupted(whole, sample.cage);
    uninterrupted.iterate(25);
    const auto intermediate = gradients_of(whole, uninterrupted);
    uninterrupted.iterate(15);
    const auto expected = gradients_of(whole, uninterrupted);
    auto parts = openmesh::to_mesh<TypeParam>(sample.mesh);
    EXPECT_FALSE((Admm<TypeParam>(parts, sample.cage).resumed()));
    {
      Admm<TypeParam> first(parts, sample.cage);
      first.iterate(25);
      EXPECT_EQ(largest_difference(intermediate, parts, first), 0);
    }
    Admm<TypeParam> second(parts, sample.cage);
    EXPECT_TRUE(second.resumed());
    second.iterate(15);
    EXPECT_EQ(largest_difference(expected, parts, second), 0);
    EXPECT_GT(largest_difference(intermediate, parts, second), 1e-6);
    second.restart();
    second.iterate(25);
    EXPECT_EQ(largest_difference(intermediate, parts, second), 0);
  }
}

// The duals are those of the problem, so that the optimum is one for every penalty.
TYPED_TEST(MeshAdmm, StaysAtTheOptimumUnderAnotherPenalty) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  const auto sample = moved(make_sample<kDim>(Shape::kCorner, 2));
  auto mesh = openmesh::to_mesh<TypeParam>(sample.mesh);
  GradientAdmmOptions options;
  options.relaxation = 1.8;
  {
    Admm<TypeParam> admm(mesh, sample.cage, options);
    admm.iterate(4000);
    options.penalty = 4 * admm.penalty();
  }
  Admm<TypeParam> admm(mesh, sample.cage, options);
  const auto optimum = gradients_of(mesh, admm);
  admm.iterate(1);
  EXPECT_LT(largest_difference(optimum, mesh, admm), 1e-3);
  admm.iterate(20);
  EXPECT_LT(largest_difference(optimum, mesh, admm), 5e-3);
}

TEST(MeshAdmmOnTriangles, StateFollowsGarbageCollection) {
  const auto sample = moved(make_sample<2>(Shape::kRing, 3, 0.2));
  GradientAdmmOptions options;
  options.phi = DistanceScheme::kConstant;  // distances depend on the numbering, by 1e-7
  auto whole = openmesh::to_mesh<DoubleTri>(sample.mesh);
  Admm<DoubleTri> uninterrupted(whole, sample.cage, options);
  uninterrupted.iterate(40);
  const auto expected = gradients_of(whole, uninterrupted);

  auto mesh = openmesh::to_mesh<DoubleTri>(sample.mesh);
  Admm<DoubleTri>(mesh, sample.cage, options).iterate(25);
  mesh.request_face_status();
  mesh.request_edge_status();
  mesh.request_vertex_status();
  const auto corners_of = [&](OpenMesh::FaceHandle face) {
    std::vector<OpenMesh::VertexHandle> corners;
    for (const auto vertex : mesh.fv_range(face)) corners.push_back(vertex);
    return corners;
  };
  const int num_faces = static_cast<int>(mesh.n_faces());
  // Every inner face is recreated at the end; collection then moves the last ones to the front.
  for (int f = 0; f < num_faces; ++f) {
    const auto face = mesh.face_handle(f);
    bool is_inner = true;
    for (const auto edge : mesh.fe_range(face)) is_inner = is_inner && !mesh.is_boundary(edge);
    if (!is_inner) continue;
    const auto corners = corners_of(face);
    mesh.delete_face(face, false);
    mesh.copy_all_properties(face, mesh.add_face(corners));
  }
  mesh.garbage_collection();
  ASSERT_EQ(static_cast<int>(mesh.n_faces()), num_faces);
  int moved = 0;
  for (int f = 0; f < num_faces; ++f) {
    const auto corners = corners_of(mesh.face_handle(f));
    const auto original = sample.mesh.cells.col(f);
    std::set<Index> now, then(original.begin(), original.end());
    for (const auto corner : corners) now.insert(corner.idx());
    if (now != then) ++moved;
  }
  ASSERT_GT(moved, num_faces / 4);

  Admm<DoubleTri> resumed(mesh, sample.cage, options);
  EXPECT_TRUE(resumed.resumed());
  resumed.iterate(15);
  EXPECT_LT(largest_difference(expected, mesh, resumed), 1e-12);
}

TEST(MeshAdmmOnTriangles, StateSurvivesFiles) {
  const auto sample = moved(make_sample<2>(Shape::kRing, 3, 0.2));
  auto mesh = openmesh::to_mesh<DoubleTri>(sample.mesh);
  GradientAdmmOptions options;
  options.persistent = true;
  Admm<DoubleTri> uninterrupted(mesh, sample.cage, options);
  uninterrupted.iterate(25);
  uninterrupted.recover_weights();
  const std::string path = scratch_path("admm_state.om");
  ASSERT_TRUE(OpenMesh::IO::write_mesh(mesh, path));
  DoubleTri loaded;
  ASSERT_TRUE(OpenMesh::IO::read_mesh(loaded, path));
  EXPECT_EQ(openmesh::get_weights(loaded).dense(), openmesh::get_weights(mesh).dense());
  Admm<DoubleTri> resumed(loaded, sample.cage);
  EXPECT_TRUE(resumed.resumed());
  uninterrupted.iterate(15);
  resumed.iterate(15);
  EXPECT_LT(largest_difference(gradients_of(mesh, uninterrupted), loaded, resumed), 1e-13);
}

TEST(MeshAdmmOnTriangles, AnotherNumberOfControlPointsReplacesTheState) {
  const auto sample = moved(make_sample<2>(Shape::kBox, 4));
  auto mesh = openmesh::to_mesh<DoubleTri>(sample.mesh);
  Admm<DoubleTri>(mesh, sample.cage).iterate(10);
  auto finer = sample.cage;
  const Index n = finer.size();
  finer.points.conservativeResize(2, n + 1);
  finer.points.col(n) =
      (finer.points.col(finer.facets(0, 0)) + finer.points.col(finer.facets(1, 0))) / 2;
  finer.facets.conservativeResize(2, finer.facets.cols() + 1);
  finer.facets.rightCols(1) << n, finer.facets(1, 0);
  finer.facets(1, 0) = n;
  Admm<DoubleTri> admm(mesh, finer);
  EXPECT_FALSE(admm.resumed());
  admm.iterate(10);
  EXPECT_EQ(admm.gradient(mesh.face_handle(0)).cols(), n + 1);
  auto fresh = openmesh::to_mesh<DoubleTri>(sample.mesh);
  Admm<DoubleTri> expected(fresh, finer);
  expected.iterate(10);
  EXPECT_EQ(largest_difference(gradients_of(fresh, expected), mesh, admm), 0);
}

TEST(MeshAdmmOnTriangles, RefusesImpossibleOptions) {
  const auto sample = make_sample<2>(Shape::kBox, 2);
  auto mesh = openmesh::to_mesh<DoubleTri>(sample.mesh);
  for (const auto& [penalty, relaxation] :
       std::vector<std::pair<double, double>>{{-1, 1}, {0, 0}, {0, 2}, {std::nan(""), 1}}) {
    GradientAdmmOptions options;
    options.penalty = penalty;
    options.relaxation = relaxation;
    EXPECT_THROW(Admm<DoubleTri>(mesh, sample.cage, options), OptionError);
  }
}

}  // namespace
}  // namespace flbc::testing

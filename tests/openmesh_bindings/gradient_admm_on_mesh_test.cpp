// SPDX-License-Identifier: BSD-3-Clause
// The iteration on a mesh against the textbook one, iterate by iterate, and its state in the
// properties of the mesh.
#include "flbc/openmesh/gradient_admm.h"

#include "flbc/openmesh/convert.h"
#include "flbc/solver.h"
#include "solver/methods/method_run.h"
#include "support/hollow_sample.h"
#include "support/published_problem.h"
#include "support/scratch.h"
#include "support/textbook_admm.h"
#include "support/wide_meshes.h"

namespace flbc::testing {
namespace {

using openmesh::GradientAdmmOptions;
using openmesh::TetMesh;
template <class Mesh, class Scalar = double>
using Admm = openmesh::GradientAdmm<Mesh, Scalar>;

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

// Lets some balls of the Z-step be active and some not.
template <int Dim>
constexpr double kPenalty = Dim == 2 ? 100 : 10000;

template <int Dim>
TextbookAdmm<Dim> textbook_for(const LbcProblem<Dim>& problem,
                               const CellFieldView<double, Dim>& gradients) {
  TextbookInput<Dim> input;
  input.control_points = problem.cage.points;
  input.mesh = problem.mesh;
  input.phi = problem.phi.dense();
  input.boundary_weights = demanded_boundary_weights(problem.cage, problem.mesh);
  input.penalty = kPenalty<Dim>;
  input.smoothness = problem.smoothness;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    input.initial_gradients.push_back(gradients.cell(s));
  }
  return TextbookAdmm<Dim>(std::move(input));
}

// The largest difference from gradients of cells, relative to the largest of these.
template <class Scalar, int Dim, class GradientOf>
double relative_difference(Index num_cells, const CellFieldView<Scalar, Dim>& gradients,
                           const GradientOf& gradient_of) {
  double largest = 0, difference = 0;
  for (Index s = 0; s < num_cells; ++s) {
    const PointList<Dim> expected = gradient_of(s);
    largest = std::max(largest, expected.cwiseAbs().maxCoeff());
    difference = std::max(difference, (gradients.cell(s) - expected).cwiseAbs().maxCoeff());
  }
  return difference / largest;
}

template <class Mesh, int Dim>
void expect_iterates_of_textbook(const LbcProblem<Dim>& problem, bool as_published) {
  auto mesh = openmesh::to_mesh<Mesh>(problem.mesh);
  GradientAdmmOptions options;
  options.penalty = kPenalty<Dim>;
  options.as_published = as_published;
  Admm<Mesh> admm(mesh, problem, options);
  auto textbook = textbook_for(problem, admm.gradients());
  const auto of_textbook = [&](Index s) { return textbook.gradient(s); };
  for (int iteration = 1; iteration <= 50; ++iteration) {
    textbook.iterate();
    const auto [primal, dual] = admm.iterate();
    ASSERT_LT(relative_difference(problem.mesh.num_cells(), admm.gradients(), of_textbook), 1e-10)
        << "iteration " << iteration;
    EXPECT_NEAR(primal, textbook.primal_residual_norm(),
                1e-6 * textbook.primal_residual_norm() + 1e-12);
    EXPECT_NEAR(dual, textbook.dual_residual_norm(),
                1e-6 * textbook.dual_residual_norm() + 1e-12 * kPenalty<Dim>);
  }
  EXPECT_EQ(admm.num_components(), static_cast<double>(textbook.num_residual_components()));
}

template <int Dim>
auto periods_of(const LbcProblem<Dim>& problem) {
  return openmesh::make_gradient_problem<double, Dim>(
             std::make_shared<const LbcProblem<Dim>>(problem), problem.topology)
      .periods;
}

TYPED_TEST(MeshAdmm, EqualsTheTextbookIterateByIterate) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  int compared = 0;
  for (const auto& sample : samples<kDim>()) {
    SCOPED_TRACE(sample.name);
    auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
    if (!periods_of(problem).empty()) continue;  // the textbook has none
    ++compared;
    for (const double smoothness : {0.0, 0.02}) {
      problem.smoothness = smoothness;
      expect_iterates_of_textbook<TypeParam>(problem, false);
      expect_iterates_of_textbook<TypeParam>(problem, true);
    }
  }
  EXPECT_GE(compared, 2);
}

TYPED_TEST(MeshAdmm, SinglePrecisionFollowsDouble) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  const auto sample = make_sample<kDim>(Shape::kRing, 2, 0.2);
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kSquare);
  auto mesh = openmesh::to_mesh<TypeParam>(problem.mesh);
  GradientAdmmOptions options;
  options.as_published = true;
  Admm<TypeParam, float> single(mesh, problem, options);
  Admm<TypeParam> exact(mesh, problem, options);
  single.iterate(100);
  exact.iterate(100);
  const auto expected = exact.gradients();
  EXPECT_LT(relative_difference(problem.mesh.num_cells(), single.gradients(),
                                [&](Index s) { return expected.cell(s); }),
            1e-4);
}

TYPED_TEST(MeshAdmm, PeriodsHoldForEveryFunctionWithTheRightBoundaryValues) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  const auto sample = make_hollow_sample<kDim>();
  const auto problem = published_problem(sample.cage, sample.mesh, DistanceScheme::kConstant);
  auto weights = demanded_boundary_weights(sample.cage, sample.mesh);
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.boundary.is_interior(v)) weights.col(v).setRandom();
  }
  const auto periods = periods_of(problem);
  ASSERT_EQ(periods.size(), 1U);
  EXPECT_NEAR(periods[0].field.norm(), 1, 1e-12);
  Eigen::VectorXd violation = -periods[0].values.transpose();
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    const Eigen::MatrixXd gradients = linear_gradients<kDim>(
        cell_corners(problem.mesh, s), columns_of(weights, problem.mesh.cells.col(s)));
    violation += gradients.transpose() * periods[0].field.col(s);
  }
  EXPECT_LT(violation.cwiseAbs().maxCoeff(), 1e-12);
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

// Residuals and gradients of an over-relaxed run in single precision.
TYPED_TEST(MeshAdmm, ThreadsDoNotChangeABit) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  const auto ring = moved(make_sample<kDim>(Shape::kRing, kDim == 2 ? 8 : 3, 0.2));
  ASSERT_GE(ring.mesh.num_cells(), kFewestInParallel);
  for (const auto& sample : {ring, moved(make_hollow_sample<kDim>())}) {
    expect_same_for_any_threads([&] {
      auto mesh = openmesh::to_mesh<TypeParam>(sample.mesh);
      GradientAdmmOptions options;
      options.relaxation = 1.8;
      Admm<TypeParam, float> admm(mesh, sample.cage, options);
      std::vector<double> numbers;
      for (int k = 0; k < 20; ++k) {
        const auto [primal, dual] = admm.iterate();
        numbers.insert(numbers.end(), {primal, dual});
      }
      for (const auto cell : openmesh::Elements<TypeParam>::cells(mesh)) {
        for (const float number : admm.gradient(cell).reshaped()) numbers.push_back(number);
      }
      return numbers;
    });
  }
}

// At the optimum gradients are those of weights with the right boundary values, which periods make
// so where the boundary has several components. A dual is phi A long where the gradient is not 0,
// and points against it.
TYPED_TEST(MeshAdmm, EndsAtGradientsOfWeightsWithTheirDuals) {
  constexpr int kDim = Admm<TypeParam>::kDim;
  const auto sample = moved(make_hollow_sample<kDim>());
  GradientAdmmOptions options;
  options.relaxation = 1.8;
  options.phi = DistanceScheme::kConstant;
  auto mesh = openmesh::to_mesh<TypeParam>(sample.mesh);
  Admm<TypeParam> admm(mesh, sample.cage, options);
  admm.iterate(3000);
  admm.recover_weights();
  EXPECT_EQ(openmesh::get_rest_cage(mesh), sample.cage.points);
  const auto weights = openmesh::get_weights(mesh).dense();
  const auto gradient_of_weights = [&](Index s) {
    return linear_gradients<kDim>(cell_corners(sample.mesh, s),
                                  columns_of(weights, sample.mesh.cells.col(s)));
  };
  EXPECT_LT(relative_difference(sample.mesh.num_cells(), admm.gradients(), gradient_of_weights),
            0.08);  // 0.004 in 2D, 0.04 in 3D; without periods 0.2
  const auto phi = make_problem(sample.cage, sample.mesh, options.phi, 0).phi.dense();
  for (const auto cell : openmesh::Elements<TypeParam>::cells(mesh)) {
    for (Index i = 0; i < sample.cage.size(); ++i) {
      const Vector<kDim> dual = admm.cell_dual(cell).col(i);
      const Vector<kDim> gradient = admm.gradient(cell).col(i);
      const double radius = phi(i, cell.idx()) * signed_measure(sample.mesh, cell.idx());
      EXPECT_LE(dual.norm(), radius * (1 + 1e-3));
      if (gradient.norm() < 0.05) continue;
      EXPECT_NEAR(dual.dot(gradient), -radius * gradient.norm(), 0.05 * radius * gradient.norm());
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
  request_status(mesh);
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

// As in a program that does not link flbc::openmesh.
TEST_IN_2D_AND_3D(GradientMethods, AreRefusedWithoutTheComponent) {
  const auto sample = make_sample<Dim>(Shape::kBox, 2);
  for (const auto method : {Method::kGradient, Method::kPaper}) {
    SolverOptions options{method};
    options.max_iterations = 1;
    const auto make = std::exchange(gradient_iteration<Dim>(), nullptr);
    expect_error<OptionError>([&] { solve(sample.cage, sample.mesh, options); },
                              {"flbc::openmesh"});
    gradient_iteration<Dim>() = make;
    EXPECT_EQ(solve(sample.cage, sample.mesh, options).report.iterations, 1);
  }
}

}  // namespace
}  // namespace flbc::testing

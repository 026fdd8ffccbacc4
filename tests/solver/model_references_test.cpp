// SPDX-License-Identifier: BSD-3-Clause
// Methods against the optima of models of real size that were found by other means
// (tests/data/references/README.md, "Models").
#include <fstream>
#include <limits>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "flbc/meshing.h"
#include "flbc/published_penalty.h"
#include "flbc/solver.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

// One of the two problems, without and with w >= 0.
struct Optimum {
  double objective = 0, gap = 0;
  std::vector<Eigen::VectorXd> weights;  // n, per sample
};

template <int Dim>
struct Reference {
  Index control_points, vertices, cells;
  std::vector<Index> samples;  // vertices
  std::vector<Vector<Dim>> positions;
  std::map<std::string, Optimum> optima;
};

double mean_squared_difference(const std::vector<Eigen::VectorXd>& a,
                               const std::vector<Eigen::VectorXd>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]).squaredNorm();
  return sum / static_cast<double>(a.size() * static_cast<std::size_t>(a[0].size()));
}

template <int Dim>
Optimum read_optimum(std::ifstream& file, const Reference<Dim>& reference) {
  Optimum optimum;
  std::string key;
  file >> optimum.objective >> key >> optimum.gap;
  for (const Index sample : reference.samples) {
    int entries = 0;
    Index vertex = 0, control_point = 0;
    file >> vertex >> entries;
    if (vertex != sample) throw std::runtime_error("samples in another order");
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(reference.control_points);
    for (int k = 0; k < entries; ++k) {
      file >> control_point;
      file >> weights[control_point];
    }
    optimum.weights.push_back(weights);
  }
  if (!file) throw std::runtime_error("an optimum breaks off");
  return optimum;
}

template <int Dim>
Reference<Dim> read_reference(const std::string& name) {
  std::ifstream file(std::string(FLBC_TEST_DATA_DIR) + "/references/models/" + name + ".txt");
  file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  std::string key, model;
  int dimension = 0, count = 0;
  Reference<Dim> reference;
  file >> key >> model >> key >> dimension >> key >> reference.control_points >> key >>
      reference.vertices >> key >> reference.cells >> key >> count;
  reference.samples.resize(count);
  reference.positions.resize(count);
  for (int k = 0; k < count; ++k) {
    file >> reference.samples[k];
    for (int axis = 0; axis < Dim; ++axis) file >> reference.positions[k][axis];
  }
  if (!file || dimension != Dim || model != name) throw std::runtime_error(name + " is damaged");
  while (file >> key) {
    const auto variant = key.substr(0, key.rfind('_'));  // key: VARIANT_objective
    reference.optima[variant] = read_optimum(file, reference);
  }
  return reference;
}

// The phi of the references, of Euclidean distances.
template <int Dim>
Eigen::MatrixXd euclidean_phi(const PointList<Dim>& control_points, const DomainMesh<Dim>& mesh) {
  Eigen::MatrixXd distances(control_points.cols(), mesh.num_vertices());
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    distances.col(v) = (control_points.colwise() - mesh.points.col(v)).colwise().norm();
  }
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(distances.rows(), mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int k = 0; k <= Dim; ++k) phi.col(s) += distances.col(mesh.cells(k, s)) / (Dim + 1);
  }
  return (phi / distances.maxCoeff()).array().square();
}

DomainMesh<2> mesh_of(const Cage<2>& cage, Index vertices) {
  MeshingOptions<2> meshing;
  meshing.vertices = vertices;
  return triangulate(cage, meshing);
}
DomainMesh<3> mesh_of(const Cage<3>& cage, Index vertices) {
  MeshingOptions<3> meshing;
  meshing.vertices = vertices;
  return tetrahedralize(cage, meshing);
}

struct Expected {
  const char* what;
  Method method;
  double penalty;  // as published, 0 = by method
  NonNegative non_negative;
  int iterations;
  double objective;  // above the optimum's at most so much, relative
  double squared;    // mean squared difference of the samples
};

// Without the constraint weights are compared with the optimum without it, else with the other one.
template <int Dim>
void expect_optimum(const LbcProblem<Dim>& problem, const Reference<Dim>& reference,
                    const Expected& expected) {
  const bool off = expected.non_negative == NonNegative::kOff;
  const auto& without = reference.optima.at("unconstrained");
  const auto with = reference.optima.find("non_negative");
  const auto& optimum = off || with == reference.optima.end() ? without : with->second;
  SCOPED_TRACE(std::string(expected.what) + (off ? ", without w >= 0" : ", with w >= 0"));
  SolverOptions options;
  options.method = expected.method;
  options.penalty =
      published_penalty(problem.cage, problem.mesh, expected.method, expected.penalty);
  options.non_negative = expected.non_negative;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-30;  // never: run to the end
  options.max_iterations = expected.iterations;
  options.certify = true;
  const auto [weights, report] = solve(problem, options);
  EXPECT_LT(report.objective, optimum.objective * (1 + expected.objective));
  EXPECT_GT(report.objective, optimum.objective * (1 - optimum.gap));
  // The bound is one of non-negative weights.
  const auto& bounded = with == reference.optima.end() ? without : with->second;
  EXPECT_LT(report.certificate.lower_bound, bounded.objective);
  std::vector<Eigen::VectorXd> samples;
  for (const Index v : reference.samples) samples.emplace_back(weights.col(v));
  EXPECT_LT(mean_squared_difference(samples, optimum.weights), expected.squared);
}

template <int Dim>
void expect_optima(const std::string& name, const std::string& file, Index vertices,
                   const std::vector<Expected>& all) {
  if (!has_model(file)) GTEST_SKIP() << "there is no " << model_path(file);
  const auto reference = read_reference<Dim>(name);
  const auto cage = load_cage<Dim>(file);
  const auto mesh = mesh_of(cage, vertices);
  ASSERT_EQ(mesh.num_vertices(), reference.vertices) << "another mesh than the reference's";
  ASSERT_EQ(mesh.num_cells(), reference.cells) << "another mesh than the reference's";
  for (std::size_t k = 0; k < reference.samples.size(); ++k) {
    ASSERT_LT((mesh.points.col(reference.samples[k]) - reference.positions[k]).norm(), 1e-6)
        << "another mesh than the reference's";
  }
  auto problem = make_problem(cage, mesh, DistanceScheme::kConstant);
  problem.phi = euclidean_phi(cage.points, mesh);
  for (const auto& expected : all) expect_optimum(problem, reference, expected);
}

constexpr auto kOff = NonNegative::kOff;
constexpr auto kConstraint = NonNegative::kConstraint;
constexpr auto kProject = NonNegative::kProject;

TEST(ModelReferences, EveryMethodFindsTheOptimumOfWoody) {
  expect_optima<2>("woody", "2d/woody-control-edgeset.obj", 2000,
                   {{"value", Method::kValue, 0, kOff, 1500, 2e-5, 1e-10},
                    {"value", Method::kValue, 0, kConstraint, 1500, 2e-5, 1e-10},
                    {"lbc2014 tuned", Method::kLbc2014, 0, kOff, 1500, 2e-5, 1e-10},
                    {"lbc2014 tuned", Method::kLbc2014, 0, kConstraint, 1500, 2e-5, 1e-10},
                    {"lbc2014", Method::kLbc2014, 10, kOff, 6000, 1e-5, 1e-9},
                    {"lbc2014", Method::kLbc2014, 10, kConstraint, 6000, 1e-5, 1e-9},
                    {"gradient", Method::kGradient, 0, kOff, 6000, 3e-4, 1e-9},
                    {"gradient", Method::kGradient, 0, kProject, 6000, 3e-4, 1e-9},
                    {"paper", Method::kPaper, 0, kOff, 6000, 0.1, 2e-5},
                    {"paper", Method::kPaper, 0, kProject, 6000, 0.1, 2e-5}});
}

TEST(ModelReferences, EveryMethodFindsTheOptimaOfClothing) {
  expect_optima<3>("clothing", "3d/clothing_cage.obj", 1000,
                   {{"value", Method::kValue, 0, kOff, 3000, 2e-6, 5e-11},
                    {"value", Method::kValue, 0, kConstraint, 3000, 2e-6, 5e-11},
                    {"lbc2014 tuned", Method::kLbc2014, 0, kOff, 3000, 2e-5, 1e-8},
                    {"lbc2014 tuned", Method::kLbc2014, 0, kConstraint, 3000, 2e-5, 1e-8},
                    {"lbc2014", Method::kLbc2014, 10, kOff, 6000, 5e-3, 4e-4},
                    {"lbc2014", Method::kLbc2014, 10, kConstraint, 6000, 5e-3, 4e-4},
                    {"gradient", Method::kGradient, 0, kOff, 6000, 3e-3, 8e-7},
                    {"gradient", Method::kGradient, 0, kProject, 6000, 2e-3, 1e-6},
                    {"paper", Method::kPaper, 0, kOff, 6000, 1e-3, 3e-7},
                    {"paper", Method::kPaper, 0, kProject, 6000, 1e-3, 6e-7}});
}

// The constraint is active, so that a method that forgets it misses the optimum by far.
TEST(ModelReferences, TheOptimaOfClothingDiffer) {
  const auto reference = read_reference<3>("clothing");
  const auto& without = reference.optima.at("unconstrained");
  const auto& with = reference.optima.at("non_negative");
  EXPECT_GT(mean_squared_difference(without.weights, with.weights), 1e-7);
  double least = 0;
  for (const auto& row : without.weights) least = std::min(least, row.minCoeff());
  EXPECT_LT(least, -1e-2);
  EXPECT_GT(with.objective * (1 - with.gap), without.objective * (1 + 1e-6));
}

}  // namespace
}  // namespace flbc::testing

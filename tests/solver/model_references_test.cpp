// SPDX-License-Identifier: BSD-3-Clause
// Methods against the optimum of a model of real size that was found by other means
// (tests/data/references/README.md, "Models").
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include "flbc/meshing.h"
#include "flbc/solver.h"
#include "support/model_cages.h"

namespace flbc::testing {
namespace {

struct Sample {
  Index vertex;
  Eigen::Vector2d position;
  Eigen::VectorXd weights;  // n
};

struct ModelOptimum {
  Index control_points, vertices, cells;
  double objective, gap;
  std::vector<Sample> samples;
};

ModelOptimum read_optimum(const std::string& name) {
  std::ifstream file(std::string(FLBC_TEST_DATA_DIR) + "/references/models/" + name + ".txt");
  file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  std::string key, model;
  int dimension = 0, count = 0;
  ModelOptimum optimum;
  file >> key >> model >> key >> dimension >> key >> optimum.control_points >> key >>
      optimum.vertices >> key >> optimum.cells >> key >> count;
  optimum.samples.resize(count);
  for (auto& sample : optimum.samples) {
    file >> sample.vertex >> sample.position[0] >> sample.position[1];
  }
  file >> key >> optimum.objective >> key >> optimum.gap;
  for (auto& sample : optimum.samples) {
    int entries = 0;
    Index vertex = 0, control_point = 0;
    file >> vertex >> entries;
    sample.weights = Eigen::VectorXd::Zero(optimum.control_points);
    for (int k = 0; k < entries; ++k) {
      file >> control_point;
      file >> sample.weights[control_point];
    }
    if (vertex != sample.vertex) throw std::runtime_error(name + ": samples in another order");
  }
  if (!file || dimension != 2 || model != name) throw std::runtime_error(name + " is damaged");
  return optimum;
}

// The phi of the references, of Euclidean distances.
Eigen::MatrixXd euclidean_phi(const PointList<2>& control_points, const DomainMesh<2>& mesh) {
  Eigen::MatrixXd distances(control_points.cols(), mesh.num_vertices());
  for (Index v = 0; v < mesh.num_vertices(); ++v) {
    distances.col(v) = (control_points.colwise() - mesh.points.col(v)).colwise().norm();
  }
  Eigen::MatrixXd phi = Eigen::MatrixXd::Zero(distances.rows(), mesh.num_cells());
  for (Index s = 0; s < mesh.num_cells(); ++s) {
    for (int k = 0; k < 3; ++k) phi.col(s) += distances.col(mesh.cells(k, s)) / 3;
  }
  return (phi / distances.maxCoeff()).array().square();
}

struct Expected {
  Method method;
  NonNegative non_negative;
  int iterations;
  double objective;  // above the optimum's at most so much, relative
  double squared;    // mean squared difference of the samples
};

TEST(ModelReferences, EveryMethodFindsTheOptimumOfWoody) {
  const std::string file = "2d/woody-control-edgeset.obj";
  if (!has_model(file)) GTEST_SKIP() << "there is no " << model_path(file);
  const auto optimum = read_optimum("woody");
  const auto cage = load_cage<2>(file);
  MeshingOptions<2> meshing;
  meshing.vertices = 2000;
  const auto mesh = triangulate(cage, meshing);
  ASSERT_EQ(mesh.num_vertices(), optimum.vertices) << "another mesh than the reference's";
  ASSERT_EQ(mesh.num_cells(), optimum.cells) << "another mesh than the reference's";
  for (const auto& sample : optimum.samples) {
    ASSERT_LT((mesh.points.col(sample.vertex) - sample.position).norm(), 1e-6)
        << "another mesh than the reference's";
  }
  auto problem = make_problem(cage, mesh, DistanceScheme::kConstant);
  problem.phi = euclidean_phi(cage.points, mesh);
  for (const Expected& expected :
       {Expected{Method::kValue, NonNegative::kOff, 1500, 2e-5, 1e-10},
        Expected{Method::kValue, NonNegative::kConstraint, 1500, 2e-5, 1e-10},
        Expected{Method::kLbc2014, NonNegative::kOff, 1500, 2e-5, 1e-10},
        Expected{Method::kLbc2014, NonNegative::kConstraint, 1500, 2e-5, 1e-10},
        Expected{Method::kGradient, NonNegative::kOff, 6000, 3e-4, 1e-9},
        Expected{Method::kGradient, NonNegative::kProject, 6000, 3e-4, 1e-9},
        Expected{Method::kPaper, NonNegative::kOff, 6000, 0.1, 2e-5},
        Expected{Method::kPaper, NonNegative::kProject, 6000, 0.1, 2e-5}}) {
    SCOPED_TRACE("method " + std::to_string(static_cast<int>(expected.method)) + ", w >= 0 " +
                 std::to_string(static_cast<int>(expected.non_negative)));
    SolverOptions options;
    options.method = expected.method;
    options.non_negative = expected.non_negative;
    options.precision = Precision::kDouble;
    options.tolerance = 1e-30;  // never: run to the end
    options.max_iterations = expected.iterations;
    options.certify = true;
    const auto [weights, report] = solve(problem, options);
    EXPECT_LT(report.objective, optimum.objective * (1 + expected.objective));
    EXPECT_GT(report.objective, optimum.objective * (1 - optimum.gap));
    EXPECT_LT(report.certificate.lower_bound, optimum.objective);
    double squared = 0;
    for (const auto& sample : optimum.samples) {
      squared += (weights.col(sample.vertex) - sample.weights).squaredNorm();
    }
    const auto numbers = static_cast<double>(optimum.samples.size()) * optimum.control_points;
    EXPECT_LT(squared / numbers, expected.squared);
  }
}

}  // namespace
}  // namespace flbc::testing

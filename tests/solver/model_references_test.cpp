// SPDX-License-Identifier: BSD-3-Clause
// Methods against the optima of models of real size that were found by other means
// (tests/data/references/README.md, "Models").
#include "flbc/published_penalty.h"
#include "support/model_optimum.h"
#include "support/solver_models.h"
#include "support/solver_options.h"
#include "support/test.h"

namespace flbc::testing {
namespace {

template <int Dim>
ModelReference<Dim> read_reference(const std::string& name) {
  return read_model_reference<Dim>(FLBC_TEST_DATA_DIR, name);
}

struct Expected {
  const char* what;
  Method method;
  double penalty;  // as published, 0 = by method
  NonNegative non_negative;
  int iterations;
  double objective;  // maximum above that of the optimum, relative
  double squared;    // mean squared difference of the samples
};

// Without the constraint weights are compared with the optimum without it, else with the other one.
template <int Dim>
void expect_optimum(const LbcProblem<Dim>& problem, const ModelReference<Dim>& reference,
                    const Expected& expected) {
  const bool off = expected.non_negative == NonNegative::kOff;
  const auto& optimum = off ? reference.without() : reference.with();
  SCOPED_TRACE(std::string(expected.what) + (off ? ", without w >= 0" : ", with w >= 0"));
  auto options = many_iterations(expected.iterations, without_smoothness());
  options.method = expected.method;
  if (expected.penalty > 0) {
    options.penalty =
        published_penalty(problem.cage, problem.mesh, expected.method, expected.penalty);
  }
  options.non_negative = expected.non_negative;
  options.certify = true;
  const auto [weights, report] = solve(problem, options);
  EXPECT_LT(report.objective, optimum.objective * (1 + expected.objective));
  EXPECT_GT(report.objective, optimum.objective * (1 - optimum.gap));
  // The bound is one of non-negative weights.
  EXPECT_LT(report.certificate.lower_bound, reference.with().objective);
  EXPECT_LT(mean_squared_difference(reference.sampled(weights.dense()), optimum.weights),
            expected.squared);
}

template <int Dim>
void expect_optima(const std::string& name, const std::string& file, Index vertices,
                   const std::vector<Expected>& all) {
  if (!has_model(file)) GTEST_SKIP() << "the real models are absent";
  const auto reference = read_reference<Dim>(name);
  const auto cage = load_cage<Dim>(file);
  const auto mesh = mesh_of(cage, vertices);
#ifdef _WIN32
  if (!reference.belongs_to(mesh)) GTEST_SKIP() << "TetGen places vertices differently here";
#endif
  ASSERT_TRUE(reference.belongs_to(mesh)) << "another mesh than the reference's";
  auto problem = make_problem(cage, mesh, DistanceScheme::kConstant, 0);
  problem.phi = euclidean_phi(cage.points, mesh);
  for (const auto& expected : all) expect_optimum(problem, reference, expected);
}

constexpr auto kOff = NonNegative::kOff;
constexpr auto kConstraint = NonNegative::kConstraint;
constexpr auto kProject = NonNegative::kProject;

TEST(ModelReferences, EveryMethodFindsTheOptimumOfWoody) {
  expect_optima<2>("woody", "2d/woody-control-edgeset.obj", 2000,
                   {{"weights", Method::kWeights, 0, kOff, 1500, 2e-5, 1e-10},
                    {"weights", Method::kWeights, 0, kConstraint, 1500, 2e-5, 1e-10},
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
                   {{"weights", Method::kWeights, 0, kOff, 3000, 2e-6, 5e-11},
                    {"weights", Method::kWeights, 0, kConstraint, 3000, 2e-6, 5e-11},
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
  const auto& without = reference.without();
  const auto& with = reference.with();
  EXPECT_GT(mean_squared_difference(without.weights, with.weights), 1e-9);
  EXPECT_GT(with.objective * (1 - with.gap), without.objective * (1 + 1e-6));
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// Masks of the vertices of a mesh: exact zeros, the optimum of what is left, and refusals whose
// advice works.
#include <optional>
#include <random>

#include "flbc/masks.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

template <int Dim>
Sample<Dim> masked_box() {
  return with_fine_cage<Dim>(Shape::kBox, Dim == 2 ? 8 : 3, Dim == 2 ? 16 : 6);
}

// Control points far to one side must not move the vertices far to the other.
template <int Dim>
Mask across(const Sample<Dim>& sample, double from = 0.6, double to = 0.3) {
  const auto x = [&](double part) {
    const auto row = sample.cage.points.row(0);
    return row.minCoeff() + part * (row.maxCoeff() - row.minCoeff());
  };
  Mask mask;
  for (Index i = 0; i < sample.cage.size(); ++i) {
    if (sample.cage.points(0, i) > x(from)) mask.control_points.push_back(i);
  }
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    if (sample.mesh.points(0, v) < x(to)) mask.points.push_back(v);
  }
  return mask;
}

template <int Dim>
void expect_obeyed(const Sample<Dim>& sample, const Solution& solution, const Mask& mask) {
  const auto weights = solution.weights.dense();
  for (const Index v : mask.points) {
    for (const Index i : mask.control_points) ASSERT_EQ(weights(i, v), 0) << v << ' ' << i;
  }
  EXPECT_GE(weights.minCoeff(), 0);
  EXPECT_LT((weights.colwise().sum().array() - 1).abs().maxCoeff(), 1e-13);
  EXPECT_LT((sample.cage.points * weights - sample.mesh.points).cwiseAbs().maxCoeff(), 1e-13);
}

TEST_IN_2D_AND_3D(MasksTest, MaskedWeightsAreExactlyZero) {
  const auto sample = masked_box<Dim>();
  SolverOptions options;
  options.masks = {across(sample)};
  const auto free = solve(sample.cage, sample.mesh);
  double most = 0;
  for (const Index v : options.masks[0].points) {
    for (const Index i : options.masks[0].control_points) {
      most = std::max(most, free.weights.at(v)[i]);
    }
  }
  EXPECT_GT(most, 1e-3) << "the mask changes nothing";
  const auto solution = solve(sample.cage, sample.mesh, options);
  EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  EXPECT_LE(solution.report.iterations, 2.5 * free.report.iterations);
  expect_obeyed(sample, solution, options.masks[0]);
}

TEST_IN_2D_AND_3D(MasksTest, ACoarseStartObeysThem) {
  auto sample = with_fine_cage<Dim>(Shape::kBox, Dim == 2 ? 8 : 4, Dim == 2 ? 16 : 4);
  sample.mesh = refine(sample.mesh);
  SolverOptions options;
  options.masks = {across(sample)};
  const auto solution = solve(sample.cage, sample.mesh, options);
  ASSERT_EQ(solution.report.coarse_levels.size(), 1);
  expect_obeyed(sample, solution, options.masks[0]);
  auto other = sample;
  other.mesh = in_other_order(sample.mesh);
  const auto cold = solve(other.cage, other.mesh, options);
  EXPECT_LT(squared_difference(solution, cold), 2e-6);
}

TEST_IN_2D_AND_3D(MasksTest, ASolverForgetsItsMasks) {
  const auto sample = masked_box<Dim>();
  SolverOptions options;
  options.masks = {across(sample)};
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  solver.solve();
  solver.set_options({});
  EXPECT_LT(squared_difference(solver.solve(), solve(sample.cage, sample.mesh)), 2e-6);
}

TEST_IN_2D_AND_3D(MasksTest, AMaskEndsAtFacets) {
  const auto sample = masked_box<Dim>();
  Mask all{across(sample).control_points, {}};
  SolverOptions options;
  options.masks = {{all.control_points, {0, 1, 2, 3}}};
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    const auto x = sample.mesh.points.col(v);
    const bool on_cage = (x.array() == sample.cage.points.rowwise().maxCoeff().array()).any();
    if (on_cage) options.masks[0].points.push_back(v);
  }
  const auto weights = solve(sample.cage, sample.mesh, options).weights;
  EXPECT_LT((sample.cage.points * weights.dense() - sample.mesh.points).norm(), 1e-12);
}

// Weights of the boundary are known, so there is nothing to obey.
TEST_IN_2D_AND_3D(MasksTest, AMaskOfTheBoundaryChangesNothing) {
  const auto sample = masked_box<Dim>();
  const auto on_boundary =
      boundary_vertices(build_topology(sample.mesh), sample.mesh.num_vertices());
  Mask mask{{0}, {}};
  for (Index v = 0; v < sample.mesh.num_vertices(); ++v) {
    if (on_boundary[v]) mask.points.push_back(v);
  }
  for (const std::optional<double> smoothness : {std::optional<double>(), {0.0}}) {
    SolverOptions options;
    options.smoothness = smoothness;
    options.certify = true;
    const auto free = solve(sample.cage, sample.mesh, options);
    options.masks = {mask};
    const auto masked = solve(sample.cage, sample.mesh, options);
    EXPECT_EQ(masked.report.status, SolveStatus::kConverged);
    EXPECT_TRUE(masked.weights == free.weights);
    EXPECT_EQ(masked.report.certificate.lower_bound, free.report.certificate.lower_bound);
    Solver<Dim> solver(sample.cage, sample.mesh, options);
    EXPECT_TRUE(solver.solve().weights == free.weights);
  }
}

TEST_IN_2D_AND_3D(MasksTest, ConflictsAreNamedAndTheAdviceWorks) {
  const auto sample = masked_box<Dim>();
  std::mt19937 random(7);
  int refused = 0;
  for (int trial = 0; refused < 10 && trial < 100; ++trial) {
    SolverOptions options;
    options.max_iterations = 1;
    auto mask = across(sample, 0.2 * (trial % 3), 0.6);
    std::shuffle(mask.control_points.begin(), mask.control_points.end(), random);
    mask.control_points.resize(mask.control_points.size() * (1 + trial % 4) / 4);
    options.masks = {mask};
    try {
      solve(sample.cage, sample.mesh, options);
    } catch (const MaskConflict& error) {
      ++refused;
      expect_piece(error.what(), "the first is vertex ");
      ASSERT_FALSE(error.control_points.empty()) << error.what();
      auto& list = options.masks[0].control_points;
      for (const Index i : error.control_points) {
        expect_piece(error.what(), " " + std::to_string(i));
        list.erase(std::remove(list.begin(), list.end(), i), list.end());
      }
      EXPECT_NO_THROW(solve(sample.cage, sample.mesh, options)) << error.what();
    }
  }
  EXPECT_EQ(refused, 10);
}

TEST(MasksTest, ARegionThatNothingMayMoveIsRefused) {
  const auto sample = masked_box<2>();
  SolverOptions options;
  options.masks = {across(sample, -1)};
  expect_error<InputError>([&] { solve(sample.cage, sample.mesh, options); },
                           {"all are masked, although its weights must sum to 1"});
}

TEST(MasksTest, WrongMasksAreRefused) {
  const auto sample = masked_box<2>();
  SolverOptions options;
  options.masks = {{{0}, {sample.mesh.num_vertices()}}};
  expect_refused("mask 0 names vertex", [&] { solve(sample.cage, sample.mesh, options); });
  options.masks = {{{0}, {0}}, {{-1}, {0}}};
  expect_refused("mask 1 names control point -1",
                 [&] { solve(sample.cage, sample.mesh, options); });
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
#include <thread>

#include "flbc/coordinates.h"
#include "flbc/harmonic.h"
#include "flbc/options.h"
#include "flbc/report.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

TEST_IN_2D_AND_3D(SolverTest, CoordinatesHaveTheirProperties) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto expect_properties = [&](const Solution& solution) {
      const auto judged = expect_coordinates(sample.cage, sample.mesh, solution.weights.dense());
      EXPECT_EQ(judged.min_weight, solution.report.quality.min_weight);
    };
    expect_properties(compute_coordinates(sample.cage, sample.mesh, Coordinates::kHarmonic));
    for (const auto method : {Method::kGradient, Method::kPaper}) {
      SCOPED_TRACE(name_of(method));
      SolverOptions options{method};
      options.max_iterations = 100;  // the constraints hold from the first one on
      const auto solution = solve(sample.cage, sample.mesh, options);
      EXPECT_EQ(solution.report.method, method);
      expect_properties(solution);
    }
  }
}

// Errors of the iteration do not make every control point an influence of every vertex.
TEST_IN_2D_AND_3D(SolverTest, WeightsFarBelowTheToleranceAreZero) {
  const auto sample = make_sample<Dim>(Shape::kRing, Dim == 2 ? 16 : 6, 0.2);
  const double tolerance = 1e-4;
  SolverOptions options;
  options.tolerance = tolerance;
  const auto weights = solve(sample.cage, sample.mesh, options).weights.dense();
  expect_coordinates(sample.cage, sample.mesh, weights);
  options.tolerance = 1e-10;
  const auto exact = solve(sample.cage, sample.mesh, options).weights.dense();
  EXPECT_LT(mean_squared_difference(sample.mesh, weights, exact), tolerance);
  const auto tiny = (weights.array() > 0 && weights.array() < 1e-2 * std::sqrt(tolerance)).count();
  EXPECT_LT(tiny, weights.size() / 50);
}

// Meshes that no reader has checked are checked wherever they come in: their numbers, and how cells
// meet (DomainMeshTest.NamesDefects).
TEST_IN_2D_AND_3D(SolverTest, RefusesMeshesThatAreNotValid) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  const auto refused = [&](const std::string& words, const auto& change) {
    SCOPED_TRACE(words);
    auto mesh = sample.mesh;
    change(mesh);
    expect_refused(words, [&] { solve(sample.cage, mesh); });
    expect_refused(words, [&] { make_problem(sample.cage, mesh, DistanceScheme::kSquare, 0); });
    expect_refused(words, [&] { compute_coordinates(sample.cage, mesh, Coordinates::kHarmonic); });
  };
  refused("cell 1 of the domain mesh refers to vertex -1", [](auto& m) { m.cells(0, 1) = -1; });
  refused("cell 3 of the domain mesh is inverted",
          [](auto& m) { std::swap(m.cells(0, 3), m.cells(1, 3)); });
  refused("share one facet", [](auto& m) {  // a cell that is there twice lies on itself
    m.cells.conservativeResize(Dim + 1, m.cells.cols() + 1);
    m.cells.col(m.cells.cols() - 1) = m.cells.col(0);
  });
}

TEST_IN_2D_AND_3D(SolverTest, RefusesPhiThatIsNotValid) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 3, 0.2);
  const auto problem = smooth_problem(sample);
  const Eigen::MatrixXd phi = problem.phi.dense();
  const auto refused = [&](const std::string& words, const Eigen::MatrixXd& values) {
    auto other = problem;
    other.phi = values;
    expect_refused<InputError>(words, [&] { solve(other); });
  };
  refused("phi is " + std::to_string(phi.rows() - 1), phi.topRows(phi.rows() - 1));
  refused("phi is ", phi.leftCols(phi.cols() - 1));
  for (const double value : {-1e-3, std::numeric_limits<double>::infinity(), std::nan("")}) {
    auto values = phi;
    values(1, 2) = value;
    refused("phi of control point 1 on cell 2 is ", values);
  }
  auto same = problem;
  same.phi = phi;
  EXPECT_EQ(solve(same).weights.dense().cols(), sample.mesh.num_vertices());
}

// Without the projection to weights >= 0, single precision must not remain.
TEST_IN_2D_AND_3D(SolverTest, WeightsThatMayBeNegativeReproduceExactly) {
  const auto sample = with_fine_cage<Dim>(Shape::kCorner, 2, Dim == 2 ? 8 : 4);
  for (const auto method : {Method::kWeights, Method::kLbc2014}) {
    for (const auto active_set : {ActiveSet::kOff, ActiveSet::kOn}) {
      SCOPED_TRACE(name_of(method));
      SolverOptions options{method};
      options.non_negative = NonNegative::kOff;
      options.active_set = active_set;
      if (method == Method::kLbc2014 && active_set == ActiveSet::kOn) continue;
      const auto solution = solve(sample.cage, sample.mesh, options);
      EXPECT_LT(solution.report.quality.max_partition_error, 1e-13);
      EXPECT_LT(solution.report.quality.max_reproduction_error, 1e-13);
      if (active_set == ActiveSet::kOn) {
        EXPECT_LT(solution.weights.values().size(),
                  0.8 * sample.cage.size() * sample.mesh.num_vertices());
      }
    }
  }
}

// Gradients with local constraints only, and weights with a global linear system: two iterations
// with nothing in common but the problem, of which the optimum may not differ. Its value is a lower
// bound for every feasible function.
TEST_IN_2D_AND_3D(SolverTest, GradientsAndWeightsAgree) {
  for (const auto& sample : samples<Dim>()) {
    SCOPED_TRACE(sample.name);
    const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
    const auto optimum = [&](Method method, std::optional<double> penalty) {
      auto options = many_iterations(4000, without_smoothness());
      options.method = method;
      options.non_negative = NonNegative::kOff;
      if (penalty) {
        options.penalty = published_penalty(sample.cage, sample.mesh, method, *penalty);
      }
      return solve(problem, options).weights.dense();
    };
    const auto weights = optimum(Method::kWeights, {});
    const auto gradients = optimum(Method::kPaper, Dim == 2 ? 1e4 : 1e5);
    const double value = testing::objective(problem.mesh, weights, problem.phi.dense());
    EXPECT_NEAR(testing::objective(problem.mesh, gradients, problem.phi.dense()), value,
                5e-3 * value);
    // Symmetric boxes leave the optimum some freedom, so this is no sharper.
    EXPECT_LT(mean_squared_difference(problem.mesh, weights, gradients), 1e-4);
    EXPECT_LE(value,
              testing::objective(problem.mesh, harmonic_coordinates(problem), problem.phi.dense()) *
                  (1 + 1e-9));
  }
}

TEST_IN_2D_AND_3D(SolverTest, ReportsHowItEnded) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  const auto limited = solve(sample.cage, sample.mesh, many_iterations(7)).report;
  EXPECT_EQ(limited.status, SolveStatus::kIterationLimit);
  EXPECT_EQ(limited.iterations, 7);

  int calls = 0;
  Observer observer;
  observer.progress = [&](const Progress& progress) {
    EXPECT_EQ(progress.iteration, 10 * ++calls);
    EXPECT_GT(progress.relative_primal_residual, 0);
    EXPECT_GT(progress.objective(), 0);
    return calls < 3;
  };
  const auto stopped = solve(sample.cage, sample.mesh, many_iterations(1000), observer);
  EXPECT_EQ(stopped.report.status, SolveStatus::kStopped);
  EXPECT_EQ(stopped.report.iterations, 30);
  EXPECT_LT(stopped.report.quality.max_reproduction_error, 1e-13);
}

// In every iteration and during stages; each call may cancel.
TEST_IN_2D_AND_3D(SolverTest, PollMayCancel) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  auto options = many_iterations(25);
  options.certify = true;
  options.threads = 1;
  int calls = 0, last = -1;
  Observer observer;
  observer.poll = [&] {
    if (++calls == last) throw std::out_of_range("cancelled");
  };
  const auto weights = solve(sample.cage, sample.mesh, options, observer).weights.dense();
  const int all = calls;
  EXPECT_GT(all, 25);
  EXPECT_EQ(weights, solve(sample.cage, sample.mesh, options).weights.dense());
  for (last = 1; last <= all; last += 1 + all / 40) {
    calls = 0;
    EXPECT_THROW(solve(sample.cage, sample.mesh, options, observer), std::out_of_range);
    EXPECT_EQ(calls, last);
  }

  Solver<Dim> solver(sample.cage, sample.mesh, options);
  observer.poll = [] { throw std::out_of_range("cancelled"); };
  EXPECT_THROW(solve(sample.cage, sample.mesh, options, observer), std::out_of_range);
  EXPECT_THROW(solver.solve({}, observer), std::out_of_range);
  EXPECT_EQ(solver.solve().weights.dense(), weights);
}

TEST_IN_2D_AND_3D(SolverTest, StagesTellHowFarTheyAre) {
  const auto sample = make_sample<Dim>(Shape::kBox, 6, 0.2);
  SolverOptions options;
  options.certify = true;
  const auto without = solve(sample.cage, sample.mesh, options).weights.dense();
  for (const int threads : {1, 2}) {
    options.threads = threads;
    std::map<Stage, std::vector<double>> reported;
    const auto caller = std::this_thread::get_id();
    Observer observer;
    observer.stage = [&](Stage stage, double done) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      reported[stage].push_back(done);
    };
    EXPECT_EQ(solve(sample.cage, sample.mesh, options, observer).weights.dense(), without);
    for (const auto stage : {Stage::kDistances, Stage::kNonNegative, Stage::kCertificate}) {
      const auto& parts = reported[stage];
      ASSERT_FALSE(parts.empty());
      EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
      EXPECT_GT(parts.front(), 0);
      EXPECT_EQ(parts.back(), 1);
    }
  }
}

// Numbers out of the range of single or double precision must not pass for a result.
TEST_IN_2D_AND_3D(SolverTest, NeverDeliversNumbersThatAreNotFinite) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  for (const double penalty : {1e-320, 1e-300, 1e-40, 1e-30, 1e30, 1e40, 1e280}) {
    for (const auto precision : {Precision::kSingle, Precision::kDouble}) {
      for (const auto method : {Method::kGradient, Method::kPaper}) {
        SolverOptions options{method};
        options.precision = precision;
        options.penalty = penalty;
        options.max_iterations = 40;
        try {
          const auto solution = solve(sample.cage, sample.mesh, options);
          EXPECT_TRUE(solution.weights.dense().allFinite()) << penalty;
          EXPECT_LT(solution.report.quality.max_reproduction_error, 1e-9) << penalty;
        } catch (const SolverError& error) {
          EXPECT_NE(std::string(error.what()).find("penalty"), std::string::npos) << error.what();
          EXPECT_TRUE(penalty < 1e-25 || penalty > 1e25) << penalty;
        }
      }
    }
  }
  SolverOptions options;
  options.penalty = 1e-320;
  EXPECT_THROW(solve(sample.cage, sample.mesh, options), SolverError);
}

TEST_IN_2D_AND_3D(SolverTest, MessagesGiveTheUsersCoordinates) {
  auto sample = make_sample<Dim>(Shape::kBox, 2);
  Index corner = 0;
  sample.mesh.points.colwise().sum().maxCoeff(&corner);
  sample.mesh.points.col(corner).setConstant(1.25);
  expect_error<InputError>([&] { solve(sample.cage, sample.mesh); }, {"(1.25, 1.25"});
}

TEST_IN_2D_AND_3D(SolverTest, RefusesImpossibleOptionsByName) {
  const auto sample = make_sample<Dim>(Shape::kBox, 1);
  using Change = void (*)(SolverOptions&);
  const std::pair<const char*, Change> refused[] = {
      {"tolerance", [](auto& o) { o.tolerance = -1e-8; }},
      {"tolerance", [](auto& o) { o.tolerance = std::nan(""); }},
      {"max_iterations", [](auto& o) { o.max_iterations = 0; }},
      {"penalty", [](auto& o) { o.penalty = -1; }},
      {"threads", [](auto& o) { o.threads = -1; }},
      {"gap", [](auto& o) { o.gap = -1; }},
      {"gap", [](auto& o) { o.gap = std::nan(""); }},
      {"gap", [](auto& o) { o.gap = 1e-3, o.non_negative = NonNegative::kOff; }},
      {"gap", [](auto& o) { o.gap = 1e-3, o.method = Method::kPaper; }},
      {"active_set", [](auto& o) { o.active_set = ActiveSet::kOn, o.gap = 1e-3; }},
      {"active_set", [](auto& o) { o.active_set = ActiveSet::kOn, o.certify = true; }},
      {"smoothness", [](auto& o) { o.smoothness = -0.1; }},
      {"smoothness", [](auto& o) { o.smoothness = std::nan(""); }},
      {"smoothness", [](auto& o) { o.smoothness = HUGE_VAL; }},
      {"smoothness", [](auto& o) { o.smoothness = 0.01, o.method = Method::kPaper; }},
      {"smoothness", [](auto& o) { o.smoothness = 0.01, o.method = Method::kLbc2014; }},
      {"masks", [](auto& o) { o.masks.resize(1), o.method = Method::kGradient; }},
      {"masks", [](auto& o) { o.masks.resize(1), o.active_set = ActiveSet::kOff; }}};
  for (const auto& [field, change] : refused) {
    SolverOptions options;
    change(options);
    try {
      solve(sample.cage, sample.mesh, options);
      ADD_FAILURE() << field << " was accepted";
    } catch (const OptionError& error) {
      EXPECT_EQ(std::string(error.what()).find(field), 0U) << error.what();
    }
  }
  // A problem knows its smoothness, which options cannot change.
  SolverOptions options;
  options.smoothness = 0.01;
  const auto problem = make_problem(sample.cage, sample.mesh, DistanceScheme::kSquare, 0);
  EXPECT_THROW(solve(problem, options), OptionError);
}

}  // namespace
}  // namespace flbc::testing

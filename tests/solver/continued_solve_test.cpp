// SPDX-License-Identifier: BSD-3-Clause
// A solver that resumes: a solve in slices equals one in a piece, and a solver whose options change
// equals a new one.
#include "flbc/options.h"
#include "flbc/report.h"
#include "solver/methods/method_run.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

// A solve that visits one of the ways through the solver.
template <int Dim>
struct SolveCase {
  std::string name;
  SolverOptions options{};
  bool nested = false;  // whether the mesh is refined
};

template <int Dim>
Sample<Dim> sample_of_cases() {
  auto sample = with_fine_cage<Dim>(Shape::kCorner, 2, Dim == 2 ? 6 : 2);
  sample.mesh = refine(sample.mesh);
  return sample;
}

template <int Dim>
std::vector<SolveCase<Dim>> cases() {
  std::vector<SolveCase<Dim>> all;
  const auto add = [&](const char* name, auto change) -> SolveCase<Dim>& {
    all.push_back({name});
    all.back().options.max_iterations = 105;
    change(all.back().options);
    return all.back();
  };
  const auto active = [](SolverOptions& o) { o.active_set = ActiveSet::kOn; };
  add("weights", [](auto&) {});
  add("ends by the gap", [](auto& o) { o.smoothness = 0, o.gap = 0.05; });
  add("active set", active);
  add("active set to the limit",
      [](auto& o) { o.active_set = ActiveSet::kOn, o.tolerance = 1e-20; });
  add("start from a coarse mesh", [](auto&) {}).nested = true;
  add("start from a coarse mesh on the active set", active).nested = true;
  for (const auto method : {Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    add(name_of(method), [&](auto& o) { o.method = method; });
    // The penalties of the literature suit the tolerance, and other parts of the method.
    add((std::string(name_of(method)) + ", loose").c_str(), [&](auto& o) {
      o.method = method;
      o.tolerance = 1e-3;
      const auto sample = sample_of_cases<Dim>();
      o.penalty = published_penalty(sample.cage, sample.mesh, method, 100);
    });
  }
  return all;
}

void expect_same(const Solution& solution, const Solution& expected) {
  const auto& [report, wanted] = std::tie(solution.report, expected.report);
  EXPECT_TRUE(solution.weights == expected.weights);  // bit for bit
  EXPECT_EQ(report.status, wanted.status);
  EXPECT_EQ(report.criterion, wanted.criterion);
  EXPECT_EQ(report.penalty, wanted.penalty);
  EXPECT_EQ(report.objective, wanted.objective);
  EXPECT_EQ(report.relative_primal_residual, wanted.relative_primal_residual);
  EXPECT_EQ(report.relative_dual_residual, wanted.relative_dual_residual);
  EXPECT_EQ(report.certificate.lower_bound, wanted.certificate.lower_bound);
  EXPECT_EQ(report.active_set.density, wanted.active_set.density);
  EXPECT_EQ(report.active_set.growths, wanted.active_set.growths);
  EXPECT_EQ(report.distances.source, wanted.distances.source);
  EXPECT_EQ(report.distances.phi_error, wanted.distances.phi_error);
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, ASolveInSlicesIsOneInOnePiece) {
  const auto nested = sample_of_cases<Dim>();
  std::set<Criterion> criteria;
  for (const auto& c : cases<Dim>()) {
    SCOPED_TRACE(c.name);
    auto sample = nested;
    if (!c.nested) sample.mesh = in_other_order(sample.mesh);
    const auto whole = solve(sample.cage, sample.mesh, c.options);
    criteria.insert(whole.report.criterion);
    EXPECT_EQ(whole.report.coarse_levels.empty(), !c.nested);
    EXPECT_EQ(whole.report.active_set.density < 1, c.options.active_set == ActiveSet::kOn);
    for (const int slice : {1, 3, 10, 1000}) {
      SCOPED_TRACE(slice);
      Solver<Dim> solver(sample.cage, sample.mesh, c.options);
      EXPECT_EQ(solver.solution().weights.num_points(), 0);
      for (int rounds = 0; rounds < 2; ++rounds) {  // again after restart()
        int made = 0;
        while (made < whole.report.iterations) {
          const auto& report =
              solver.solve({std::min(slice, whole.report.iterations - made)}).report;
          ASSERT_GT(report.iterations, 0);
          ASSERT_LE(report.iterations, slice);
          made += report.iterations;
          if (report.status != SolveStatus::kIterationLimit) break;
        }
        EXPECT_EQ(made, whole.report.iterations);
        expect_same(solver.solution(), whole);
        if (slice < 1000) break;
        solver.restart();
      }
    }
  }
  EXPECT_EQ(criteria.size(), 3u) << "the cases do not end in all ways";
}

// ---- options that change ------------------------------------------------------------------------

struct Change {
  const char* name;
  void (*change)(SolverOptions&);
  bool resumes = false;  // whether a run that has begun resumes
};

const Change kChanges[] = {{"nothing", [](auto&) {}, true},
                           {"tolerance", [](auto& o) { o.tolerance = 1e-7; }, true},
                           {"gap", [](auto& o) { o.gap = 1e-2; }, true},
                           {"max_iterations", [](auto& o) { o.max_iterations = 40; }, true},
                           {"certify", [](auto& o) { o.certify = true; }, true},
                           {"threads", [](auto& o) { o.threads = 2; }, true},
                           {"method", [](auto& o) { o.method = Method::kGradient; }},
                           {"phi", [](auto& o) { o.phi = DistanceScheme::kLinear; }},
                           {"smoothness", [](auto& o) { o.smoothness = 0.01; }},
                           {"distances", [](auto& o) { o.distances = Distances::kInterpolated; }},
                           {"precision", [](auto& o) { o.precision = Precision::kDouble; }},
                           {"non_negative", [](auto& o) { o.non_negative = NonNegative::kOff; }},
                           {"active_set", [](auto& o) { o.active_set = ActiveSet::kOn; }},
                           {"penalty", [](auto& o) { o.penalty = 0.02; }}};

TEST_IN_2D_AND_3D(ContinuedSolveTest, ChangedOptionsAreThoseOfANewSolver) {
  const auto sample = sample_of_cases<Dim>();
  SolverOptions options;
  options.distances = Distances::kExact;
  options.tolerance = 1e-5;
  options.max_iterations = 300;
  options.active_set = ActiveSet::kOff;  // a run on the active set begins again for a proof
  for (const auto& [name, change, resumes] : kChanges) {
    SCOPED_TRACE(name);
    auto changed = options;
    change(changed);
    Solver<Dim> fresh(sample.cage, sample.mesh, changed);
    const auto expected = fresh.solve();
    for (const bool begun : {false, true}) {
      SCOPED_TRACE(begun ? "after a solve" : "before the first solve");
      Solver<Dim> solver(sample.cage, sample.mesh, options);
      if (begun) solver.solve({resumes ? 3 : 20});
      solver.set_options(changed);
      EXPECT_EQ(solver.problem().phi.dense(), fresh.problem().phi.dense());
      EXPECT_EQ(solver.problem().smoothness, fresh.problem().smoothness);
      EXPECT_EQ(*resolve(solver.options()).tolerance, *resolve(changed).tolerance);
      const auto& solution = solver.solve();
      EXPECT_EQ(solution.report.distances.source, expected.report.distances.source);
      if (!begun || !resumes) {
        expect_same(solution, expected);
      } else if (expected.report.status == SolveStatus::kConverged) {
        // A run that resumes is the run that was interrupted.
        EXPECT_TRUE(solution.weights == expected.weights);
        EXPECT_EQ(solution.report.iterations + 3, expected.report.iterations);
      }
    }
  }
}

TEST_IN_2D_AND_3D(ContinuedSolveTest, RefusedOptionsChangeNothing) {
  const auto sample = make_sample<Dim>(Shape::kBox, 4, 0.2);
  const auto options = many_iterations(20);
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  solver.solve();
  for (const auto& change : std::vector<void (*)(SolverOptions&)>{
           [](auto& o) { o.tolerance = -1; },
           [](auto& o) { o.distances = Distances::kInterpolated; }}) {
    auto refused = options;
    change(refused);
    EXPECT_THROW(solver.set_options(refused), OptionError);
    EXPECT_EQ(solver.options().tolerance, options.tolerance);
    EXPECT_EQ(solver.options().distances, options.distances);
  }
  expect_same(solver.solve(), solve(sample.cage, sample.mesh, many_iterations(40)));
}

// Distances that were interpolated for a loose tolerance are not accurate enough for a tight one.
TEST_IN_2D_AND_3D(ContinuedSolveTest, ATighterToleranceComputesDistancesAgain) {
  const auto sample = sample_of_cases<Dim>();
  SolverOptions options;
  options.tolerance = 1e-2;
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  EXPECT_EQ(solver.solve().report.distances.source, Distances::kInterpolated);
  options.tolerance = 1e-9;
  options.certify = true;
  solver.set_options(options);
  Solver<Dim> fresh(sample.cage, sample.mesh, options);
  EXPECT_EQ(solver.problem().phi.dense(), fresh.problem().phi.dense());
  const auto& solution = solver.solve();
  EXPECT_EQ(solution.report.distances.source, Distances::kExact);
  expect_same(solution, fresh.solve());
  // The certificate is one of exact phi, which make_problem() measures on its own.
  SolverOptions certified;
  certified.certify = true;
  const auto exact = solve(smooth_problem(sample), many_iterations(800, certified)).report;
  const double optimum = exact.certificate.objective;
  EXPECT_LE(solution.report.certificate.lower_bound, optimum * (1 + 1e-9));
  EXPECT_NEAR(solution.report.certificate.objective, optimum, 5e-4 * optimum);
}

// Pairs that are negligible for the first tolerance are not for the second.
TEST_IN_2D_AND_3D(ContinuedSolveTest, TheActiveSetSuitsASmallerTolerance) {
  const auto sample = sample_of_cases<Dim>();
  const auto exact = solve(sample.cage, sample.mesh, many_iterations(2000)).weights.dense();
  SolverOptions options;
  options.precision = Precision::kDouble;
  options.active_set = ActiveSet::kOn;
  options.tolerance = 1e-4;
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  EXPECT_EQ(solver.solve().report.status, SolveStatus::kConverged);
  options.tolerance = 1e-12;
  options.max_iterations = 2000;
  solver.set_options(options);
  const auto& fine = solver.solve();
  EXPECT_LT(fine.report.active_set.density, 1);
  EXPECT_LT(mean_squared_difference(sample.mesh, fine.weights.dense(), exact), 3e-9);
}

// The duals of all pairs, which a certificate needs, exist only after a run on all pairs.
TEST_IN_2D_AND_3D(ContinuedSolveTest, ACertificateAfterTheActiveSetIsThatOfANewSolver) {
  const auto sample = sample_of_cases<Dim>();
  SolverOptions options, certified;
  options.active_set = ActiveSet::kOn;
  certified.certify = true;
  Solver<Dim> solver(sample.cage, sample.mesh, options);
  EXPECT_LT(solver.solve().report.active_set.density, 1);
  solver.set_options(certified);
  const auto& solution = solver.solve();
  expect_same(solution, solve(sample.cage, sample.mesh, certified));
  EXPECT_NE(solution.report.certificate.proof, nullptr);
  // On large meshes, kAuto chooses the active set for the first run only, and the run starts over.
  const auto problem = smooth_problem(sample);
  const Observer nobody;
  SolveReport report;
  MethodRun<Dim> run(problem), fresh(problem);
  run.solve(plan::settings_of(options), Reporter(nobody), report);
  EXPECT_FALSE(run.can_certify());
  const auto settings = plan::settings_of(certified);
  const auto weights = run.solve(settings, Reporter(nobody), report).to_dense();
  EXPECT_EQ(weights, fresh.solve(settings, Reporter(nobody), report).to_dense());
  const auto proof = run.certify(weights, nullptr);
  EXPECT_EQ(proof.lower_bound, fresh.certify(weights, nullptr).lower_bound);
  EXPECT_GT(proof.lower_bound, 0);
}

// ---- the rest -----------------------------------------------------------------------------------

// A run that a time limit ends is judged: it reports how far it was.
TEST_IN_2D_AND_3D(ContinuedSolveTest, ABudgetOfSecondsReportsResiduals) {
  const auto sample = sample_of_cases<Dim>();
  for (const auto method :
       {Method::kWeights, Method::kGradient, Method::kPaper, Method::kLbc2014}) {
    SCOPED_TRACE(name_of(method));
    SolverOptions options{method};
    Solver<Dim> solver(sample.cage, sample.mesh, options);
    const auto& report = solver.solve({0, 1e-9}).report;
    EXPECT_EQ(report.status, SolveStatus::kIterationLimit);
    EXPECT_GE(report.iterations, 1);
    EXPECT_GT(report.relative_primal_residual, 0);
    EXPECT_EQ(report.relative_dual_residual > 0,
              method == Method::kPaper || method == Method::kLbc2014);
  }
}

// A cage in meters and one in millimeters are solved alike by the same options.
TEST_IN_2D_AND_3D(ContinuedSolveTest, PenaltiesDoNotDependOnTheUnitOfLength) {
  const auto sample = make_sample<Dim>(Shape::kCorner, 4, 0.2);
  auto scaled = sample;
  scaled.cage.points *= 1024;
  scaled.mesh.points *= 1024;
  for (const auto method :
       {Method::kWeights, Method::kLbc2014, Method::kGradient, Method::kPaper}) {
    SCOPED_TRACE(name_of(method));
    SolverOptions options{method};
    options.max_iterations = 30;
    options.penalty = published_penalty(sample.cage, sample.mesh, method, 10);
    EXPECT_NEAR(published_penalty(scaled.cage, scaled.mesh, method, 10), *options.penalty,
                1e-12 * *options.penalty);
    const auto one = solve(sample.cage, sample.mesh, options);
    const auto other = solve(scaled.cage, scaled.mesh, options);
    EXPECT_LT((one.weights.dense() - other.weights.dense()).cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_NEAR(one.report.penalty, *options.penalty, 1e-12 * *options.penalty);
    EXPECT_NEAR(one.report.published_penalty, 10, 1e-11);
    EXPECT_NEAR(other.report.published_penalty, 10, 1e-11);
    // What a run reports can be asked for.
    options.penalty.reset();
    options.precision = Precision::kDouble;
    if (method == Method::kLbc2014) continue;  // a given penalty is the published method
    const auto by_method = solve(sample.cage, sample.mesh, options);
    options.penalty = by_method.report.penalty;
    const auto given = solve(sample.cage, sample.mesh, options);
    EXPECT_LT((by_method.weights.dense() - given.weights.dense()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

}  // namespace
}  // namespace flbc::testing

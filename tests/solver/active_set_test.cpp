// SPDX-License-Identifier: BSD-3-Clause
// The iteration on the active set: its linear step against a dense solver of the same problem, and
// its limit against the iteration on all pairs.
#include "flbc/harmonic.h"
#include "polytope/nearest_point_in_hull.h"
#include "solver/methods/active_set/active_splitting.h"
#include "solver/plan/choices.h"
#include "solver/run/run.h"
#include "support/refined_sample.h"
#include "support/solver_options.h"

namespace flbc::testing {
namespace {

using active_set::ActiveLists;
using active_set::ControlPoint;

template <int Dim>
LbcProblem<Dim> make_fine_problem(Shape shape) {
  const auto sample = with_fine_cage<Dim>(shape, 2, Dim == 2 ? 8 : 4);
  return smooth_problem(sample);
}

// The tighter the larger the threshold, as far as each vertex has weights there.
template <int Dim>
ActiveLists active_of_harmonic(const LbcProblem<Dim>& problem, double threshold) {
  const WeightMatrix weights = harmonic_coordinates(problem);
  return active_set::active_of<Dim>(
      problem, [&](Index v) -> Eigen::VectorXd { return weights.col(v); }, threshold);
}

template <int Dim>
std::vector<const active_set::Kernel<double, Dim>*> kernels() {
  const auto list = supported_kernels<active_set::Kernel<double, Dim>>();
  return {list.kernels, list.kernels + list.size};
}

// The changes of weights on the supports that sum to zero and reproduce zero, and the system: all
// of it dense, pair by pair.
template <int Dim>
struct DenseSpace {
  Eigen::MatrixXd basis;   // of the changes, pairs x dimensions
  Eigen::MatrixXd system;  // K for every control point, pairs x pairs

  DenseSpace(const LbcProblem<Dim>& problem, const RowMatrix& matrix,
             const active_set::PackedLists& lists, const std::vector<Index>& vertices) {
    const Index rows = static_cast<Index>(vertices.size());
    std::vector<std::pair<Index, Index>> pairs;  // row and control point
    for (Index row = 0; row < rows; ++row) {
      for (Index j = 0; j < lists.counts[row]; ++j) {
        pairs.emplace_back(row, lists.items[lists.starts[row] + j]);
      }
    }
    const auto size = static_cast<Index>(pairs.size());
    Eigen::MatrixXd constraints = Eigen::MatrixXd::Zero((Dim + 1) * rows, size);
    system = Eigen::MatrixXd::Zero(size, size);
    const Eigen::MatrixXd dense(matrix);
    for (Index a = 0; a < size; ++a) {
      const auto [row, i] = pairs[a];
      constraints((Dim + 1) * row, a) = 1;
      constraints.block((Dim + 1) * row + 1, a, Dim, 1) = problem.cage.points.col(i);
      for (Index b = 0; b < size; ++b) {
        if (pairs[b].second == i) system(a, b) = dense(row, pairs[b].first);
      }
    }
    basis = null_space(constraints);
  }

  Eigen::VectorXd minimizer(const Eigen::VectorXd& right_side) const {
    const Eigen::MatrixXd reduced = basis.transpose() * system * basis;
    return basis * solve_symmetric(reduced, basis.transpose() * right_side);
  }
};

// The multigrid of a problem, and rows without their padding.
template <int Dim>
struct LinearStep {
  RowMatrix matrix;
  active_set::SweepOrder order;
  std::vector<Index> vertices;
  active_set::PackedLists lists;
  AlignedArray<double> bases;

  LinearStep(const LbcProblem<Dim>& problem, const ActiveLists& active) {
    const auto metric = splitting::measure_metric(problem, true);
    matrix = splitting::system_matrix(problem, metric);
    order = active_set::sweep_order(matrix);
    vertices.resize(matrix.rows());
    Index unknown = 0;
    for (const Index v : problem.boundary.interior_vertices()) {
      vertices[order.position[unknown++]] = v;
    }
    for (const Index v : vertices) {
      lists.append(active.of(v), static_cast<ControlPoint>(problem.num_control_points()));
    }
    bases = active_set::row_bases<double, Dim>(lists, problem.cage.points, {}, nullptr);
  }

  Eigen::VectorXd packed(const AlignedArray<double>& numbers) const {
    std::vector<double> result;
    for (Index row = 0; row < lists.num_rows(); ++row) {
      for (Index j = 0; j < lists.counts[row]; ++j) {
        result.push_back(numbers[lists.starts[row] + j]);
      }
    }
    return Eigen::Map<const Eigen::VectorXd>(result.data(), static_cast<Index>(result.size()));
  }

  AlignedArray<double> padded_rows(const Eigen::VectorXd& numbers) const {
    AlignedArray<double> result(lists.size());
    Index next = 0;
    for (Index row = 0; row < lists.num_rows(); ++row) {
      for (Index j = 0; j < lists.counts[row]; ++j) {
        result[lists.starts[row] + j] = numbers[next++];
      }
    }
    return result;
  }
};

template <int Dim>
Eigen::VectorXd cycle_of(active_set::ActiveMultigrid<double, Dim>& multigrid,
                         const LinearStep<Dim>& step, const Eigen::VectorXd& right_side) {
  auto rows = step.padded_rows(right_side);
  multigrid.cycle(rows.data());
  return step.packed(rows);
}

TEST_IN_2D_AND_3D(ActiveSetTest, LinearStepIsASymmetricCorrectionWithinTheConstraints) {
  const auto problem = make_fine_problem<Dim>(Shape::kCorner);
  const LinearStep<Dim> step(problem, active_of_harmonic(problem, 0.02));
  const DenseSpace<Dim> space(problem,
                              reordered(step.matrix, step.order.position, step.order.position),
                              step.lists, step.vertices);
  ASSERT_GT(space.basis.cols(), 20);
  for (const auto* kernel : kernels<Dim>()) {
    active_set::ActiveMultigrid<double, Dim> multigrid(step.matrix, step.order, step.lists,
                                                       step.bases, problem.cage.points, *kernel);
    const Eigen::VectorXd a = Eigen::VectorXd::Random(space.system.rows());
    const Eigen::VectorXd b = Eigen::VectorXd::Random(space.system.rows());
    const Eigen::VectorXd of_a = cycle_of(multigrid, step, a);
    const Eigen::VectorXd of_b = cycle_of(multigrid, step, b);
    const double scale = of_a.norm() + of_b.norm();
    EXPECT_LT((of_a - space.basis * (space.basis.transpose() * of_a)).norm(), 1e-12 * scale);
    EXPECT_NEAR(of_a.dot(b), of_b.dot(a), 1e-12 * scale * (a.norm() + b.norm()));
    // B >= K: errors shrink in the energy norm, and more than those of nothing at all.
    const Eigen::VectorXd exact = space.minimizer(a);
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(a.size());
    double energy = exact.dot(space.system * exact);
    const double first = energy;
    for (int cycle = 0; cycle < 12; ++cycle) {
      solution += cycle_of<Dim>(multigrid, step, a - space.system * solution);
      const Eigen::VectorXd error = exact - solution;
      const double now = error.dot(space.system * error);
      EXPECT_LE(now, energy);
      energy = now;
    }
    EXPECT_LT(energy, 1e-6 * first);
  }
}

// A run as solve() makes it, from harmonic coordinates on a tight set.
template <class Scalar, int Dim>
Solution run_on_tight(const LbcProblem<Dim>& problem, double tolerance = 1e-14) {
  SolverOptions options;
  options.tolerance = tolerance;
  options.max_iterations = 2000;
  const auto settings = plan::settings_of(options);
  const WeightMatrix weights = harmonic_coordinates(problem);
  Start<Dim> start;
  start.penalty = 0.1;
  start.weights = [&](Index v) -> Eigen::VectorXd { return weights.col(v); };
  start.flux_density = [n = problem.num_control_points()](Index) {
    return Vectors<Dim>::Zero(n, Dim).eval();
  };
  active_set::ActiveSplitting<Scalar, Dim> iteration(
      problem, splitting::measure_metric(problem, true), {start.penalty, settings.relaxation},
      active_of_harmonic(problem, 0.2));
  iteration.start(start);
  const double n = problem.num_control_points();
  RunState state{StopRule::estimate(
      1 / (n * static_cast<double>(problem.boundary.interior_vertices().size())), 1)};
  const Observer nobody;
  SolveReport report;
  run<Dim>(iteration, state, {problem, settings, Reporter(nobody)}, report);
  iteration.describe(report);
  return {iteration.weights().sparse, std::move(report)};
}

// Without an estimated error that could end it.
template <int Dim>
Solution solve_exactly(const LbcProblem<Dim>& problem, ActiveSet active_set) {
  SolverOptions options;
  options.precision = Precision::kDouble;
  options.tolerance = 1e-14;
  options.max_iterations = 2000;
  options.active_set = active_set;
  return solve(problem, options);
}

TEST_IN_2D_AND_3D(ActiveSetTest, GrowsToTheOptimumOfAllPairs) {
  for (const auto shape : {Shape::kBox, Shape::kCorner}) {
    const auto problem = make_fine_problem<Dim>(shape);
    const auto all = solve_exactly(problem, ActiveSet::kOff).weights;
    const auto exact = run_on_tight<double>(problem), single = run_on_tight<float>(problem);
    EXPECT_GT(exact.report.active_set.growths, 0);
    EXPECT_LT(squared_error(problem, exact.weights, all), 1e-9);
    EXPECT_LT(squared_error(problem, single.weights, all), 1e-9);
  }
}

TEST_IN_2D_AND_3D(ActiveSetTest, SolveGivesTheSameOptimum) {
  const auto problem = make_fine_problem<Dim>(Shape::kCorner);
  const auto all = solve_exactly(problem, ActiveSet::kOff);
  EXPECT_EQ(all.report.active_set.density, 1);
  const auto restricted = solve_exactly(problem, ActiveSet::kOn);
  EXPECT_LT(restricted.report.active_set.density, 1);
  EXPECT_LT(squared_error(problem, restricted.weights, all.weights), 1e-9);
  EXPECT_NEAR(restricted.report.objective, all.report.objective, 1e-5 * all.report.objective);
  const auto judged = expect_coordinates(problem.cage, problem.mesh, restricted.weights.dense());
  EXPECT_GE(judged.min_weight, 0);
}

TEST_IN_2D_AND_3D(ActiveSetTest, NumberOfThreadsDoesNotMatter) {
  const auto problem = make_fine_problem<Dim>(Shape::kStar);
  expect_same_for_any_threads([&] { return run_on_tight<float>(problem, 1e-6).weights.dense(); });
}

// Whether a vertex is a combination of its control points with weights that are not negative.
TEST_IN_2D_AND_3D(ActiveSetTest, EveryVertexHasWeightsOnItsSupport) {
  const auto problem = make_fine_problem<Dim>(Shape::kStar);
  // Nothing is above this threshold: all that is there is what boundaries and feasibility ask for.
  const auto lists = active_of_harmonic(problem, 2);
  for (const Index v : problem.boundary.interior_vertices()) {
    const auto list = lists.of(v);
    PointList<Dim> points(Dim, list.last - list.first);
    for (Index j = 0; j < points.cols(); ++j)
      points.col(j) = problem.cage.points.col(list.first[j]);
    const Vector<Dim> point = problem.mesh.points.col(v);
    EXPECT_LT(nearest_point_in_hull<Dim>(points, point).distance, 1e-6) << "vertex " << v;
  }
}

// Pair by pair, over all pairs of vertices of a cell.
TEST_IN_2D_AND_3D(ActiveSetTest, EndsAreWhereANeighborLacksTheControlPoint) {
  const auto problem = make_fine_problem<Dim>(Shape::kCorner);
  const auto lists = active_of_harmonic(problem, 0.1);
  const auto holds = [&](Index v, ControlPoint i) {
    const auto list = lists.of(v);
    return std::find(list.first, list.last, i) != list.last;
  };
  std::set<std::pair<Index, ControlPoint>> ends;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    for (const Index v : problem.mesh.cells.col(s)) {
      for (const Index u : problem.mesh.cells.col(s)) {
        if (!problem.boundary.is_interior(v) || !problem.boundary.is_interior(u)) continue;
        for (const ControlPoint i : lists.of(v)) {
          if (!holds(u, i)) ends.insert({v, i});
        }
      }
    }
  }
  ASSERT_FALSE(ends.empty());
  const auto weight_of = [](Index v, ControlPoint i) { return 1.0 + v % 7 + 0.1 * i; };
  double expected = 0;
  for (const auto& [v, i] : ends) expected += weight_of(v, i) * weight_of(v, i);
  const auto in_list = [&](Index v, Index place) { return weight_of(v, lists.of(v).first[place]); };
  EXPECT_NEAR(active_set::squared_at_ends(problem, lists, in_list), expected, 1e-10 * expected);
  const auto larger = active_set::grown(problem, lists, 0, in_list);
  EXPECT_GT(larger.items.size(), lists.items.size());
  EXPECT_EQ(active_set::grown(problem, lists, 1e9, in_list).items, lists.items);
}

// Near weights above the threshold it stays as it is, elsewhere it is zero.
TEST_IN_2D_AND_3D(ActiveSetTest, FluxIsHandedOnWhereWeightsAre) {
  const auto problem = make_fine_problem<Dim>(Shape::kStar);
  const Index n = problem.num_control_points();
  const WeightMatrix weights = harmonic_coordinates(problem);
  Start<Dim> start;
  start.weights = [&](Index v) -> Eigen::VectorXd { return weights.col(v); };
  start.flux_density = [&](Index s) { return Vectors<Dim>::Constant(n, Dim, s + 1).eval(); };
  constexpr double kThreshold = 0.1;
  const auto handed_on = active_set::where_weights_are(problem, start, kThreshold);
  Index zeros = 0;
  for (Index s = 0; s < problem.mesh.num_cells(); ++s) {
    const auto density = handed_on(s);
    for (Index i = 0; i < n; ++i) {
      bool is_near = false;
      for (const Index v : problem.mesh.cells.col(s)) is_near |= weights(i, v) > kThreshold;
      const double number = density(i, 0);
      EXPECT_TRUE(!is_near || number == s + 1);
      if (number == 0) ++zeros;
      EXPECT_TRUE(number == 0 || number == s + 1);
      EXPECT_TRUE((density.row(i).array() == number).all());
    }
  }
  EXPECT_GT(zeros, 0);
}

TEST(ActiveSetChoice, AreFor3DWithoutProofs) {
  const auto serve = [](const auto& problem, ActiveSet choice, bool certify) {
    SolverOptions options;
    options.active_set = choice;
    options.certify = certify;
    return plan::active_set(plan::sizes_of(problem), plan::settings_of(options));
  };
  const auto flat = make_fine_problem<2>(Shape::kBox);
  const auto solid = make_fine_problem<3>(Shape::kBox);
  EXPECT_FALSE(serve(flat, ActiveSet::kAuto, false));
  EXPECT_TRUE(serve(flat, ActiveSet::kOn, false));
  EXPECT_TRUE(serve(solid, ActiveSet::kAuto, false));
  EXPECT_FALSE(serve(solid, ActiveSet::kAuto, true));
  EXPECT_FALSE(serve(solid, ActiveSet::kOff, false));
}

}  // namespace
}  // namespace flbc::testing

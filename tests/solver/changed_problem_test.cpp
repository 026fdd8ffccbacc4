// SPDX-License-Identifier: BSD-3-Clause
// A solver whose problem changes, in any order, finds what a new one finds.
#include <map>

#include "support/solver_options.h"

namespace flbc::testing {
namespace {

constexpr double kTolerance = 1e-6;
constexpr double kAccuracy = 4;  // of the estimated error

template <int Dim>
struct Problem {
  std::string name;
  Cage<Dim> cage;
  DomainMesh<Dim> mesh;
  int axis = 0;  // across the mask
  ActiveSet active_set = ActiveSet::kAuto;
};

// Control points in the upper half along an axis must not move the lowest part.
template <int Dim>
Mask mask_of(const Problem<Dim>& problem, double part = 0.3) {
  const auto row = problem.cage.points.row(problem.axis);
  const double low = row.minCoeff(), size = row.maxCoeff() - low;
  Mask mask;
  for (Index i = 0; i < problem.cage.size(); ++i) {
    if (row[i] > low + 0.6 * size) mask.control_points.push_back(i);
  }
  for (Index v = 0; v < problem.mesh.num_vertices(); ++v) {
    if (problem.mesh.points(problem.axis, v) < low + part * size) mask.points.push_back(v);
  }
  return mask;
}

template <int Dim>
SolverOptions options_of(const Problem<Dim>& problem) {
  SolverOptions options;
  options.tolerance = kTolerance;
  options.active_set = problem.active_set;
  return options;
}

template <int Dim>
using Change = std::pair<const char*, std::function<void(const Problem<Dim>&, Solver<Dim>&)>>;

template <int Dim>
Change<Dim> change_of(const char* name, void (*change)(const Problem<Dim>&, SolverOptions&)) {
  return {name, [change](const Problem<Dim>& problem, Solver<Dim>& solver) {
            auto options = solver.options();
            change(problem, options);
            solver.set_options(options);
          }};
}

template <int Dim>
std::vector<Change<Dim>> changes() {
  using P = const Problem<Dim>&;
  return {
      change_of<Dim>("masks", [](P p, SolverOptions& o) { o.masks = {mask_of(p)}; }),
      change_of<Dim>("reach",
                     [](P p, SolverOptions& o) {
                       o.reach.assign(p.cage.size(), 1);
                       o.reach[1] = o.reach[4] = 8;
                     }),
      {"reshape",
       [](P p, Solver<Dim>& solver) {
         PointList<Dim> points = solver.cage().points;
         const double size = bounding_box_diagonal(points);
         points.row(1).array() += 0.01 * size * (4 / size * p.cage.points.row(0).array()).sin();
         solver.reshape(points);
       }},
      change_of<Dim>("phi", [](P, SolverOptions& o) { o.phi = DistanceScheme::kLinear; }),
      change_of<Dim>("smoothness", [](P, SolverOptions& o) { o.smoothness = 0.01; }),
      change_of<Dim>("tolerance", [](P, SolverOptions& o) { o.tolerance = 1e-7; }),
  };
}

// By all pairs, at a thousandth of the tolerance.
template <int Dim>
WeightMatrix optimum_of(const Solver<Dim>& solver) {
  auto options = solver.options();
  *options.tolerance /= 1000;
  options.precision = Precision::kDouble;
  options.active_set = ActiveSet::kAuto;
  options.certify = true;
  const auto solution = Solver<Dim>(solver.cage(), solver.mesh(), options).solve();
  EXPECT_EQ(solution.report.status, SolveStatus::kConverged);
  EXPECT_LT(solution.report.certificate.relative_gap, 1e-3);
  return solution.weights.dense();
}

template <int Dim>
void expect_changes_are_solved(const Problem<Dim>& problem) {
  constexpr int kPaired = 4;  // pairs of the first ones
  const auto all = changes<Dim>();
  std::map<std::string, WeightMatrix> optima;
  // \param same  the problems of sequences with this name are equal
  const auto expect_solved = [&](const std::string& same, auto& solver) {
    const auto& [weights, report] = solver.solve();
    EXPECT_EQ(report.status, SolveStatus::kConverged);
    EXPECT_GE(report.quality.min_weight, 0);
    if (optima.count(same) == 0) optima[same] = optimum_of(solver);
    EXPECT_LT(mean_squared_difference(solver.mesh(), weights.dense(), optima[same]),
              kAccuracy * *solver.options().tolerance);
    for (const auto& mask : solver.options().masks) {
      for (const Index v : mask.points) {
        if (!solver.problem().boundary.is_interior(v)) continue;
        EXPECT_TRUE((weights.at(v)(mask.control_points).array() == 0).all()) << v;
      }
    }
  };
  for (int a = 0; a < static_cast<int>(all.size()); ++a) {
    for (int b = 0; b < static_cast<int>(all.size()); ++b) {
      if (a != b && std::max(a, b) >= kPaired) continue;
      for (const bool solves_first : {false, true}) {
        for (const bool solves_between : {false, true}) {
          if (solves_between && (a == b || !solves_first)) continue;
          SCOPED_TRACE(problem.name + (solves_first ? ": solved, " : ": ") + all[a].first +
                       (solves_between ? ", solved, " : ", ") + (a == b ? "" : all[b].first));
          Solver<Dim> solver(problem.cage, problem.mesh, options_of(problem));
          if (solves_first) solver.solve();
          all[a].second(problem, solver);
          if (solves_between) solver.solve();
          if (a != b) all[b].second(problem, solver);
          // The mesh of a reshaped cage depends on the weights by which it follows.
          const bool reshapes =
              all[a].first == std::string("reshape") || all[b].first == std::string("reshape");
          const auto [first, second] = std::minmax(a, b);
          expect_solved(reshapes ? std::to_string(a) + "," + std::to_string(b) +
                                       (solves_first ? "s" : "") + (solves_between ? "s" : "")
                                 : std::to_string(first) + "," + std::to_string(second),
                        solver);
        }
      }
    }
  }
}

std::string mesh_path(const char* name) {
  return std::string(FLBC_MESHES_DIR) + "/" + name;
}

TEST(ChangedProblem2dTest, IsSolvedAsByANewSolver) {
  const auto polygon = regular_polygon(12);
  expect_changes_are_solved<2>({"polygon", polygon, mesh_of(polygon, 800)});
  const auto figure = load_cage<2>(mesh_path("2d/figure_cage.obj"));
  expect_changes_are_solved<2>({"figure", figure, mesh_of(figure, 800), 1, ActiveSet::kOn});
}

TEST(ChangedProblem3dTest, IsSolvedAsByANewSolver) {
  const auto limb = load_cage<3>(mesh_path("3d/limb_cage.obj"));
  expect_changes_are_solved<3>({"limb", limb, mesh_of(limb, 800), 0, ActiveSet::kOn});
}

// The brush of the browser page: every stroke enlarges the mask.
TEST(ChangedProblem3dTest, StrokesOfAMaskTakeFewIterations) {
  const auto limb = load_cage<3>(mesh_path("3d/limb_cage.obj"));
  const Problem<3> problem{"limb", limb, mesh_of(limb, 2000)};
  auto options = options_of(problem);
  Solver<3> solver(limb, problem.mesh, options);
  solver.solve();
  for (const double part : {0.1, 0.15, 0.2, 0.25, 0.3}) {
    options.masks = {mask_of(problem, part)};
    solver.set_options(options);
    EXPECT_LT(solver.solve().report.iterations,
              solve(limb, problem.mesh, options).report.iterations / 2);
  }
}

}  // namespace
}  // namespace flbc::testing

// SPDX-License-Identifier: BSD-3-Clause
// Which method is first at an error of 1e-5, whatever it believes its error to be.
#include <algorithm>
#include <optional>

#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/methods_table.h"
#include "paper/stopwatch.h"

namespace flbc::bench {
namespace {

constexpr double kWanted = 1e-5;
constexpr int kMostIterations = 10000;
constexpr int kQuickIterations = 200;
constexpr int kRepetitions = 3;

std::vector<std::string> columns() {
  return joined({mesh_columns(), run_columns(), {"coarse_levels", "error"}});
}

// How a method runs as the program runs it, on the given mesh for as many iterations as it is told.
template <int Dim>
class Runner {
 public:
  Runner(const Setting<Dim>& setting, const WeightMatrix& optimum, const SolverOptions& options)
      : setting_(setting), optimum_(optimum), options_(options) {}

  Solution run(int iterations) const {
    Observer observer;
    observer.progress = [iterations](const Progress& progress) {
      return progress.finer_levels > 0 || progress.iteration < iterations;
    };
    return solve(setting_.problem, options_, coarse_mesher<Dim>(), observer);
  }

  double error_after(int iterations) const {
    return squared_error(setting_.problem, run(iterations).weights, optimum_);
  }

  // The first number of iterations, in tens, after which the error is as wanted; 0 if there is none
  // up to `most`.
  int first_iterations(int most) const {
    int low = 0;
    int high = 1;  // in tens
    while (error_after(10 * high) > kWanted) {
      if (10 * high >= most) return 0;
      low = high;
      high = std::min(2 * high, most / 10);
    }
    while (high - low > 1) {
      const int middle = (low + high) / 2;
      (error_after(10 * middle) > kWanted ? low : high) = middle;
    }
    return 10 * high;
  }

 private:
  const Setting<Dim>& setting_;
  const WeightMatrix& optimum_;
  const SolverOptions& options_;
};

template <int Dim>
double best_setup_seconds(const Setting<Dim>& setting) {
  double best = setting.setup_seconds;
  for (int k = 0; k < kRepetitions; ++k) {
    const Stopwatch watch;
    make_problem(setting.problem.cage, setting.problem.mesh, DistanceScheme::kSquare);
    best = std::min(best, watch.seconds());
  }
  return best;
}

template <int Dim>
Row measure(const Context& context, const Setting<Dim>& setting, const NamedMethod& method) {
  const int most = context.quick ? kQuickIterations : kMostIterations;
  const auto optimum = reference(context, setting);
  auto options = method.options(setting.problem, context.threads);
  options.max_iterations = 2 * most;
  // No method shall stop before.
  if (method.method == Method::kValue) options.tolerance = kWanted;
  if (method.method == Method::kPaper) options.tolerance = 1e-100;
  if (method.method == Method::kLbc2014) {
    constexpr double kNever = 1e-3;
    options.tolerance = kNever * *resolve(options).tolerance;
  }
  const Runner<Dim> runner(setting, optimum.weights, options);
  const int found = runner.first_iterations(most);
  std::optional<Solution> best;
  const auto seconds = [](const SolveReport& report) {
    return report.seconds.solve + report.seconds.recover;
  };
  for (int k = 0; k < (found > 0 ? kRepetitions : 1); ++k) {
    auto solution = runner.run(found > 0 ? found : most);
    if (!best || seconds(solution.report) < seconds(best->report)) best = std::move(solution);
  }
  auto row = mesh_row(setting);
  add_run(row, method.name, best_setup_seconds(setting), best->report);
  row["converged"] = found > 0 ? "1" : "0";
  row["coarse_levels"] = std::to_string(best->report.coarse_levels.size());
  row["error"] = number(squared_error(setting.problem, best->weights, optimum.weights));
  return row;
}

}  // namespace

bool run_race(const Context& context) {
  ResultTable table(context, "race", columns());
  const auto is_wanted = [](const NamedMethod& method) {
    const bool as_published = method.method == Method::kLbc2014 && method.penalty > 0;
    return !as_published;
  };
  add_methods(context, "race", table, is_wanted,
              [&](const auto& setting, const NamedMethod& method) {
                return measure(context, setting, method);
              });
  return table.write(
      "iterations on the given mesh, in tens, and seconds to a true error of 1e-5, the least of " +
      std::to_string(kRepetitions) +
      " runs; value from coarser meshes where flbc solve starts from these, which are made and "
      "solved within the time; converged 0: not reached within " +
      std::to_string(kMostIterations) + " iterations");
}

}  // namespace flbc::bench

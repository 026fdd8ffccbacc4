// SPDX-License-Identifier: BSD-3-Clause
// From cage to coordinates as flbc solve does it: by default, to a tolerance of 1e-5, and up to
// millions of cells.
#include <variant>

#include "experiments.h"
#include "flbc/coordinates.h"
#include "flbc/io/cage_io.h"
#include "flbc/io/model_file.h"
#include "problems.h"

namespace flbc::bench {
namespace {

constexpr int kRepetitions = 3;            // the fastest counts
constexpr Index kLargestRepeated = 50000;  // vertices
constexpr Index kLargestWithHarmonic = 200000;

struct Size {
  std::string model;
  Index vertices;
};

template <int Dim>
Row measure(const Context& context, const Model& model, const Cage<Dim>& cage, Index vertices,
            std::optional<double> tolerance, bool with_error) {
  const Stopwatch watch;
  const auto mesh = mesh_of(cage, vertices);
  const double mesh_seconds = watch.seconds();
  SolverOptions options;
  options.threads = context.threads;
  options.tolerance = tolerance;
  const int repetitions = mesh.num_vertices() <= kLargestRepeated ? kRepetitions : 1;
  double peak = 0;  // of the first run, because later ones keep an earlier solution
  const auto solution = fastest(repetitions, [&] {
    auto once = solve(cage, mesh, options);
    if (peak == 0) peak = peak_mebibytes();
    return once;
  });
  const auto& report = solution.report;
  auto row = mesh_row(model.name, cage, mesh).add("mesh_seconds", mesh_seconds);
  add_run(row, report.seconds.setup, report);
  row.add("peak_mebibytes", peak)
      .add("min_weight", report.quality.min_weight)
      .add("reproduction_error", report.quality.max_reproduction_error)
      .add("mean_influences", report.quality.mean_influences);
  if (mesh.num_vertices() <= kLargestWithHarmonic) {
    const auto compute = [&] {
      return compute_coordinates(cage, mesh, Coordinates::kHarmonic,
                                 {NonNegative::kAuto, context.threads});
    };
    const auto harmonic = fastest(repetitions, compute).report;
    row.add("harmonic_seconds", seconds_of(harmonic))
        .add("harmonic_influences", harmonic.quality.mean_influences);
  }
  if (with_error) {
    const auto name = model.name + "-" + std::to_string(vertices);
    const Setting<Dim> setting{context, model, name,
                               make_problem(cage, mesh, options.phi, default_smoothness()), 0};
    row.add("error", squared_error(setting.problem, solution.weights, reference(setting).weights));
  }
  return row;
}

bool run(const Context& context, const char* name, std::optional<double> tolerance,
         const std::vector<Size>& sizes, const std::string& about) {
  ResultTable table(context, name,
                    about + ": the least seconds of " + std::to_string(kRepetitions) +
                        " runs, of one run on meshes of more than " +
                        std::to_string(kLargestRepeated) +
                        " vertices; solve includes coarse meshes; peak: memory of the process; "
                        "influences: weights above 1e-4, mean per vertex");
  for (const auto& size : sizes) {
    if (!context.wants(size.model)) continue;
    const auto& chosen = model(size.model);
    const Index vertices = context.size(size.vertices);
    const bool with_error = tolerance && vertices == context.size(chosen.paper_size);
    table.add(size.model + "-" + std::to_string(vertices), [&] {
      omp_set_num_threads(context.threads);
      const auto file = cage_path(context, chosen);
      return std::visit(
          [&](const auto& cage) {
            return Rows{measure(context, chosen, cage, vertices, tolerance, with_error)};
          },
          io::to_cage(io::read_polygons(file), file));
    });
  }
  return table.finish();
}

}  // namespace

bool run_models(const Context& context) {
  std::vector<Size> sizes;
  for (const auto& model : models()) sizes.push_back({model.name, model.paper_size});
  sizes.push_back({"horse", 40000});
  return run(context, "models", {}, sizes, "Default options");
}

bool run_speed(const Context& context) {
  return run(context, "speed", 1e-5,
             {{"woody", 10800},
              {"cactus", 10850},
              {"logo", 26800},
              {"horse", 5850},
              {"armadillo", 6640},
              {"woody", 100000},
              {"woody", 1000000},
              {"horse", 40000},
              {"horse", 180000},
              {"horse", 440000}},
             "Tolerance 1e-5");
}

}  // namespace flbc::bench

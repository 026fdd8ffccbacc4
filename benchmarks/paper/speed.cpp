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

struct Way {
  std::optional<double> tolerance;
  int repetitions;               // the fastest counts
  bool with_harmonic;            // next to harmonic coordinates on the same mesh
  Index largest_with_error = 0;  // vertices up to which the true error is measured
};

struct Size {
  std::string model;
  Index vertices;
};

template <int Dim>
Row measure(const Context& context, const Model& model, const Cage<Dim>& cage, Index vertices,
            const Way& way) {
  const Stopwatch watch;
  const auto mesh = mesh_of(cage, vertices);
  const double mesh_seconds = watch.seconds();
  SolverOptions options;
  options.threads = context.threads;
  options.tolerance = way.tolerance;
  const auto solution =
      fastest(way.repetitions, [&] { return solve(cage, mesh, options, coarse_mesher<Dim>()); });
  const auto& report = solution.report;
  auto row = mesh_row(model.name, cage, mesh).add("mesh_seconds", mesh_seconds);
  add_run(row, report.seconds.setup, report);
  row.add("peak_mebibytes", peak_mebibytes())
      .add("min_weight", report.quality.min_weight)
      .add("reproduction_error", report.quality.max_reproduction_error)
      .add("mean_influences", report.quality.mean_influences);
  if (way.with_harmonic) {
    const auto compute = [&] {
      return compute_coordinates(cage, mesh, Coordinates::kHarmonic,
                                 {NonNegative::kAuto, context.threads});
    };
    const auto harmonic = fastest(way.repetitions, compute).report;
    row.add("harmonic_seconds", seconds_of(harmonic))
        .add("harmonic_influences", harmonic.quality.mean_influences);
  }
  if (mesh.num_vertices() <= way.largest_with_error) {
    const auto name = model.name + "-" + std::to_string(vertices);
    const Setting<Dim> setting{context, model, name,
                               make_problem(cage, mesh, DistanceScheme::kSquare), 0};
    row.add("error", squared_error(setting.problem, solution.weights, reference(setting).weights));
  }
  return row;
}

bool run(const Context& context, const char* name, const Way& way, const std::vector<Size>& sizes,
         const std::string& about) {
  ResultTable table(context, name);
  for (const auto& size : sizes) {
    if (!context.wants(size.model)) continue;
    const auto& chosen = model(size.model);
    const Index vertices = context.size(size.vertices);
    const auto what = name + (": " + size.model) + "-" + std::to_string(vertices);
    table.add(in_child(what, [&] {
      omp_set_num_threads(context.threads);
      const auto file = cage_path(context, chosen);
      return std::visit(
          [&](const auto& cage) { return Rows{measure(context, chosen, cage, vertices, way)}; },
          io::to_cage(io::read_polygons(file), file));
    }));
  }
  return table.write(about +
                     ", from cage to coordinates: seconds of the stages, the least total of " +
                     std::to_string(way.repetitions) +
                     ", coarser meshes and making them included in solve; MiB are the most of the "
                     "process; influences: weights above 1e-4, mean per vertex");
}

}  // namespace

bool run_models(const Context& context) {
  std::vector<Size> sizes;
  for (const auto& model : models()) sizes.push_back({model.name, model.paper_size});
  sizes.push_back({"horse", 40000});
  return run(context, "models", {{}, 3, true}, sizes, "value by default");
}

bool run_speed(const Context& context) {
  return run(context, "speed", {1e-5, 5, true, 30000},
             {{"woody", 10800},
              {"cactus", 10850},
              {"logo", 26800},
              {"horse", 5850},
              {"armadillo", 6640},
              {"woody", 100000},
              {"horse", 40000},
              {"horse", 180000}},
             "value with tolerance 1e-5");
}

bool run_growth(const Context& context) {
  return run(context, "growth", {1e-5, 1, false},
             {{"woody", 10000},
              {"woody", 30000},
              {"woody", 100000},
              {"woody", 300000},
              {"woody", 1000000},
              {"horse", 5800},
              {"horse", 20000},
              {"horse", 60000},
              {"horse", 180000},
              {"horse", 440000}},
             "value with tolerance 1e-5");
}

}  // namespace flbc::bench

// SPDX-License-Identifier: BSD-3-Clause
// Share of the memory's bandwidth that an iteration and a deformation reach, counted by the fewest
// bytes they have to move.
#include <algorithm>
#include <random>
#include <vector>

#include "flbc/deform.h"
#include "flbc/solver.h"
#include "paper/experiments.h"
#include "paper/result_table.h"
#include "paper/run_columns.h"
#include "paper/stopwatch.h"
#include "speed/iteration_time.h"

namespace flbc::bench {
namespace {

constexpr int kRepetitions = 5;

std::vector<std::string> columns() {
  return {"what", "gigabytes", "seconds", "gigabytes_per_second", "of_copy"};
}

template <class Action>
double best_seconds(const Action& action) {
  double best = 1e300;
  for (int k = 0; k < kRepetitions; ++k) {
    const Stopwatch watch;
    action();
    best = std::min(best, watch.seconds());
  }
  return best;
}

// Bytes per second, read and written, of copying arrays far larger than any cache.
double copy_bandwidth() {
  constexpr std::ptrdiff_t kNumbers = 1 << 27;
  std::vector<float> from(kNumbers, 1);
  std::vector<float> to(kNumbers, 2);
  const double seconds = best_seconds([&] {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t k = 0; k < kNumbers; ++k) to[k] = from[k];
  });
  return 2.0 * kNumbers * sizeof(float) / seconds;
}

Row row_of(double copy, const std::string& what, double bytes, double seconds) {
  return {{"what", what},
          {"gigabytes", number(bytes / 1e9)},
          {"seconds", number(seconds)},
          {"gigabytes_per_second", number(bytes / seconds / 1e9)},
          {"of_copy", number(bytes / seconds / copy)}};
}

// The gradient iteration reads and writes gradients, duals of the total variation and of the
// integrability, and reads phi.
template <int Dim>
Row measure_gradient(const Context& context, const Setting<Dim>& setting, double copy) {
  const auto& problem = setting.problem;
  const double state =
      2.0 * Dim * problem.mesh.num_cells() + (Dim - 1.0) * problem.topology.num_facets();
  const double numbers = 2 * state + problem.mesh.num_cells();
  return row_of(copy, std::string("gradient iteration: ") + setting.model.name + " " +
                    std::to_string(problem.mesh.num_vertices()) + " V",
                numbers * problem.num_control_points() * sizeof(float),
                iteration_seconds(problem, Method::kGradient, context.threads));
}

// Random sparse weights of many points, as rows of dense ones and without their zeros.
std::string measure_deform(const ResultTable& table, double copy, Index num_points) {
  constexpr Index kControlPoints = 110;
  constexpr Index kInfluences = 8;
  std::mt19937 random(1);
  WeightMatrix weights = WeightMatrix::Zero(kControlPoints, num_points);
  for (Index p = 0; p < num_points; ++p) {
    for (Index k = 0; k < kInfluences; ++k) {
      // Of kInfluences neighbouring control points, as local coordinates have it.
      const auto first = static_cast<Index>(std::int64_t(p) * kControlPoints / num_points);
      weights((first + k) % kControlPoints, p) = static_cast<double>(random() % 1000 + 1) / 8000;
    }
  }
  const PointList<3> pose = PointList<3>::Random(3, kControlPoints);
  const SparseWeights sparse(weights);
  const double points = num_points;
  PointList<3> moved;
  const double dense_seconds = best_seconds([&] { moved = deform<3>(weights, pose); });
  const double sparse_seconds = best_seconds([&] { moved = deform<3>(sparse, pose); });
  const double result = 3 * points * sizeof(double);
  return table.line(row_of(copy, "deform: 110 weights per point",
                           points * kControlPoints * sizeof(double) + result, dense_seconds)) +
         table.line(row_of(copy, "deform: 8 influences per point",
                           points * kInfluences * (sizeof(double) + sizeof(std::uint32_t)) +
                               points * sizeof(std::int64_t) + result,
                           sparse_seconds));
}

}  // namespace

bool run_bandwidth(const Context& context) {
  ResultTable table(context, "bandwidth", columns());
  table.add(in_child("bandwidth: deform", [&]() -> std::string {
    omp_set_num_threads(context.threads);
    return measure_deform(table, copy_bandwidth(), context.quick ? 10000 : 1000000);
  }));
  for (const auto& [name, vertices] : {std::pair{"woody", 100000}, std::pair{"horse", 40000}}) {
    const auto& chosen = model(name);
    table.add(in_setting(context, "bandwidth", chosen, context.size(chosen.dim, vertices),
                         [&](const auto& setting) {
                           return table.line(measure_gradient(context, setting, copy_bandwidth()));
                         }));
  }
  return table.write(
      "the fewest bytes that have to be moved, beside copying large arrays; the best "
      "of "
      "5 runs");
}

}  // namespace flbc::bench

// SPDX-License-Identifier: BSD-3-Clause
#include "paper/references.h"

#include <filesystem>
#include <optional>
#include <ostream>

#include <nlohmann/json.hpp>

#include "paper/content_hash.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "flbc/solver.h"

namespace flbc::bench {
namespace {

using nlohmann::json;

// Everything the optimum depends on, and how it was computed. phi is there so that a change in how
// the library measures distances makes old references stale.
template <int Dim>
json key_of(const Setting<Dim>& setting, const SolverOptions& options) {
  const auto& problem = setting.problem;
  const auto hash = content_hash(problem.cage.points, problem.cage.facets, problem.mesh.points,
                                 problem.mesh.cells, problem.phi.dense());
  return {{"format", 1},
          {"model", setting.model.name},
          {"control_points", problem.num_control_points()},
          {"vertices", problem.mesh.num_vertices()},
          {"problem_hash", hash.text()},
          {"method", "value"},
          {"precision", "double"},
          {"non_negative", true},
          {"tolerance", *options.tolerance},
          {"max_iterations", options.max_iterations}};
}

std::optional<Reference> load(const std::string& path, const json& key) {
  if (!std::filesystem::exists(path + ".json")) return std::nullopt;
  try {
    const auto entry = json::parse(io::read_file(path + ".json"));
    if (entry.at("key") != key) return std::nullopt;
    auto weights = io::read_weights(path + ".npy");
    if (content_hash(weights).text() != entry.at("weights_hash").get<std::string>())
      return std::nullopt;
    return Reference{std::move(weights), entry.at("relative_gap").get<double>()};
  } catch (const std::exception&) {  // damaged: as if it were not there
    return std::nullopt;
  }
}

}  // namespace

SolverOptions optimum_options(const Context& context, NonNegative non_negative) {
  SolverOptions options;
  options.method = Method::kValue;
  options.precision = Precision::kDouble;
  options.non_negative = non_negative;
  // The estimate is too good in the long tail: at 1e-14 the error is some 1e-11 (see README.md).
  options.tolerance = context.quick ? 1e-9 : 1e-14;
  options.max_iterations = context.quick ? 1000 : 3000;
  options.certify = true;
  options.threads = context.threads;
  return options;
}

template <int Dim>
Reference reference(const Context& context, const Setting<Dim>& setting) {
  const auto options = optimum_options(context, NonNegative::kConstraint);
  const auto key = key_of(setting, options);
  const auto folder = context.out + "/references";
  const auto path = folder + "/" + setting.model.name + "-" +
                    std::to_string(setting.wanted_vertices) + (context.quick ? "-quick" : "");
  if (auto found = load(path, key)) return std::move(*found);

  const auto solution = solve(setting.problem, options);
  const auto& report = solution.report;
  const json entry{{"key", key},
                   {"weights_hash", content_hash(solution.weights).text()},
                   {"converged", report.status == SolveStatus::kConverged},
                   {"iterations", report.iterations},
                   {"seconds", report.seconds.solve + report.seconds.recover},
                   {"objective", report.certificate.objective},
                   {"lower_bound", report.certificate.lower_bound},
                   {"relative_gap", report.certificate.relative_gap}};
  std::filesystem::create_directories(folder);
  io::write_weights(path + ".npy", solution.weights);
  io::write_file(path + ".json", [&](std::ostream& file) { file << entry.dump(2) << '\n'; });
  return {solution.weights, report.certificate.relative_gap};
}

template Reference reference(const Context&, const Setting<2>&);
template Reference reference(const Context&, const Setting<3>&);

}  // namespace flbc::bench

// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_json.h"

#include <nlohmann/json.hpp>

#include "flbc/report.h"
#include "flbc/version.h"
#include "front/facts.h"

namespace flbc::app {

namespace {

nlohmann::ordered_json levels_json(const std::vector<LevelReport>& levels) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& level : levels) {
    json.push_back({{"vertices", level.vertices},
                    {"cells", level.cells},
                    {"iterations", level.iterations},
                    {"seconds", {{"solve", level.solve_seconds}}}});
  }
  return json;
}

// As published: what was given, or what the method always takes; 0 = chosen from the mesh.
double penalty_asked_for(const SolveReport& report, const SolveSettings& settings) {
  const bool is_fixed = report.method == Method::kGradient || report.method == Method::kPaper;
  return is_fixed && !settings.penalty ? report.published_penalty : settings.penalty.value_or(0);
}

// All options used: those left to the method are given as it chose them.
nlohmann::ordered_json options_json(const SolveReport& report, const SolveSettings& settings,
                                    const SolverOptions& options) {
  const auto& given = settings.options;
  return {{"cage", settings.cage},
          {"domain", settings.domain},
          {"model", settings.model},
          {"embed", settings.embed},
          {"outside", name_of(settings.outside)},
          {"vertices", settings.vertices},
          {"mesher", settings.meshing.mesher},
          {"method", name_of_method(settings, given.method)},
          {"non_negative", name_of(options.non_negative)},
          {"certify", options.certify},
          {"phi", settings.phi.empty() ? name_of(options.phi) : settings.phi},
          {"smoothness", *options.smoothness},
          {"distances", name_of(options.distances)},
          {"precision", name_of(options.precision)},
          {"tolerance", *options.tolerance},
          {"gap", *options.gap},
          {"max_iterations", options.max_iterations},
          {"penalty", penalty_asked_for(report, settings)},
          {"threads", options.threads}};
}

void add_certificate(const SolveReport& report, nlohmann::ordered_json& json) {
  if (!is_certified(report)) return;
  json["lower_bound"] = report.certificate.lower_bound;
  json["certified_objective"] = report.certificate.objective;
  json["relative_gap"] = report.certificate.relative_gap;
}

}  // namespace

bool is_certified(const SolveReport& report) {
  return report.certificate.objective > 0;
}

std::string describe_proof(const SolveReport& report) {
  Facts facts;
  facts << "proven to be at most " << 100 * report.certificate.relative_gap
        << "% above the minimum";
  if (report.criterion != Criterion::kGap) facts << " (a smaller --tolerance tightens the proof)";
  return facts.text();
}

std::string describe_iterations(const SolveReport& report, const SolveSettings& settings) {
  const auto text = std::string(report.parts.empty() ? "" : "at most ") +
                    std::to_string(report.iterations) + " iterations";
  if (report.criterion == Criterion::kGap) return text + ", ended by the certified gap";
  const bool is_guess = report.criterion == Criterion::kTolerance && is_ambiguous(settings);
  return is_guess ? text + ", ended by the estimated error" : text;
}

nlohmann::ordered_json part_json(const SolveReport& report, Index first_control_point) {
  nlohmann::ordered_json json{{"first_control_point", first_control_point},
                              {"control_points", report.control_points},
                              {"vertices", report.vertices},
                              {"cells", report.cells},
                              {"iterations", report.iterations},
                              {"status", name_of(report.status)},
                              {"criterion", name_of(report.criterion)},
                              {"objective", report.objective}};
  add_certificate(report, json);
  json["seconds"] =
      report.seconds.setup + report.seconds.solve + report.seconds.recover + report.seconds.certify;
  return json;
}

nlohmann::ordered_json report_json(const SolveReport& report, const SolveSettings& settings,
                                   const RunContext& context) {
  // The penalty has another unit, but other options depend on whether it is set.
  auto given = settings.options;
  given.penalty = settings.penalty;
  if (settings.coordinates) given.method = Method::kPaper;  // which chooses as little
  const auto options = resolve(given);
  nlohmann::ordered_json json;
  json["method"] = name_of_method(settings, report.method);
  json["dim"] = context.dim;
  json["mesher"] = context.mesher;
  json["control_points"] = report.control_points;
  json["vertices"] = report.vertices;
  json["cells"] = report.cells;
  json["iterations"] = report.iterations;
  json["converged"] = report.status == SolveStatus::kConverged;
  json["status"] = name_of(report.status);
  json["criterion"] = name_of(report.criterion);
  json["relative_primal_residual"] = report.relative_primal_residual;
  json["relative_dual_residual"] = report.relative_dual_residual;
  json["objective"] = report.objective;
  add_certificate(report, json);
  json["seconds"] = {{"mesh", context.mesh_seconds},
                     {"setup", report.seconds.setup},
                     {"solve", report.seconds.solve},
                     {"recover", report.seconds.recover},
                     {"certify", report.seconds.certify}};
  json["distances"] = {{"source", name_of(report.distances.source)},
                       {"vertices", report.distances.vertices},
                       {"phi_error", report.distances.phi_error}};
  json["active_set"] = {{"density", report.active_set.density},
                        {"growths", report.active_set.growths}};
  json["coarse_levels"] = levels_json(report.coarse_levels);
  json["mesh_error"] = report.mesh_error;
  json["min_weight"] = context.delivered.min_weight;
  json["max_partition_error"] = context.delivered.max_partition_error;
  json["max_reproduction_error"] = context.delivered.max_reproduction_error;
  json["mean_influences"] = context.delivered.mean_influences;
  json["penalty"] = report.published_penalty;
  json["numbers_per_cell"] = report.state_scalars_per_cell;
  json["version"] = FLBC_VERSION;
  json["options"] = options_json(report, settings, options);
  return json;
}

std::string to_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace flbc::app

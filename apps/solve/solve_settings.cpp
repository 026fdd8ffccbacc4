// SPDX-License-Identifier: BSD-3-Clause
#include "solve/solve_settings.h"

#include "flbc/errors.h"
#include "flbc/io/formats.h"
#include "flbc/report.h"
#include "help/options.h"

namespace flbc::app {

bool is_meshless(const SolveSettings& settings) {
  return settings.coordinates && is_pointwise(*settings.coordinates) && !settings.model.empty() &&
         !settings.needs_domain;
}

bool is_ambiguous(const SolveSettings& settings) {
  const auto& options = settings.options;
  const bool smooths = options.method == Method::kWeights || options.method == Method::kGradient;
  return smooths && !settings.coordinates && *resolve(options).smoothness == 0;
}

void validate_settings(const SolveSettings& settings) {
  const auto& options = settings.options;
  if (!settings.coordinates) return validate(options);
  validate(*settings.coordinates, {options.non_negative, options.threads});
}

const char* name_of_method(const SolveSettings& settings, Method method) {
  return settings.coordinates ? name_of(*settings.coordinates) : name_of(method);
}

void add_mesher_options(CLI::App& command, MesherSettings& settings) {
  add_choice(command, "--mesher", {"auto", "cgal", "tetgen", "netgen"}, settings.mesher,
             "mesher (default: auto, which is CGAL in 2D and TetGen in 3D, then Netgen if TetGen "
             "fails)");
  command
      .add_option("--mesh-timeout", settings.timeout,
                  "time limit of a mesher run in seconds (default: 60)")
      ->check(CLI::PositiveNumber);
}

void refuse_unread_options(const CLI::App& command, const SolveSettings& settings) {
  const auto refuse = [&](const std::string& option, const std::string& reason) {
    if (command.count(option) > 0)
      throw OptionError(option + ": " + reason + "; leave out this option");
  };
  const Method method = settings.options.method;
  const auto name = std::string("the method ") + name_of_method(settings, method);
  if (settings.coordinates) {
    for (const char* option :
         {"--phi", "--smoothness", "--distances", "--precision", "--tolerance", "--gap",
          "--max-iterations", "--penalty", "--certify", "--locality"}) {
      refuse(option, name + " does not use it");
    }
  }
  if (method != Method::kWeights) refuse("--locality", name + " does not use it");
  if (is_meshless(settings)) {
    for (const char* option : {"--domain", "--vertices", "--embed", "--mesher", "--mesh-timeout"}) {
      refuse(option, name + " needs no mesh for the weights of a model");
    }
  }
  if (settings.model.empty()) refuse("--outside", "no model is given");
  if (!settings.phi.empty() && settings.domain.empty()) {
    throw OptionError("--phi: the rows of " + settings.phi +
                      " are for the cells of a mesh; make one by flbc mesh, and name it by "
                      "--domain of flbc solve");
  }
  if (!settings.phi.empty()) refuse("--distances", "--phi gives a file of phi");
  if (!settings.domain.empty()) {
    refuse("--mesher", "--domain gives the mesh");
    refuse("--mesh-timeout", "--domain gives the mesh");
  }
}

namespace {

// Its names, or a file.
void add_phi(CLI::App& command, SolveSettings& settings) {
  auto words = names_of<DistanceScheme>();
  const auto offered = CLI::detail::join(words, "|");
  const auto take = [&settings, offered](const std::string& text) {
    if (const auto scheme = value_named<DistanceScheme>(text)) {
      settings.options.phi = *scheme;
    } else if (io::holds(text, {io::Content::kWeights})) {
      settings.phi = text;
    } else {
      throw CLI::ValidationError("--phi", "invalid value '" + text + "'; choose from " + offered +
                                              ", or name a file that ends in .npy, .mtx or .csv");
    }
  };
  command
      .add_option_function<std::string>(
          "--phi", take,
          "how far weights reach, from square (nearest) to constant (farthest) (default: square), "
          "or a file of phi >= 0: a row per cell of --domain and a column per control point")
      ->type_name(offered);
}

}  // namespace

void add_solver_options(CLI::App& command, SolveSettings& settings) {
  auto& options = settings.options;
  command.option_defaults()->group("Solver");
  auto methods = names_of<Method>();
  for (const auto& name : names_of<Coordinates>()) methods.push_back(name);
  const auto take = [&settings](const std::string& name) {
    settings.coordinates = value_named<Coordinates>(name);
    settings.options.method = value_named<Method>(name).value_or(Method::kAuto);
  };
  auto* method = add_choice(
      command, "--method", methods, take,
      "coordinates and solver (default: weights). Local coordinates: weights, gradient, paper, "
      "lbc2014. All others are other coordinates, for comparison");
  // The name in 0.1, which scripts use.
  method->transform([](std::string name) { return name == "value" ? "weights" : name; });
  // Green coordinates are refused with the reason, so help does not offer them.
  const auto offered = method->get_type_name();
  method->type_name(offered.substr(0, offered.find("|green")));
  command.add_option("--smoothness", options.smoothness,
                     "remove kinks of the weights at the cost of more influences: 0 (none, the "
                     "problem of the papers) to 0.03 (default: 0.003; 0 for paper and lbc2014)");
  command.add_option("--tolerance", options.tolerance,
                     "target for the estimated mean squared error of the weights, or for the "
                     "residuals of paper and lbc2014 (default: 1e-6; 1e-8 with --certify; 1e-7 for "
                     "paper and lbc2014; none with --smoothness 0, see --gap)");
  command.add_flag("--certify", options.certify,
                   "prove by how much the objective can exceed its minimum");
  command.add_option("--threads", options.threads, "number of threads (default: all cores)");
  command.option_defaults()->group(kMore);
  add_choice(command, "--outside", settings.outside,
             "method for model vertices outside the cage (default: fail). nearest: follow the "
             "nearest point of the cage at a constant offset. keep: stay where they are, without "
             "weights. extend: reproduce the vertex, possibly with negative weights");
  add_choice(command, "--non-negative", options.non_negative,
             "method that keeps weights non-negative (default: depends on --method)");
  add_phi(command, settings);
  command.add_option(
      "--locality", settings.locality,
      "a .json file of masks, which are control points and the regions that they "
      "must not move (their weights there become exactly 0), of reach, how far weights "
      "extend, and of falloff, a band in which they fade out before a mask");
  add_choice(command, "--distances", options.distances,
             "compute distances on the mesh, or interpolate them from a coarser one (default: "
             "auto)");
  add_choice(command, "--precision", options.precision,
             "floating-point precision of the iteration (default: auto, which is single)");
  command.add_option(
      "--gap", options.gap,
      "certified relative gap of the objective that also ends the iteration, 0 for none (default: "
      "0; 1e-3 with --smoothness 0 and without --tolerance)");
  command.add_option("--max-iterations", options.max_iterations,
                     "maximum number of iterations (default: 20000)");
  command.add_option("--penalty", settings.penalty,
                     "penalty parameter for a domain scaled to radius 250, as published (default: "
                     "depends on --method)");
  add_mesher_options(command, settings.meshing);
}

}  // namespace flbc::app

// SPDX-License-Identifier: BSD-3-Clause
#include "solve/solve_settings.h"

#include "flbc/errors.h"
#include "flbc/names.h"

namespace flbc::app {
namespace {

// A named choice, shown in the help by its names only.
template <class Enum>
void add_choice(CLI::App& command, const std::string& name, Enum& value, const std::string& help) {
  std::string names;
  for (const auto& choice : names_of<Enum>()) names += (names.empty() ? "" : "|") + choice;
  command
      .add_option_function<std::string>(
          name,
          [&value, name, names](const std::string& text) {
            const auto found = value_named<Enum>(text);
            if (!found) throw CLI::ValidationError(name, "'" + text + "' is none of " + names);
            value = *found;
          },
          help)
      ->type_name(names);
}

}  // namespace

void add_mesher_options(CLI::App& command, MesherSettings& settings) {
  command
      .add_option_function<std::string>(
          "--mesher",
          [&settings](const std::string& text) {
            for (const Mesher mesher :
                 {Mesher::kAuto, Mesher::kCgal, Mesher::kTetgen, Mesher::kNetgen}) {
              if (text != name_of(mesher)) continue;
              settings.mesher = mesher;
              return;
            }
            throw CLI::ValidationError("--mesher",
                                       "'" + text + "' is none of auto|cgal|tetgen|netgen");
          },
          "who fills the cage with cells (auto: CGAL in 2D; TetGen in 3D, and Netgen where that "
          "fails)")
      ->type_name("auto|cgal|tetgen|netgen");
  command
      .add_option("--mesh-timeout", settings.timeout,
                  "seconds after which a run of the mesher is stopped (60)")
      ->check(CLI::PositiveNumber);
}

void refuse_unread_options(const CLI::App& command, const SolveSettings& settings) {
  const auto refuse = [&](const std::string& option, const std::string& reason) {
    if (command.count(option) > 0) throw OptionError(option + ": " + reason + "; leave it out");
  };
  const Method method = settings.options.method;
  const bool gradients = method == Method::kGradient || method == Method::kPaper;
  const std::string name = std::string("the method ") + name_of(method);
  if (method == Method::kHarmonic || method == Method::kMeanValue) {
    for (const char* option : {"--phi", "--distances", "--linear-solver", "--precision",
                               "--coarse-to-fine", "--active", "--tolerance", "--gap", "--max-iterations",
                               "--penalty", "--relaxation"}) {
      refuse(option, name + " does not read it");
    }
  }
  if (method != Method::kAuto && method != Method::kValue) {
    refuse("--active", name + " does not read it");
  }
  if (!gradients) refuse("--recovery", name + " does not read it");
  if (method == Method::kPaper) refuse("--coarse-to-fine", name + " does not read it");
  if (settings.model.empty()) refuse("--outside", "there is no model");
  if (!settings.domain.empty()) {
    refuse("--mesher", "with --domain nothing is meshed");
    refuse("--mesh-timeout", "with --domain nothing is meshed");
  }
}

void add_solver_options(CLI::App& command, SolveSettings& settings) {
  auto& options = settings.options;
  add_choice(command, "--method", options.method, "how to solve (auto)");
  add_choice(command, "--non-negative", options.non_negative,
             "what becomes of negative weights (by method)");
  add_choice(command, "--coarse-to-fine", options.coarse_to_fine,
             "start from coarser meshes of the cage (auto: where it pays)");
  command.add_flag("--certify", options.certify, "prove how near the optimum the weights are");
  add_choice(command, "--phi", options.phi, "growth of the distance weights (square)");
  add_choice(
      command, "--active", options.active_pairs,
      "work only on pairs of points and control points whose weights may be positive (auto: in "
      "3D from 80 control points on, unless --certify)");
  add_choice(command, "--distances", options.distances,
             "where distances are computed: on the mesh, or on a coarser one of the cage (auto)");
  add_choice(command, "--linear-solver", options.linear_solver,
             "how global systems are solved; none: gradient and paper do without (auto)");
  add_choice(command, "--recovery", options.recovery, "how weights follow from gradients (auto)");
  add_choice(command, "--precision", options.precision,
             "numbers of the iteration (auto: half where the tolerance allows)");
  command.add_option("--tolerance", options.tolerance,
                     "accuracy wanted (by method: gradient 1e-6, others 1e-7)");
  command.add_option(
      "--gap", options.gap,
      "certified relative gap that ends the iteration as well, 0 for none (1e-3 with "
      "the methods' own tolerances)");
  command.add_option("--max-iterations", options.max_iterations, "limit of iterations (20000)");
  command.add_option("--penalty", settings.penalty,
                     "penalty of the augmented Lagrangian, as published: for a domain scaled to "
                     "radius 250 (by method)");
  command.add_option("--relaxation", options.relaxation, "over-relaxation in (0, 2) (by method)");
  add_choice(command, "--outside", settings.outside,
             "what becomes of the model's vertices outside the cage: nearest: weights of the "
             "nearest point of the cage; extend: those and an affine function of the offset, which "
             "reproduce the vertex but may be negative (fail)");
  add_mesher_options(command, settings.meshing);
  command.add_option("--threads", options.threads, "number of threads (all)");
  command.add_flag("--history", settings.history,
                   "keep errors, residuals and objective by iteration in the report (flbc plot)");
}

}  // namespace flbc::app

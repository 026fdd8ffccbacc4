// SPDX-License-Identifier: BSD-3-Clause
#include "solve/solve_settings.h"

#include <map>

namespace flbc::app {
namespace {

const std::map<std::string, Method> kMethods{
    {"auto", Method::kAuto},          {"value", Method::kValue},
    {"gradient", Method::kGradient},  {"paper", Method::kPaper},
    {"lbc2014", Method::kLbc2014},    {"harmonic", Method::kHarmonic},
    {"meanvalue", Method::kMeanValue}};
const std::map<std::string, CoarseToFine> kCoarseToFine{
    {"auto", CoarseToFine::kAuto}, {"on", CoarseToFine::kOn}, {"off", CoarseToFine::kOff}};
const std::map<std::string, NonNegative> kNonNegative{{"auto", NonNegative::kAuto},
                                                      {"constraint", NonNegative::kConstraint},
                                                      {"project", NonNegative::kProject},
                                                      {"off", NonNegative::kOff}};
const std::map<std::string, DistanceScheme> kSchemes{{"square", DistanceScheme::kSquare},
                                                     {"linear", DistanceScheme::kLinear},
                                                     {"sqrt", DistanceScheme::kSquareRoot},
                                                     {"constant", DistanceScheme::kConstant}};
const std::map<std::string, Recovery> kRecoveries{{"auto", Recovery::kAuto},
                                                  {"breadth-first", Recovery::kBreadthFirst},
                                                  {"least-squares", Recovery::kLeastSquares}};
const std::map<std::string, Precision> kPrecisions{{"single", Precision::kSingle},
                                                   {"double", Precision::kDouble}};

// A named choice, shown in the help by its names only.
template <class Enum>
void add_choice(CLI::App& command, const std::string& name, Enum& value,
                const std::map<std::string, Enum>& choices, const std::string& help) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.first;
  command
      .add_option_function<std::string>(
          name,
          [&value, &choices, name, names](const std::string& text) {
            const auto found = choices.find(text);
            if (found == choices.end()) {
              throw CLI::ValidationError(name, "'" + text + "' is none of " + names);
            }
            value = found->second;
          },
          help)
      ->type_name(names);
}

}  // namespace

const char* name_of(CoarseToFine choice) {
  return choice == CoarseToFine::kAuto ? "auto" : choice == CoarseToFine::kOn ? "on" : "off";
}

void add_solver_options(CLI::App& command, SolveSettings& settings) {
  auto& options = settings.options;
  add_choice(command, "--method", options.method, kMethods, "how to solve (auto)");
  add_choice(command, "--non-negative", options.non_negative, kNonNegative,
             "what becomes of negative weights (by method)");
  add_choice(command, "--coarse-to-fine", settings.coarse_to_fine, kCoarseToFine,
             "start from coarser meshes of the cage (auto: where it pays)");
  command.add_flag("--certify", options.certify, "prove how near the optimum the weights are");
  add_choice(command, "--phi", options.phi, kSchemes, "growth of the distance weights (square)");
  add_choice(command, "--recovery", options.recovery, kRecoveries,
             "how weights follow from gradients (auto)");
  add_choice(command, "--precision", options.precision, kPrecisions,
             "arithmetic of the iteration (single)");
  command.add_option(
      "--tolerance", options.tolerance,
      "accuracy wanted (by method: value and paper 1e-7, gradient 2.5e-5, lbc2014 5e-8)");
  command.add_option("--max-iterations", options.max_iterations, "limit of iterations (20000)");
  command.add_option("--penalty", options.penalty,
                     "penalty of the augmented Lagrangian (by method)");
  command.add_option("--relaxation", options.relaxation, "over-relaxation in (0, 2) (by method)");
  command.add_option("--threads", options.threads, "number of threads (all)");
  command.add_option("--cache", settings.cache,
                     "keep weights in this folder, and take them from there if the numbers of "
                     "cage and mesh and all options are the same");
}

}  // namespace flbc::app

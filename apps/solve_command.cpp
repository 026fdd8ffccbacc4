// SPDX-License-Identifier: BSD-3-Clause
// flbc solve: from a cage to coordinates.
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <memory>

#include "commands.h"
#include "domain_formats.h"
#include "exit_status.h"
#include "flbc/coarse_to_fine.h"
#include "flbc/coordinates.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "flbc/solver.h"
#include "held_signals.h"
#include "load.h"
#include "make_domain.h"
#include "progress_bar.h"
#include "report_json.h"

namespace flbc::app {
namespace {

enum class CoarseToFine { kAuto, kOn, kOff };

const char* name_of(CoarseToFine choice) {
  return choice == CoarseToFine::kAuto ? "auto" : choice == CoarseToFine::kOn ? "on" : "off";
}

struct SolveArguments {
  std::string cage;
  std::string output;
  std::string domain;
  std::string model;
  bool embed = false;
  std::string save_domain;
  std::string report;
  Index vertices = 0;
  bool quiet = false;
  bool verbose = false;
  CoarseToFine coarse_to_fine = CoarseToFine::kAuto;
  SolverOptions options;
};

void check_outputs(const SolveArguments& arguments) {
  require_writable(arguments.output, {"mtx", "dmat", "npy"});
  if (arguments.report != "-") require_writable(arguments.report, {"json"});
  require_distinct({arguments.cage, arguments.domain, arguments.model},
                   {arguments.output, arguments.save_domain, arguments.report});
}

// The mesh, from a file or made of the cage, and the seconds that took.
template <int Dim>
DomainMesh<Dim> get_domain(const Cage<Dim>& cage, const PointList<Dim>& model,
                           const SolveArguments& arguments, double& seconds) {
  const auto start = std::chrono::steady_clock::now();
  auto domain = !arguments.domain.empty()
                    ? io::read_domain<Dim>(arguments.domain)
                    : make_domain(arguments.cage, cage, arguments.vertices,
                                  arguments.embed ? arguments.model : "", model);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return domain;
}

// Where the model's vertices are in the mesh; found before the solve, so that a model outside its
// cage is refused at once.
template <int Dim>
std::vector<Location<Dim>> place_model(const DomainMesh<Dim>& domain, const PointList<Dim>& model,
                                       const SolveArguments& arguments) {
  if (arguments.model.empty() || arguments.embed) return {};
  return naming(arguments.model, [&] { return locate_points(domain, model); });
}

// The rows to deliver: the model's vertices, embedded or interpolated, or all of the mesh.
template <int Dim>
WeightMatrix select_rows(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                         const WeightMatrix& weights, const PointList<Dim>& model,
                         const std::vector<Location<Dim>>& places,
                         const SolveArguments& arguments) {
  if (arguments.model.empty()) return weights;
  if (arguments.embed) return weights.middleCols(cage.size(), model.cols());
  return interpolate(domain, weights, places);
}

// Starts from coarser meshes where that pays and a mesher was built in.
template <int Dim>
Solution solve_domain(const Cage<Dim>& cage, const DomainMesh<Dim>& domain,
                      const SolverOptions& options, CoarseToFine coarse_to_fine) {
  const auto mesher = coarse_mesher<Dim>();
  CoarseLevels levels;
  if (coarse_to_fine == CoarseToFine::kOn) {
    constexpr Index kCoarsest = 500;
    levels.coarsest = kCoarsest;
    if (!mesher) {
      throw OptionError("--coarse-to-fine on: this flbc was built without a mesher for " +
                        std::to_string(Dim) + "D");
    }
  }
  if (coarse_to_fine == CoarseToFine::kOff || !mesher) return solve(cage, domain, options);
  return solve_coarse_to_fine(cage, domain, mesher, options, levels);
}

void print_summary(const SolveArguments& arguments, const SolveReport& report, int dim,
                   const Quality& delivered) {
  std::cerr << arguments.output << ": " << report.control_points << " control points, "
            << report.vertices << " vertices, " << report.cells
            << (dim == 2 ? " triangles; " : " tetrahedra; ") << report.iterations << " iterations, "
            << report.seconds.solve << " s; minimum weight " << delivered.min_weight
            << ", reproduction error " << delivered.max_reproduction_error;
  if (arguments.options.certify) {
    std::cerr << ", within " << 100 * report.certificate.relative_gap << " % of the optimum";
  }
  std::cerr << '\n';
}

template <int Dim>
int solve_cage(const Cage<Dim>& cage, const SolveArguments& arguments) {
  require_domain_writable<Dim>(arguments.save_domain);
  PointList<Dim> model;
  if (!arguments.model.empty()) model = load_model<Dim>(arguments.model);

  RunContext context;
  context.dim = Dim;
  context.cage = arguments.cage;
  context.domain = arguments.domain;
  context.model = arguments.model;
  context.embed = arguments.embed;
  context.wanted_vertices = arguments.vertices;
  context.coarse_to_fine = name_of(arguments.coarse_to_fine);
  const auto domain = get_domain(cage, model, arguments, context.mesh_seconds);
  const auto places = place_model(domain, model, arguments);

  auto options = arguments.options;
  Solution solution;
  {
    ProgressBar bar(arguments.quiet);
    options.progress = [&](const Progress& progress) {
      bar.show(progress);
      return true;
    };
    solution = naming(arguments.domain.empty() ? arguments.cage : arguments.domain, [&] {
      return solve_domain(cage, domain, options, arguments.coarse_to_fine);
    });
  }
  const auto rows = select_rows(cage, domain, solution.weights, model, places, arguments);
  context.delivered =
      measure_quality(cage.points, arguments.model.empty() ? domain.points : model, rows);
  const auto json = report_json(solution.report, options, context);
  {
    const HeldSignals held;
    io::write_weights(arguments.output, rows);
    if (!arguments.save_domain.empty()) io::write_domain(arguments.save_domain, domain);
    if (!arguments.report.empty()) {
      io::write_file(arguments.report, [&](std::ostream& file) { file << json; });
    }
  }
  if (arguments.verbose) std::cerr << json;
  if (!arguments.quiet) {
    print_summary(arguments, solution.report, Dim, context.delivered);
  }
  if (solution.report.status == SolveStatus::kConverged) return kDone;
  std::cerr << "flbc: not converged within " << arguments.options.max_iterations
            << " iterations; the result was written nevertheless (see --max-iterations)\n";
  return kNotConverged;
}

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
CLI::Option* add_choice(CLI::App& command, const std::string& name, Enum& value,
                        const std::map<std::string, Enum>& choices, const std::string& help) {
  std::string names;
  for (const auto& choice : choices) names += (names.empty() ? "" : "|") + choice.first;
  return command
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

void add_solve_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<SolveArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("solve", "Compute the coordinates of a cage");
  command->add_option("CAGE", a.cage, "closed polylines (2D) or surface (3D)")->required();
  command
      ->add_option("-o,--output", a.output,
                   "weights, a row per point and a column per control point: .mtx, .dmat or .npy")
      ->required();
  auto* vertices =
      command->add_option("--vertices", a.vertices, "number of mesh vertices wanted (10000)")
          ->check(refuse_vertex_count);
  auto* domain = command->add_option("--domain", a.domain, "use this mesh of the interior");
  auto* model = command->add_option("--model", a.model, "write weights at this model's vertices");
  auto* embed = command->add_flag("--embed", a.embed, "make the model's vertices mesh vertices")
                    ->needs(model);
  domain->excludes(vertices)->excludes(embed);
  command->add_option("--save-domain", a.save_domain, domain_formats_help());
  command->add_option("--report", a.report, "write what happened to this .json file");
  add_choice(*command, "--method", a.options.method, kMethods, "how to solve (auto)");
  add_choice(*command, "--non-negative", a.options.non_negative, kNonNegative,
             "what becomes of negative weights (by method)");
  add_choice(*command, "--coarse-to-fine", a.coarse_to_fine, kCoarseToFine,
             "start from coarser meshes of the cage (auto: where it pays)");
  command->add_flag("--certify", a.options.certify, "prove how near the optimum the weights are");
  add_choice(*command, "--phi", a.options.phi, kSchemes, "growth of the distance weights (square)");
  add_choice(*command, "--recovery", a.options.recovery, kRecoveries,
             "how weights follow from gradients (auto)");
  add_choice(*command, "--precision", a.options.precision, kPrecisions,
             "arithmetic of the iteration (single)");
  command->add_option("--tolerance", a.options.tolerance,
                      "accuracy wanted (by method: value 1e-6, gradient 3e-5, others 1e-7)");
  command->add_option("--max-iterations", a.options.max_iterations, "limit of iterations (20000)");
  command->add_option("--penalty", a.options.penalty,
                      "penalty of the augmented Lagrangian (by method)");
  command->add_option("--relaxation", a.options.relaxation,
                      "over-relaxation in (0, 2) (by method)");
  command->add_option("--threads", a.options.threads, "number of threads (all)");
  command->add_flag("-q,--quiet", a.quiet, "print nothing but errors");
  command->add_flag("-v,--verbose", a.verbose, "print the report");
  command->callback([arguments, &exit_status] {
    validate(arguments->options);
    check_outputs(*arguments);
    const auto cage = load_cage(arguments->cage);
    exit_status = std::visit([&](const auto& any) { return solve_cage(any, *arguments); }, cage);
  });
}

}  // namespace flbc::app

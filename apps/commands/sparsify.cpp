// SPDX-License-Identifier: BSD-3-Clause
// flbc sparsify: few influences per point.
#include <chrono>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/placement.h"
#include "flbc/sparsify.h"
#include "flbc/version.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/movable_model.h"
#include "front/poses.h"
#include "help/options.h"
#include "report/report_json.h"
#include "report/sparsify_report.h"
#include "solve/progress_bar.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

struct SparsifyArguments {
  BindingFiles files;
  std::string points;
  std::string output;
  std::vector<std::string> poses;
  std::string report;
  std::string reduction = kAutomatic;
  bool quiet = false;
  SparsifyOptions options;
};

void check_files(const SparsifyArguments& arguments) {
  require_writable(arguments.output, {io::Content::kWeights});
  if (arguments.report != "-") require_writable(arguments.report, "json");
  auto inputs = arguments.poses;
  inputs.insert(inputs.end(), {arguments.files.weights, arguments.files.cage, arguments.points});
  require_distinct(inputs, {arguments.output, arguments.report});
}

// The binding of the vertices of a domain mesh or a model.
template <int Dim>
Binding<Dim> load(const SparsifyArguments& arguments) {
  const auto& path = arguments.points;
  if (path.empty()) return load_binding<Dim>(arguments.files);
  const MovedFile same{path, path};
  if (io::holds(path, kMeshFiles)) require_formats_of<Dim>(same);
  const MovableModel<Dim> model(same);
  auto binding = load_binding<Dim>(arguments.files, path, model.points(), model.edges(), false);
  if (arguments.files.is_one()) return binding;
  // The result reproduces the vertices, also where the weights do not.
  binding.points = attached_points(binding.cage, model.points(), binding.weights);
  for (Index p = 0; p < binding.offsets.cols(); ++p) {
    if (!binding.weights.has_weights(p)) continue;
    binding.offsets.col(p) = model.points().col(p) - binding.points.col(p);
  }
  return binding;
}

template <int Dim>
void sparsify_weights(const SparsifyArguments& arguments) {
  validate<Dim>(arguments.options);
  const auto& name = arguments.points.empty() ? arguments.files.weights : arguments.points;
  const auto bound = load<Dim>(arguments);
  const auto method = reduction_for(arguments.reduction, name, bound.edges);
  const auto rest = rest_cage_of(arguments.files, bound);
  std::vector<PointList<Dim>> poses;
  for (const auto& path : arguments.poses) poses.push_back(rest.load_pose(path));
  const auto start = std::chrono::steady_clock::now();
  const auto reduced = naming(name, [&] {
    const std::string stage = "reducing influences";
    ProgressBar bar(arguments.quiet, stage);
    auto options = arguments.options;
    options.progress = [&](double done) { bar.show(stage, done); };
    return bound.reduced(options, poses, reduction_named(method));
  });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  Json report{{"method", method},
              {"dim", Dim},
              {"control_points", bound.cage.size()},
              {"points", bound.points.cols()},
              {"seconds", seconds.count()}};
  report["options"] = {{"threshold", arguments.options.threshold}};
  if (arguments.options.max_influences < std::numeric_limits<Index>::max()) {
    report["options"]["max_influences"] = arguments.options.max_influences;
  }
  report["before"] = weights_json(arguments.files.weights, arguments.files.weights, bound);
  {
    const ProgressBar bar(arguments.quiet, "measuring the errors");
    report["error"] = errors_json<Dim>(bound, reduced, poses, arguments.poses);
  }
  report["version"] = FLBC_VERSION;
  write_binding(arguments.output, reduced);
  report["after"] = weights_json(arguments.output, arguments.output, reduced);
  if (!arguments.report.empty()) write_text(arguments.report, to_text(report));
  if (!arguments.quiet) std::cerr << summary_of(report) << '\n';
}

}  // namespace

void add_sparsify_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<SparsifyArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("sparsify", "reduce weights to a few influences per vertex");
  command->footer(
      "The result has weights >= 0 that sum to 1 and reproduce the vertices, even if WEIGHTS do "
      "not.\n"
      "\n"
      "Examples:\n"
      "  flbc sparsify binding.npz -k 4 -o four.npz\n"
      "  flbc sparsify binding.npz -k 8 --pose pose.obj -o eight.npz");
  command->add_option("WEIGHTS", a.files.weights, std::string("weights: ") + kWeightFormats)
      ->required();
  add_cage_option(*command, a.files.cage);
  command->add_option("--points", a.points,
                      "model or mesh whose vertices have these weights; a .npz file has them");
  auto* count = command->add_option("-k,--max-influences", a.options.max_influences,
                                    "maximum influences per vertex, at least 3 in 2D and 4 in 3D");
  auto* threshold = command->add_option(
      "--threshold", a.options.threshold,
      "first drop weights below this value where the others can reproduce the vertex");
  add_reduction_option(*command, a.reduction);
  command->add_option("-o,--output", a.output, std::string("sparse weights: ") + kWeightFormats)
      ->required();
  command
      ->add_option(
          "--pose", a.poses,
          "deformed cage in which to measure the error; poisson also minimizes it (repeatable)")
      ->allow_extra_args(false);
  command->add_option(
      "--report", a.report,
      "write a report of the reduction to this .json file, or to standard output (-)");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments, count, threshold] {
    if (count->count() + threshold->count() == 0) {
      throw OptionError("-k (maximum influences per vertex) or --threshold is missing");
    }
    check_files(*arguments);
    require_cage(arguments->files);
    if (!arguments->files.is_one() && arguments->points.empty()) {
      throw OptionError(arguments->files.weights + ": only .npz files have points; add --points");
    }
    dimension_of(arguments->files) == 2 ? sparsify_weights<2>(*arguments)
                                        : sparsify_weights<3>(*arguments);
  });
}

}  // namespace flbc::app

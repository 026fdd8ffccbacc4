// SPDX-License-Identifier: BSD-3-Clause
// flbc sparsify: few influences per point.
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands/commands.h"
#include "files/load.h"
#include "files/locality_file.h"
#include "files/movable_model.h"
#include "flbc/domain_mesh.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/model_file.h"
#include "flbc/io/weights_io.h"
#include "flbc/placement.h"
#include "flbc/sparsify.h"
#include "flbc/version.h"
#include "poses/poses.h"
#include "report/report_json.h"
#include "report/sparsify_report.h"
#include "solve/progress_bar.h"
#include "solve/weights_of_model.h"
#include "system/held_signals.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

struct SparsifyArguments {
  std::string weights;
  std::string cage;
  std::string points;
  std::string output;
  std::vector<std::string> poses;
  std::string report;
  std::string locality;
  std::string reduction = kAutomatic;
  bool quiet = false;
  SparsifyOptions options;
};

void check_files(const SparsifyArguments& arguments) {
  require_writable(arguments.output, {io::Content::kWeights});
  if (arguments.report != "-") require_writable(arguments.report, "json");
  auto inputs = arguments.poses;
  inputs.insert(inputs.end(),
                {arguments.weights, arguments.cage, arguments.points, arguments.locality});
  require_distinct(inputs, {arguments.output, arguments.report});
}

template <int Dim>
struct ConnectedPoints {
  PointList<Dim> points;
  EdgeList edges;
};

// The vertices of a domain mesh or a model.
template <int Dim>
ConnectedPoints<Dim> load_connected_points(const std::string& path) {
  const MovedFile same{path, path};
  if (io::holds(path, kMeshFiles)) require_formats_of<Dim>(same);
  const MovableModel<Dim> model(same);
  if (model.points().cols() == 0) throw InputError(path + ": the model has no vertices");
  return {model.points(), model.edges()};
}

template <int Dim>
SparseWeights load_weights(const SparsifyArguments& arguments, const PointList<Dim>& control_points,
                           const PointList<Dim>& points) {
  auto weights = io::read_weights(arguments.weights);
  check_sizes(weights, control_points.cols(), points.cols(),
              {arguments.weights, arguments.cage, arguments.points});
  return weights;
}

template <int Dim>
std::vector<PointList<Dim>> poses_of(const SparsifyArguments& arguments) {
  const RestCage<Dim> rest(arguments.cage);
  std::vector<PointList<Dim>> poses;
  for (const auto& path : arguments.poses) poses.push_back(rest.load_pose(path));
  return poses;
}

std::uintmax_t size_of_file(const std::string& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  return error ? 0 : bytes;
}

template <int Dim>
SparseWeights make_sparse(const Cage<Dim>& cage, const ConnectedPoints<Dim>& model,
                          const SparseWeights& weights, const std::vector<PointList<Dim>>& poses,
                          const std::string& method, const SparsifyArguments& arguments) {
  const std::string stage = "reducing influences";
  ProgressBar bar(arguments.quiet, stage);
  auto options = arguments.options;
  options.masks =
      load_locality_inside(arguments.locality, cage, model.points, arguments.points, weights);
  options.progress = [&](double done) { bar.show(stage, done); };
  return reduce_influences<Dim>(cage.points, model.points, model.edges, weights, poses, options,
                                reduction_named(method));
}

template <int Dim>
void sparsify_weights(const Cage<Dim>& cage, const SparsifyArguments& arguments) {
  validate<Dim>(arguments.options);
  const auto model = load_connected_points<Dim>(arguments.points);
  const auto method = reduction_for(arguments.reduction, arguments.points, model.edges);
  const auto before = load_weights(arguments, cage.points, model.points);
  const auto poses = poses_of<Dim>(arguments);
  const ConnectedPoints<Dim> attached{attached_points(cage, model.points, before), model.edges};
  const auto start = std::chrono::steady_clock::now();
  const auto after = naming(arguments.points, [&] {
    return make_sparse<Dim>(cage, attached, before, poses, method, arguments);
  });
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  Json report{{"method", method},
              {"dim", Dim},
              {"control_points", cage.size()},
              {"points", model.points.cols()},
              {"seconds", seconds.count()}};
  report["options"] = {{"threshold", arguments.options.threshold}};
  if (arguments.options.max_influences < std::numeric_limits<Index>::max()) {
    report["options"]["max_influences"] = arguments.options.max_influences;
  }
  report["before"] = weights_json(arguments.weights, size_of_file(arguments.weights), before,
                                  cage.points, attached.points);
  {
    const ProgressBar bar(arguments.quiet, "measuring the errors");
    report["error"] = errors_json<Dim>(
        {cage.points, model.points, model.edges, before, after, poses, arguments.poses});
  }
  report["version"] = FLBC_VERSION;
  {
    const HeldSignals held;
    io::write_weights(arguments.output, after);
    report["after"] = weights_json(arguments.output, size_of_file(arguments.output), after,
                                   cage.points, attached.points);
    if (!arguments.report.empty()) {
      io::write_file(arguments.report, [&](std::ostream& file) { file << to_text(report); });
    }
  }
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
      "  flbc sparsify weights.npy --cage cage.obj --points model.obj -k 8 -o few.mtx\n"
      "  flbc sparsify weights.npy --cage cage.obj --points model.obj -k 4 -o four.mtx");
  command->add_option("WEIGHTS", a.weights, std::string("weights: ") + kWeightFormats)->required();
  command->add_option("--cage", a.cage, "cage of the weights")->required();
  command->add_option("--points", a.points, "model or mesh whose vertices have these weights")
      ->required();
  auto* count = command->add_option("-k,--max-influences", a.options.max_influences,
                                    "maximum influences per vertex, at least 3 in 2D and 4 in 3D");
  auto* threshold = command->add_option(
      "--threshold", a.options.threshold,
      "first drop weights below this value where the others can reproduce the vertex");
  add_reduction_option(*command, a.reduction);
  command->add_option("-o,--output", a.output, std::string("sparse weights: ") + kWeightFormats)
      ->required();
  add_locality_option(*command, a.locality);
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
      throw OptionError("give -k (maximum influences per vertex), --threshold, or both");
    }
    check_files(*arguments);
    std::visit([&](const auto& cage) { sparsify_weights(cage, *arguments); },
               load_cage(arguments->cage));
  });
}

}  // namespace flbc::app

// SPDX-License-Identifier: BSD-3-Clause
// flbc sparsify: few influences per point.
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "exit_status.h"
#include "flbc/coordinates.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/mesh_io.h"
#include "flbc/io/weights_io.h"
#include "flbc/io/weights_triplets.h"
#include "flbc/sparsify.h"
#include "flbc/version.h"
#include "held_signals.h"
#include "load.h"

namespace flbc::app {
namespace {

using Json = nlohmann::ordered_json;

// Of either kind, to measure what sparsity costs.
constexpr int kRandomPoses = 20;

struct SparsifyArguments {
  std::string weights;
  std::string cage;
  std::string points;
  std::string output;
  std::vector<std::string> poses;
  std::string report;
  bool quiet = false;
  SparsifyOptions options;
};

void check_files(const SparsifyArguments& arguments) {
  require_writable(arguments.output, {"mtx", "dmat", "npy"});
  if (arguments.report != "-") require_writable(arguments.report, {"json"});
  auto inputs = arguments.poses;
  inputs.insert(inputs.end(), {arguments.weights, arguments.cage, arguments.points});
  require_distinct(inputs, {arguments.output, arguments.report});
}

// The vertices of a domain mesh or a model, by the file's name.
template <int Dim>
PointList<Dim> load_points(const std::string& path) {
  const auto extension = io::extension_of(path);
  for (const char* domain : {"mesh", "node", "ele", "msh", "vtu"}) {
    if (extension == domain) return io::read_domain<Dim>(path).points;
  }
  return load_model<Dim>(path);
}

template <int Dim>
WeightMatrix load_weights(const SparsifyArguments& arguments, const PointList<Dim>& control_points,
                          const PointList<Dim>& points) {
  if (io::extension_of(arguments.weights) == "txt") {
    return io::read_weight_triplets(arguments.weights, static_cast<Index>(control_points.cols()),
                                    static_cast<Index>(points.cols()));
  }
  auto weights = io::read_weights(arguments.weights);
  if (weights.rows() != control_points.cols()) {
    throw InputError(arguments.weights + ": has weights for " + std::to_string(weights.rows()) +
                     " control points, but " + arguments.cage + " has " +
                     std::to_string(control_points.cols()));
  }
  if (weights.cols() != points.cols()) {
    throw InputError(arguments.weights + ": has weights of " + std::to_string(weights.cols()) +
                     " points, but " + arguments.points + " has " + std::to_string(points.cols()) +
                     " vertices");
  }
  return weights;
}

template <int Dim>
std::vector<PointList<Dim>> load_poses(const SparsifyArguments& arguments, Eigen::Index size) {
  std::vector<PointList<Dim>> poses;
  for (const auto& path : arguments.poses) {
    poses.push_back(load_model<Dim>(path));
    if (poses.back().cols() == size) continue;
    throw InputError(path + ": has " + std::to_string(poses.back().cols()) + " vertices, but " +
                     arguments.cage + " has " + std::to_string(size));
  }
  return poses;
}

template <int Dim>
Json weights_json(const std::string& file, std::uintmax_t bytes, const WeightMatrix& weights,
                  const PointList<Dim>& control_points, const PointList<Dim>& points) {
  const auto influences = count_influences(weights);
  const auto quality = measure_quality(control_points, points, weights);
  return {{"file", file},
          {"bytes", bytes},
          {"mean_influences", influences.mean},
          {"max_influences", influences.max},
          {"min_weight", quality.min_weight},
          {"max_partition_error", quality.max_partition_error},
          {"max_reproduction_error", quality.max_reproduction_error}};
}

Json norms_json(const ErrorNorms& norms) {
  return {{"rms", norms.rms}, {"max", norms.max}};
}

// The deformation errors are relative to the size of the points.
template <int Dim>
Json errors_json(const PointList<Dim>& control_points, const PointList<Dim>& points,
                 const WeightMatrix& before, const WeightMatrix& after,
                 const SparsifyArguments& arguments) {
  const double size = size_of<Dim>(points);
  const auto measure = [&](const std::vector<PointList<Dim>>& poses) {
    auto norms = deformation_error(poses, before, after);
    if (size > 0) norms = {norms.rms / size, norms.max / size};
    return norms_json(norms);
  };
  Json deformation{{"random_poses", kRandomPoses},
                   {"independent", measure(independent_poses(control_points, kRandomPoses))},
                   {"smooth", measure(smooth_poses(control_points, kRandomPoses))}};
  const auto poses = load_poses<Dim>(arguments, control_points.cols());
  deformation["poses"] = Json::array();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    auto entry = measure({poses[k]});
    entry["file"] = arguments.poses[k];
    deformation["poses"].push_back(entry);
  }
  return {{"weight", norms_json(weight_error(before, after))}, {"deformation", deformation}};
}

std::uintmax_t size_of_file(const std::string& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  return error ? 0 : bytes;
}

void print_summary(const Json& report) {
  const auto& before = report["before"];
  const auto& after = report["after"];
  const auto& deformation = report["error"]["deformation"];
  const auto percent = [](const Json& value) { return 100 * value.get<double>(); };
  std::cerr << after["file"].get<std::string>() << ": " << after["mean_influences"].get<double>()
            << " influences per point, at most " << after["max_influences"] << " (before "
            << before["mean_influences"].get<double>() << ", " << before["max_influences"] << "); "
            << after["bytes"] << " bytes (before " << before["bytes"]
            << "); deformation error over random poses "
            << percent(deformation["independent"]["rms"]) << " % of the size rms, "
            << percent(deformation["independent"]["max"]) << " % max, over smooth ones "
            << percent(deformation["smooth"]["rms"]) << " % rms, "
            << percent(deformation["smooth"]["max"]) << " % max\n";
}

template <int Dim>
int sparsify_weights(const Cage<Dim>& cage, const SparsifyArguments& arguments) {
  validate<Dim>(arguments.options);
  const auto points = load_points<Dim>(arguments.points);
  const auto before = load_weights(arguments, cage.points, points);
  const auto after = naming(arguments.points, [&] {
    return sparsify<Dim>(cage.points, points, before, arguments.options);
  });
  Json report{{"dim", Dim}, {"control_points", cage.size()}, {"points", points.cols()}};
  report["options"] = {{"threshold", arguments.options.threshold}};
  if (arguments.options.max_influences < std::numeric_limits<Index>::max()) {
    report["options"]["max_influences"] = arguments.options.max_influences;
  }
  report["before"] =
      weights_json(arguments.weights, size_of_file(arguments.weights), before, cage.points, points);
  report["error"] = errors_json(cage.points, points, before, after, arguments);
  report["version"] = FLBC_VERSION;
  {
    const HeldSignals held;
    io::write_weights(arguments.output, after);
    report["after"] =
        weights_json(arguments.output, size_of_file(arguments.output), after, cage.points, points);
    if (!arguments.report.empty()) {
      io::write_file(arguments.report, [&](std::ostream& file) { file << report.dump(2) << '\n'; });
    }
  }
  if (!arguments.quiet) print_summary(report);
  return kDone;
}

}  // namespace

void add_sparsify_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<SparsifyArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("sparsify", "Keep few influences per point");
  command->footer(
      "The weights that are left are >= 0, sum to 1 and reproduce the points, also where those\n"
      "given do not.");
  command
      ->add_option("WEIGHTS", a.weights,
                   ".mtx, .dmat, .npy, or .txt with \"CONTROL_POINT POINT WEIGHT\" on every line")
      ->required();
  command->add_option("--cage", a.cage, "the cage of the weights")->required();
  command
      ->add_option("--points", a.points,
                   "model or mesh of the interior to whose vertices the weights belong")
      ->required();
  auto* count = command->add_option("-k,--max-influences", a.options.max_influences,
                                    "most influences per point, at least 3 in 2D and 4 in 3D");
  auto* threshold = command->add_option("--threshold", a.options.threshold,
                                        "drop weights below this first, if the rest reproduces");
  command->add_option("-o,--output", a.output, "sparse weights: .mtx, .dmat or .npy")->required();
  command->add_option("--pose", a.poses, "measure the error in this pose of the cage (repeatable)")
      ->allow_extra_args(false);
  command->add_option("--report", a.report, "write what happened to this .json file");
  command->add_flag("-q,--quiet", a.quiet, "print nothing but errors");
  command->callback([arguments, count, threshold, &exit_status] {
    if (count->count() + threshold->count() == 0) {
      throw OptionError("give -k, the most influences per point, or --threshold, or both");
    }
    check_files(*arguments);
    const auto cage = load_cage(arguments->cage);
    exit_status =
        std::visit([&](const auto& any) { return sparsify_weights(any, *arguments); }, cage);
  });
}

}  // namespace flbc::app

// SPDX-License-Identifier: BSD-3-Clause
// flbc deform: a model moves with its cage.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>

#include "commands.h"
#include "exit_status.h"
#include "file_sequence.h"
#include "flbc/cage.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "held_signals.h"
#include "load.h"
#include "movable_model.h"
#include "poses.h"

namespace flbc::app {
namespace {

struct DeformArguments {
  std::string model;
  std::string weights;
  std::vector<std::string> cages;
  std::string keyframes;
  std::string rest;
  std::string output;
  std::string displacement;
  bool quiet = false;
};

// Weights reproduce their model up to rounding and the tolerance of a solve.
constexpr double kReproduction = 1e-6;

void check_arguments(const DeformArguments& arguments) {
  if (arguments.cages.empty() && arguments.keyframes.empty()) {
    throw OptionError("a pose is missing: give --cage or --keyframes");
  }
  if (arguments.rest.empty() && !arguments.keyframes.empty()) {
    throw OptionError("--keyframes needs --rest: keyframes are displacements of that cage");
  }
  if (arguments.rest.empty() && !arguments.displacement.empty()) {
    throw OptionError("--displacement needs --rest: it is measured from there");
  }
  require_formats(arguments.model, arguments.output);
  require_writable(arguments.displacement, {"npy", "dmat", "mtx"});
}

// No result may replace a file that is read, nor the other result.
void check_outputs(const DeformArguments& arguments, const CageFiles& cages,
                   const std::vector<std::string>& outputs) {
  auto inputs = files_of_model(arguments.model);
  inputs.insert(inputs.end(), {arguments.weights, arguments.keyframes, arguments.rest});
  inputs.insert(inputs.end(), cages.paths.begin(), cages.paths.end());
  require_distinct(inputs, {arguments.displacement});
  for (const auto& output : outputs) {
    for (const auto& file : files_of_model(output)) {
      // What is not there yet is no input. A sequence would take long otherwise.
      std::error_code error;
      if (!std::filesystem::exists(file, error)) continue;
      require_distinct(inputs, {file, arguments.displacement});
    }
  }
}

template <int Dim>
std::vector<std::string> name_outputs(const std::vector<Pose<Dim>>& poses,
                                      const std::string& pattern) {
  if (poses.size() > 1 && !has_number(pattern)) {
    throw OptionError(pattern + ": there are " + std::to_string(poses.size()) +
                      " poses, so that this name needs a %d, as in out_%03d.obj");
  }
  std::vector<std::string> names;
  for (const auto& pose : poses) names.push_back(with_number(pattern, pose.number));
  return names;
}

template <int Dim>
void check_sizes(const WeightMatrix& weights, const MovableModel<Dim>& model,
                 const std::vector<Pose<Dim>>& poses, const DeformArguments& arguments) {
  if (weights.cols() != model.points().cols()) {
    throw InputError(arguments.weights + ": has weights of " + std::to_string(weights.cols()) +
                     " points, but " + arguments.model + " has " +
                     std::to_string(model.points().cols()) + " vertices");
  }
  for (const auto& pose : poses) {
    if (weights.rows() == pose.points.cols()) continue;
    throw InputError(arguments.weights + ": has weights for " + std::to_string(weights.rows()) +
                     " control points, but " + pose.name + " has " +
                     std::to_string(pose.points.cols()));
  }
}

template <int Dim>
void check_reproduction(const SparseWeights& weights, const PointList<Dim>& rest,
                        const PointList<Dim>& points, const DeformArguments& arguments) {
  const auto moved = deform(weights, rest);
  Index worst = 0;
  const double error = displacements(points, moved).maxCoeff(&worst) / size_of(rest);
  if (error <= kReproduction) return;
  const Eigen::IOFormat row(6, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")");
  std::ostringstream text;
  text << arguments.weights << ": the weights do not belong to this model: with " << arguments.rest
       << " they put vertex " << worst << " of " << arguments.model << " at "
       << moved.col(worst).transpose().format(row) << ", not at "
       << points.col(worst).transpose().format(row) << "; that is " << error
       << " of the cage's size, more than " << kReproduction;
  throw InputError(text.str());
}

// What is left to tell after the poses.
struct Outcome {
  double seconds = 0;
  double largest = 0;  // displacement
  Index largest_point = 0;
  std::string largest_pose{};
};

template <int Dim>
Outcome write_poses(const MovableModel<Dim>& model, const SparseWeights& weights,
                    const std::vector<Pose<Dim>>& poses, const std::vector<std::string>& outputs,
                    const DeformArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const bool is_measured = !arguments.rest.empty();
  Eigen::MatrixXd lengths(is_measured ? static_cast<Index>(poses.size()) : 0,
                          model.points().cols());
  Outcome outcome;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const auto points = deform(weights, poses[k].points);
    if (is_measured) {
      const auto row = static_cast<Index>(k);
      lengths.row(row) = displacements(model.points(), points).transpose();
      Index point = 0;
      const double largest = lengths.row(row).maxCoeff(&point);
      if (largest > outcome.largest) outcome = {0, largest, point, poses[k].name};
    }
    const HeldSignals held;
    naming(outputs[k], [&] { model.write(outputs[k], points); });
  }
  if (!arguments.displacement.empty()) {
    const HeldSignals held;
    io::write_weights(arguments.displacement, lengths);
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

template <int Dim>
void print_summary(const MovableModel<Dim>& model, std::size_t num_poses, const Outcome& outcome,
                   const DeformArguments& arguments) {
  std::cerr << arguments.output << ": " << model.points().cols() << " points, " << num_poses
            << (num_poses == 1 ? " pose, " : " poses, ") << outcome.seconds << " s";
  if (!arguments.rest.empty()) std::cerr << "; largest displacement " << outcome.largest;
  if (outcome.largest > 0) {
    std::cerr << " at vertex " << outcome.largest_point << " (" << outcome.largest_pose << ')';
  }
  std::cerr << '\n';
  if (model.num_loose_normals() > 0) {
    std::cerr << "flbc: " << arguments.model << ": " << model.num_loose_normals()
              << " normals belong to no face with an area and stay as they are\n";
  }
}

template <int Dim>
void deform_model(const DeformArguments& arguments, const CageFiles& cages) {
  require_formats_of<Dim>(arguments.model, arguments.output);
  PointList<Dim> rest;
  if (!arguments.rest.empty()) rest = load_control_points<Dim>(arguments.rest);
  auto poses = arguments.keyframes.empty() ? load_poses<Dim>(cages)
                                           : load_keyframes<Dim>(arguments.keyframes, rest);
  const auto outputs = name_outputs(poses, arguments.output);
  check_outputs(arguments, cages, outputs);

  const MovableModel<Dim> model(arguments.model, arguments.output);
  const auto dense = io::read_weights(arguments.weights);
  if (!arguments.rest.empty()) check_sizes(dense, model, {{arguments.rest, 0, rest}}, arguments);
  check_sizes(dense, model, poses, arguments);
  const SparseWeights weights(dense);
  if (!arguments.rest.empty()) check_reproduction(weights, rest, model.points(), arguments);

  const auto outcome = write_poses(model, weights, poses, outputs, arguments);
  if (!arguments.quiet) print_summary(model, poses.size(), outcome, arguments);
}

}  // namespace

void add_deform_command(CLI::App& app, int& exit_status) {
  auto arguments = std::make_shared<DeformArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("deform", "Move a model or a domain mesh with its cage");
  command->footer(
      "Of .obj and .off files nothing changes but the coordinates and the normals of vertices; in\n"
      "2D z stays. A sequence numbers its results as --cage pose_%d.obj is numbered, or from 0.\n"
      "Keyframes are text: 'k TIME' begins a keyframe, and 'c KEYFRAME DX DY DZ' is how far a\n"
      "control point is from where it rests, in the order of the control points.");
  command
      ->add_option("MODEL", a.model,
                   "model (.obj, .off) or domain mesh (.vtu; 3D: .mesh .node .ele .msh)")
      ->required();
  command
      ->add_option("--weights", a.weights,
                   "a row per vertex of it, a column per control point: .mtx, .dmat or .npy")
      ->required();
  auto* cage = command->add_option(
      "--cage", a.cages, "the cage in its new pose; several, or a pattern as pose_%d.obj");
  command->add_option("--keyframes", a.keyframes, "poses as displacements of the rest cage")
      ->excludes(cage);
  command->add_option("--rest", a.rest,
                      "the cage the weights were computed for: checks that they belong to MODEL");
  command
      ->add_option("-o,--output", a.output,
                   "the result, like MODEL; with %d or %03d in its name for several poses")
      ->required();
  command->add_option("--displacement", a.displacement,
                      "write how far vertices moved, a column per pose: .npy, .dmat or .mtx");
  command->add_flag("-q,--quiet", a.quiet, "print nothing but errors");
  command->callback([arguments, &exit_status] {
    check_arguments(*arguments);
    const auto cages = find_cages(arguments->cages);
    const auto& first = arguments->keyframes.empty() ? cages.paths.front() : arguments->rest;
    if (dimension_of_cage(first) == 2) {
      deform_model<2>(*arguments, cages);
    } else {
      deform_model<3>(*arguments, cages);
    }
    exit_status = kDone;
  });
}

}  // namespace flbc::app

// SPDX-License-Identifier: BSD-3-Clause
// flbc deform: a model moves with its cage.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "commands/commands.h"
#include "commands/pose_options.h"
#include "files/deform_points.h"
#include "files/load.h"
#include "files/movable_model.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "poses/moved_by.h"
#include "poses/outside.h"
#include "poses/poses.h"
#include "solve/cage_solver.h"
#include "solve/domain_jacobians.h"
#include "solve/weights_of_model.h"
#include "system/held_signals.h"

namespace flbc::app {
namespace {

// What normals follow.
constexpr const char* kPolygons = "polygons";
constexpr const char* kJacobian = "jacobian";

struct DeformArguments {
  MovedFile file;
  std::string weights;
  std::string method;  // instead of weights
  bool is_relative = false;
  PoseArguments poses;
  std::string rest;
  std::string domain;
  OutsidePoints outside = OutsidePoints::kFail;
  std::string normals = kPolygons;
  std::string displacement;
  bool quiet = false;
};

bool moves_points(const DeformArguments& arguments) {
  return is_point_file(arguments.file.model);
}

bool needs_jacobians(const DeformArguments& arguments) {
  return arguments.normals == kJacobian || moves_splats(arguments.file);
}

void check_arguments(const DeformArguments& arguments) {
  if (arguments.poses.empty()) {
    throw OptionError("no pose given; add --pose or --keyframes");
  }
  if (arguments.weights.empty() && arguments.method.empty()) {
    throw OptionError("no weights given; add --weights, or --method green");
  }
  if (arguments.rest.empty() && !arguments.method.empty()) {
    throw OptionError("--method needs --rest, the cage whose coordinates move the model");
  }
  if (arguments.rest.empty() && arguments.is_relative) {
    throw OptionError("--relative needs --rest, from which displacements are measured");
  }
  if (arguments.rest.empty() && !arguments.poses.keyframes.empty()) {
    throw OptionError(
        "--keyframes needs --rest, because keyframes are displacements of the rest cage");
  }
  if (arguments.rest.empty() && !arguments.displacement.empty()) {
    throw OptionError("--displacement needs --rest, from which displacements are measured");
  }
  if (arguments.rest.empty() && arguments.file.shows_displacement) {
    throw OptionError("--show-displacement needs --rest, from which displacements are measured");
  }
  if (arguments.rest.empty() && !arguments.domain.empty()) {
    throw OptionError("--domain needs --rest, the cage of this mesh");
  }
  if (arguments.domain.empty() && arguments.normals == kJacobian) {
    throw OptionError("--normals jacobian needs --domain, a mesh that has these weights");
  }
  if (arguments.is_relative && needs_jacobians(arguments)) {
    throw OptionError("--relative moves points, but neither splats nor normals by the Jacobian");
  }
  if (moves_points(arguments)) {
    if (arguments.is_relative) {
      throw OptionError(arguments.file.model + ": points cannot be moved with --relative");
    }
    if (!arguments.displacement.empty() || arguments.file.shows_displacement ||
        arguments.normals == kJacobian) {
      throw OptionError(arguments.file.model +
                        ": points have no normals and no colors; remove --displacement, "
                        "--show-displacement, and --normals");
    }
    return require_writable(arguments.file.output, io::extension_of(arguments.file.model).c_str());
  }
  require_formats(arguments.file);
  if (arguments.domain.empty() && moves_splats(arguments.file)) {
    throw OptionError(arguments.file.model +
                      ": Gaussian splats need --domain and --rest, by which they rotate and "
                      "stretch; --weights are those of the domain");
  }
  require_writable(arguments.displacement, {io::Content::kWeights});
}

// No result may replace a file that is read, nor the other result.
void check_outputs(const DeformArguments& arguments, const CageFiles& cages,
                   const std::vector<std::string>& outputs) {
  std::vector<std::string> inputs{arguments.file.model, arguments.weights,
                                  arguments.poses.keyframes, arguments.rest, arguments.domain};
  inputs.insert(inputs.end(), cages.paths.begin(), cages.paths.end());
  require_distinct(inputs, {arguments.displacement});
  for (const auto& output : outputs) {
    // A file that is not there yet is no input. A sequence would take long otherwise.
    std::error_code error;
    if (!std::filesystem::exists(output, error)) continue;
    require_distinct(inputs, {output, arguments.displacement});
  }
}

template <int Dim>
std::vector<std::string> name_outputs(const std::vector<Pose<Dim>>& poses,
                                      const std::string& pattern) {
  if (poses.size() > 1 && !has_number(pattern)) {
    throw OptionError(pattern + ": there are " + std::to_string(poses.size()) +
                      " poses; add %d to this name, as in out_%03d.obj");
  }
  std::vector<std::string> names;
  names.reserve(poses.size());
  for (const auto& pose : poses) names.push_back(with_number(pattern, pose.number));
  return names;
}

// The layout of files that are moved in batches: points, and clouds of the same kind that gain
// nothing from being in memory.
std::optional<io::PointLayout> find_layout(const DeformArguments& arguments) {
  const auto& [model, output, shows_displacement, is_anew] = arguments.file;
  if (arguments.domain.empty() || arguments.is_relative || needs_jacobians(arguments) ||
      shows_displacement || !arguments.displacement.empty() ||
      io::extension_of(model) != io::extension_of(output)) {
    return {};
  }
  return io::find_point_layout(model);
}

// What moves the points of a model.
template <int Dim>
struct Binding {
  MovedBy<Dim> moved;
  DomainJacobians<Dim> jacobians;  // of no points, unless they are asked for
  SparseWeights weights{};         // of the control points; empty for Green coordinates
};

// Weights that fit the model or domain mesh and all poses, and that belong to them as far as is
// known.
template <int Dim>
SparseWeights load_weights(const PointList<Dim>& bound, const RestCage<Dim>& rest,
                           const std::vector<Pose<Dim>>& poses, const DeformArguments& arguments) {
  const auto& file = arguments.domain.empty() ? arguments.file.model : arguments.domain;
  auto weights = io::read_weights(arguments.weights);
  const auto check_cage = [&](const std::string& name, const PointList<Dim>& control_points) {
    check_sizes(weights, control_points.cols(), bound.cols(), {arguments.weights, name, file});
  };
  if (!arguments.rest.empty()) check_cage(arguments.rest, rest.points());
  for (const auto& pose : poses) check_cage(pose.name, pose.points);
  if (!arguments.rest.empty() && !arguments.is_relative) {
    check_reproduction(weights, rest.cage(), bound, {arguments.weights, arguments.rest, file});
  }
  return weights;
}

template <int Dim>
MovedBy<Dim> green_coordinates_of(const PointList<Dim>& points, const DeformArguments& arguments) {
  const auto cage = std::get<Cage<Dim>>(load_cage(arguments.rest));
  return naming(arguments.file.model, [&] { return by_green_coordinates(cage, points); });
}

template <int Dim>
Binding<Dim> bind_points(const PointList<Dim>& points, const RestCage<Dim>& rest,
                         const std::vector<Pose<Dim>>& poses, const DeformArguments& arguments) {
  if (!arguments.method.empty()) return {green_coordinates_of(points, arguments), {}};
  const auto moved_by = [&](const SparseWeights& weights) {
    const auto at_rest = arguments.rest.empty() ? PointList<Dim>() : rest.points();
    return by_weights<Dim>(weights, at_rest, points,
                           arguments.is_relative ? 0 : kBoundaryTolerance);
  };
  if (arguments.domain.empty()) {
    auto weights = load_weights(points, rest, poses, arguments);
    if (!arguments.quiet && !arguments.rest.empty() && !arguments.is_relative) {
      warn_outside(weights, rest.cage(), points, arguments.file.model);
    }
    return {moved_by(weights), {}, std::move(weights)};
  }
  auto domain = io::read_domain<Dim>(arguments.domain);
  const auto weights = load_weights(domain.points, rest, poses, arguments);
  const auto cage = std::get<Cage<Dim>>(load_cage(arguments.rest));
  const auto placement = placing<Dim>(
      arguments.file.model, [&] { return place_points(cage, domain, points, arguments.outside); });
  if (!arguments.quiet) warn_outside(placement, cage, arguments.file.model);
  auto of_points = weights_at(cage, domain, weights, placement);
  auto moved = moved_by(of_points);
  if (!needs_jacobians(arguments)) return {std::move(moved), {}, std::move(of_points)};
  return {std::move(moved), {cage, std::move(domain), weights, placement}, std::move(of_points)};
}

// Removes the files of a sequence that were new, unless all were written.
class NewFiles {
 public:
  NewFiles() = default;
  ~NewFiles() {
    std::error_code ignored;
    for (const auto& path : paths_) std::filesystem::remove(path, ignored);
  }
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;

  // To be called before a file is written.
  void expect(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) paths_.push_back(path);
  }
  void keep() { paths_.clear(); }

 private:
  std::vector<std::string> paths_;
};

template <int Dim>
void write_results(const MovableModel<Dim>& model, const Binding<Dim>& binding,
                   const std::vector<Pose<Dim>>& poses, const Displacement& displacement,
                   const std::vector<std::string>& outputs, const DeformArguments& arguments) {
  NewFiles files;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const auto points = binding.moved.at(poses[k].points);
    const auto jacobians = binding.jacobians.at(poses[k].points);
    files.expect(outputs[k]);
    Eigen::VectorXd lengths;
    if (arguments.file.shows_displacement) lengths = displacement.lengths.row(k).transpose();
    const HeldSignals held;
    naming(outputs[k],
           [&] { model.write(outputs[k], points, lengths, displacement.largest, jacobians); });
    if (!arguments.quiet) warn_inverted(model, points, outputs[k], poses[k].name);
  }
  if (!arguments.displacement.empty()) {
    const HeldSignals held;
    io::write_weights(arguments.displacement, displacement.lengths);
  }
  files.keep();
}

template <int Dim>
void print_summary(const MovableModel<Dim>& model, const std::vector<Pose<Dim>>& poses,
                   const Displacement& displacement, double seconds,
                   const DeformArguments& arguments) {
  const auto& [input, output, shows_displacement, is_anew] = arguments.file;
  std::cerr << output << ": " << model.points().cols() << " vertices, " << poses.size()
            << (poses.size() == 1 ? " pose, " : " poses, ") << seconds << " s";
  if (!arguments.rest.empty()) std::cerr << "; largest displacement " << displacement.largest;
  if (displacement.largest > 0) {
    std::cerr << " at vertex " << displacement.point << " (" << poses[displacement.pose].name
              << ')';
  }
  if (shows_displacement) {
    std::cerr << "; shown from 0 (near white) to " << displacement.largest << " (dark blue)";
  }
  std::cerr << '\n';
  model.print_losses();
  if (arguments.normals == kPolygons && model.num_loose_normals() > 0) {
    std::cerr << "flbc: " << input << ": " << model.num_loose_normals()
              << " normals belong to no face with an area and are unchanged\n";
  }
}

// Points have no edges that would show a jump.
void warn_unknown_border(const std::string& file) {
  std::cerr << "flbc: " << file
            << ": the deformation jumps where a moved facet passes through a mesh of these points; "
               "this is not checked, because points have no edges\n";
}

// Of vertices without weights.
template <int Dim>
void warn_border(const MovableModel<Dim>& model, const RestCage<Dim>& rest,
                 const SparseWeights& weights, const std::vector<Pose<Dim>>& poses,
                 const DeformArguments& arguments) {
  if (count_without_weights(weights) == 0) return;
  if (moves_points(arguments)) return warn_unknown_border(arguments.file.model);
  const Border<Dim> border(rest.cage(), model.points(), model.edges(), weights);
  const auto text = border.describe(poses);
  if (!text.empty()) std::cerr << "flbc: " << arguments.file.model << ' ' << text << '\n';
}

template <int Dim>
void deform_in_batches(const io::PointLayout& layout, const RestCage<Dim>& rest,
                       const std::vector<Pose<Dim>>& poses, const std::vector<std::string>& outputs,
                       const DeformArguments& arguments) {
  const auto& input = arguments.file.model;
  if (layout.offsets.size() < Dim || (moves_points(arguments) && layout.offsets.size() > Dim)) {
    throw InputError(input + ": has " + std::to_string(layout.offsets.size()) +
                     " coordinates per point, but the cage is in " + std::to_string(Dim) + "D");
  }
  auto domain = io::read_domain<Dim>(arguments.domain);
  auto weights = load_weights(domain.points, rest, poses, arguments);
  const auto outside =
      arguments.outside == OutsidePoints::kFail ? OutsidePoints::kNearest : arguments.outside;
  const Evaluator<Dim> evaluator(std::get<Cage<Dim>>(load_cage(arguments.rest)), std::move(domain),
                                 std::move(weights), outside);
  const auto start = std::chrono::steady_clock::now();
  NewFiles files;
  MovedPoints all;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    files.expect(outputs[k]);
    const PointMotion motion{input, layout, outputs[k], arguments.outside, arguments.quiet};
    const auto moved = deform_points(motion, evaluator, poses[k].points);
    all = {std::max(all.largest, moved.largest), moved.outside, moved.farthest};
  }
  files.keep();
  if (arguments.quiet) return;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  std::cerr << arguments.file.output << ": " << layout.count << " vertices, " << poses.size()
            << (poses.size() == 1 ? " pose, " : " poses, ") << seconds.count()
            << " s; largest displacement " << all.largest;
  if (all.outside > 0) {
    std::cerr << "; " << all.outside << " vertices are outside the cage, by up to " << all.farthest;
  }
  std::cerr << '\n';
  const bool has_border = all.outside > 0 && arguments.outside == OutsidePoints::kKeep;
  if (has_border) warn_unknown_border(input);
}

template <int Dim>
void deform_model(const DeformArguments& arguments, const CageFiles& cages) {
  const auto layout = find_layout(arguments);
  if (!moves_points(arguments)) require_formats_of<Dim>(arguments.file);
  // Without a rest cage, the poses of a sequence must at least be poses of one cage.
  const bool has_rest = !arguments.rest.empty();
  const RestCage<Dim> cage(has_rest ? arguments.rest : cages.paths.front(), arguments.quiet);
  const auto poses = load_poses(arguments.poses, cages, cage);
  const auto outputs = name_outputs(poses, arguments.file.output);
  check_outputs(arguments, cages, outputs);
  if (layout) return deform_in_batches<Dim>(*layout, cage, poses, outputs, arguments);

  const MovableModel<Dim> model(arguments.file);
  const auto binding = bind_points(model.points(), cage, poses, arguments);
  const auto start = std::chrono::steady_clock::now();
  Displacement displacement;
  if (!arguments.rest.empty()) {
    displacement = measure_displacement(binding.moved, model.points(), poses);
    if (!displacement.lengths.allFinite()) {
      throw InputError(poses[displacement.pose].name + ": displacements are not finite");
    }
  }
  write_results(model, binding, poses, displacement, outputs, arguments);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (arguments.quiet) return;
  print_summary(model, poses, displacement, seconds.count(), arguments);
  if (has_rest && arguments.method.empty())
    warn_border(model, cage, binding.weights, poses, arguments);
}

}  // namespace

void add_deform_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<DeformArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("deform", "deform a model or a domain mesh with its cage");
  command->footer(
      "If MODEL and the result have the same format, only coordinates and normals change. In\n"
      "2D, z does not change. Gaussian splats (.ply) also rotate and stretch, with --domain.\n"
      "Another format receives the polygons, colors, normals, and texture coordinates that it\n"
      "supports. The program reports those that are lost.\n"
      "The results of a sequence have the numbers of --pose pose_%d.obj, or count from 0.\n"
      "Points (.npy) and binary .ply files without faces and normals may be of any size, with\n"
      "--domain. They are moved in batches, and everything in the file except coordinates stays\n"
      "the same.\n"
      "Keyframes are text: 'k TIME' starts a keyframe, and 'c KEYFRAME DX DY DZ' is the\n"
      "displacement of a control point from rest, in the order of the control points.\n"
      "\n"
      "Examples:\n"
      "  flbc deform model.obj --weights few.mtx --pose pose.obj -o moved.obj\n"
      "  flbc deform model.obj --method green --rest cage.obj --pose pose.obj -o green.obj");
  command
      ->add_option("MODEL", a.file.model,
                   "model (.obj .off .ply .stl .om .glb), domain mesh (3D: .mesh .msh), or points "
                   "(.npy .csv)")
      ->required();
  auto* weights = command->add_option("--weights", a.weights, describe_weight_file());
  auto* method =
      command
          ->add_option("--method", a.method,
                       "coordinates of --rest to compute instead of --weights: green, Green "
                       "coordinates, which also need normals and have no file of weights")
          ->check(CLI::IsMember({"green"}))
          ->type_name("green")
          ->excludes(weights);
  add_pose_options(*command, a.poses);
  command->add_option(
      "--rest", a.rest,
      "rest cage, to check that the weights belong to MODEL; also needed to move vertices "
      "outside of it (weights by --outside nearest)");
  auto* relative = command->add_flag(
      "--relative", a.is_relative,
      "add weighted displacements to MODEL, for weights that do not reproduce it (method bbw)");
  auto* domain = command->add_option(
      "--domain", a.domain,
      "domain mesh that has these weights (domain_weights.npy of flbc run), instead of MODEL");
  domain->excludes(method)->excludes(relative);
  relative->excludes(method);
  add_choice(*command, "--outside", a.outside,
             "method for vertices outside the cage, as in flbc solve (default: fail)")
      ->needs(domain);
  add_choice(*command, "--normals", {kPolygons, kJacobian}, a.normals,
             "what normals follow: polygons, or the gradients of the weights (default: polygons)");
  command
      ->add_option("-o,--output", a.file.output,
                   "deformed model or mesh; for several poses, a pattern such as out_%03d.obj")
      ->required();
  command->add_option("--displacement", a.displacement,
                      "write displacement lengths, one column per pose: .npy, .mtx, .csv");
  command->add_flag("--show-displacement", a.file.shows_displacement,
                    "write displacement lengths as vertex colors, or as a field in .vtu");
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    const auto cages = find_cages(arguments->poses.cages);
    const auto& first = arguments->poses.keyframes.empty() ? cages.paths.front() : arguments->rest;
    dimension_of_cage(first) == 2 ? deform_model<2>(*arguments, cages)
                                  : deform_model<3>(*arguments, cages);
  });
}

}  // namespace flbc::app

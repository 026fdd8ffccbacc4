// SPDX-License-Identifier: BSD-3-Clause
// flbc deform: a model moves with its cage.
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "commands/commands.h"
#include "flbc/deform.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "front/bound_model.h"
#include "front/load.h"
#include "front/model_facets.h"
#include "front/movable_model.h"
#include "front/picture_file.h"
#include "front/poses.h"
#include "front/system/held_signals.h"
#include "poses/outside.h"

namespace flbc::app {
namespace {

// What normals follow.
constexpr const char* kPolygons = "polygons";
constexpr const char* kJacobian = "jacobian";

struct DeformArguments {
  MovedFile file;
  BindingFiles files;  // weights and rest cage
  std::string method;  // instead of weights
  bool is_relative = false;
  PoseArguments poses;
  OutsidePoints outside = OutsidePoints::kFail;
  std::string normals = kPolygons;
  std::string joint;
  std::string displacement;
  double scale = 1;       // of a picture
  bool is_sheet = false;  // one picture of all poses
  bool quiet = false;
};

bool moves_points(const DeformArguments& arguments) {
  return is_point_file(arguments.file.model);
}

bool moves_picture(const DeformArguments& arguments) {
  return is_picture_file(arguments.file.model);
}

// Whether points that the binding does not have are evaluated on its domain mesh.
bool evaluates(const DeformArguments& arguments) {
  const bool is_free = moves_points(arguments) || moves_picture(arguments) ||
                       moves_splats(arguments.file) || moves_drawing(arguments.file);
  return !arguments.files.domain.empty() || (is_free && arguments.files.is_one());
}

bool needs_jacobians(const DeformArguments& arguments) {
  return arguments.normals == kJacobian || moves_splats(arguments.file);
}

void check_arguments(const DeformArguments& arguments) {
  if (arguments.files.is_one()) require_cage(arguments.files, "--rest");
  if (arguments.files.is_one() && !arguments.files.domain.empty()) {
    throw OptionError("--domain: " + arguments.files.weights +
                      " has the domain mesh; leave out this option");
  }
  if (arguments.poses.empty()) {
    throw OptionError("--pose is missing");
  }
  if (arguments.files.weights.empty() && arguments.method.empty()) {
    throw OptionError("--weights is missing, or --method green");
  }
  const std::pair<const char*, bool> of_rest[] = {
      {"--method", !arguments.method.empty()},
      {"--relative", arguments.is_relative},
      {"--displacement", !arguments.displacement.empty()},
      {"--show-displacement", arguments.file.shows_displacement},
      {"--joint", !arguments.joint.empty()},
      {"--domain", !arguments.files.domain.empty()}};
  for (const auto& [option, is_given] : of_rest) {
    if (is_given && !arguments.files.has_cage()) {
      throw OptionError(option + std::string(": --rest is missing, the rest cage of the weights"));
    }
  }
  if (!evaluates(arguments) && !arguments.files.is_one() && arguments.normals == kJacobian) {
    throw OptionError("--normals jacobian needs a binding (.npz), or --domain");
  }
  if (arguments.is_relative && needs_jacobians(arguments)) {
    throw OptionError("--relative moves points, but neither splats nor normals by the Jacobian");
  }
  if (!arguments.joint.empty() && needs_jacobians(arguments)) {
    throw OptionError("--joint moves vertices, but neither splats nor normals by the Jacobian");
  }
  if ((moves_drawing(arguments.file) || moves_picture(arguments)) && !evaluates(arguments)) {
    throw OptionError(arguments.file.model +
                      ": drawings and pictures need a binding (.npz) of flbc run, or --domain and "
                      "--rest, with which they move");
  }
  if (moves_picture(arguments)) {
    if (arguments.is_relative || needs_jacobians(arguments) || !arguments.displacement.empty() ||
        arguments.file.shows_displacement || arguments.outside != OutsidePoints::kFail ||
        !arguments.joint.empty()) {
      throw OptionError(arguments.file.model +
                        ": pixels have no vertices; remove --relative, --normals, --displacement, "
                        "--show-displacement, --joint, and --outside");
    }
    return require_writable(arguments.file.output, "png");
  }
  if (arguments.is_sheet || arguments.scale != 1) {
    throw OptionError("--sheet and --scale need a picture (.png or .jpg)");
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
  if (!evaluates(arguments) && moves_splats(arguments.file)) {
    throw OptionError(arguments.file.model +
                      ": Gaussian splats need a binding (.npz), or --domain and --rest, by which "
                      "they rotate and stretch; --weights are then those of the domain");
  }
  require_writable(arguments.displacement, {io::Content::kWeights});
}

// No result may replace a file that is read, nor the other result.
void check_outputs(const DeformArguments& arguments, const CageFiles& cages,
                   const std::vector<std::string>& outputs) {
  std::vector<std::string> inputs{arguments.file.model, arguments.files.weights,
                                  arguments.files.cage, arguments.files.domain};
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

// The binding of the model itself.
template <int Dim>
Binding<Dim> bind_model(const MovableModel<Dim>& model, const Pose<Dim>& pose,
                        const DeformArguments& arguments) {
  const auto& file = arguments.file.model;
  if (!arguments.files.has_cage()) {
    auto weights = io::read_weights(arguments.files.weights);
    check_sizes(weights, pose.points.cols(), model.points().cols(),
                {arguments.files.weights, pose.name, file});
    // Only points without weights are known to stay where they are.
    Binding<Dim> binding;
    binding.offsets = PointList<Dim>::Zero(Dim, model.points().cols());
    for (Index p = 0; p < weights.num_points(); ++p) {
      if (!weights.has_weights(p)) binding.offsets.col(p) = model.points().col(p);
    }
    binding.weights = std::move(weights);
    return binding;
  }
  if (!evaluates(arguments)) {
    return load_binding<Dim>(arguments.files, file, model.points(), model.edges(),
                             !arguments.is_relative);
  }
  return bind_by_mesh(load_domain_binding<Dim>(arguments.files), model, file, arguments.outside);
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
void write_results(const MovableModel<Dim>& model, const Motion<Dim>& moved,
                   const std::optional<PointJacobians<Dim>>& jacobians,
                   const std::vector<Pose<Dim>>& poses, const Displacement& displacement,
                   const std::vector<std::string>& outputs, const DeformArguments& arguments) {
  NewFiles files;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const auto points = moved(poses[k].points);
    files.expect(outputs[k]);
    Eigen::VectorXd lengths;
    if (arguments.file.shows_displacement) lengths = displacement.lengths.row(k).transpose();
    const HeldSignals held;
    naming(outputs[k], [&] {
      model.write(outputs[k], points, lengths, displacement.largest,
                  jacobians ? jacobians->at(poses[k].points) : Eigen::MatrixXd());
    });
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
  std::cerr << arguments.file.output << ": " << model.points().cols() << " vertices, "
            << poses.size() << (poses.size() == 1 ? " pose, " : " poses, ") << seconds << " s";
  if (arguments.files.has_cage()) std::cerr << "; largest displacement " << displacement.largest;
  if (displacement.largest > 0) {
    std::cerr << " at vertex " << displacement.point << " (" << poses[displacement.pose].name
              << ')';
  }
  if (arguments.file.shows_displacement) {
    std::cerr << "; shown from 0 (near white) to " << displacement.largest << " (dark blue)";
  }
  std::cerr << '\n';
  model.print_losses();
  if (arguments.normals == kPolygons && model.num_loose_normals() > 0) {
    std::cerr << "flbc: " << arguments.file.model << ": " << model.num_loose_normals()
              << " normals belong to no face with an area and are unchanged\n";
  }
}

// Without a rest cage, the poses of a sequence must at least be poses of one cage.
template <int Dim>
RestCage<Dim> load_rest(const DeformArguments& arguments, const CageFiles& cages) {
  const auto& files = arguments.files;
  if (files.is_one()) return RestCage<Dim>(load_binding<Dim>(files).cage, files.weights);
  return RestCage<Dim>(files.cage.empty() ? cages.paths.front() : files.cage);
}

template <int Dim>
void deform_model(const DeformArguments& arguments, const CageFiles& cages) {
  if (!moves_points(arguments)) require_formats_of<Dim>(arguments.file);
  const auto poses = load_poses(arguments.poses, cages, load_rest<Dim>(arguments, cages));
  const auto outputs = name_outputs(poses, arguments.file.output);
  check_outputs(arguments, cages, outputs);

  const MovableModel<Dim> model(arguments.file);
  Binding<Dim> binding;
  Motion<Dim> moved = [&](const PointList<Dim>& pose) { return binding.deform(pose); };
  std::optional<PointJacobians<Dim>> jacobians;
  const bool is_drawing = model.drawing() != nullptr;
  if (is_drawing && arguments.joint.empty()) {
    binding = load_domain_binding<Dim>(arguments.files);
    const auto at = drawing_by_mesh(binding, model, arguments.file.model, arguments.outside);
    // The displacement is measured before the result is written.
    moved = [at, pose = PointList<Dim>(), points = PointList<Dim>()](const auto& next) mutable {
      if (pose.size() == 0 || pose != next) points = at(pose = next);
      return points;
    };
  } else if (arguments.method.empty()) {
    binding = bind_model(model, poses.front(), arguments);
    join(binding, arguments.joint, arguments.file.model, arguments.quiet ? nullptr : &poses);
    if (needs_jacobians(arguments)) jacobians = binding.point_jacobians();
    if (!arguments.quiet && !arguments.is_relative && !is_drawing) {
      warn_outside(binding, arguments.file.model);
    }
  } else {
    const auto cage = std::get<Cage<Dim>>(load_cage(arguments.files.cage));
    moved = naming(arguments.file.model,
                   [&] { return by_green_coordinates<Dim>(cage, model.points()); });
  }
  const auto start = std::chrono::steady_clock::now();
  Displacement displacement;
  if (arguments.files.has_cage()) {
    displacement = measure_displacement(moved, model.points(), poses);
    if (!displacement.lengths.allFinite()) {
      throw InputError(poses[displacement.pose].name + ": displacements are not finite");
    }
  }
  write_results(model, moved, jacobians, poses, displacement, outputs, arguments);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  if (arguments.quiet) return;
  print_summary(model, poses, displacement, seconds.count(), arguments);
  if (arguments.files.has_cage() && !is_drawing) warn_border(binding, arguments.file.model, poses);
}

void deform_picture(const DeformArguments& arguments, const CageFiles& cages) {
  const auto& output = arguments.file.output;
  const auto poses = load_poses(arguments.poses, cages, load_rest<2>(arguments, cages));
  const auto stem = output.substr(0, output.size() - 4);
  std::vector<std::string> outputs{output, stem + ".json"};
  if (!arguments.is_sheet) outputs = name_outputs(poses, output);
  check_outputs(arguments, cages, outputs);
  const auto picture = read_picture(arguments.file.model);
  const auto binding = load_domain_binding<2>(arguments.files);
  std::vector<PointList<2>> points;
  std::vector<std::string> names;  // of the cells of a sheet
  for (const auto& pose : poses) {
    points.push_back(pose.points);
    if (!arguments.is_sheet) continue;
    const auto name = std::filesystem::path(stem).filename().string() + "_%04d.png";
    names.push_back(with_number(name, pose.number));
  }
  NewFiles files;
  std::vector<io::Bitmap> cells;
  std::string facts;
  const auto write = [&](const std::string& path, const io::Bitmap& moved) {
    facts = describe(moved);
    files.expect(path);
    const HeldSignals held;
    write_picture(path, moved);
  };
  const auto staying = naming(arguments.file.model, [&] {
    return io::warp(picture, binding, points, arguments.scale, {0, 0}, [&](auto k, auto moved) {
      if (!arguments.is_sheet) return write(outputs[k], moved);
      cells.push_back(std::move(moved));
    });
  });
  if (arguments.is_sheet) {
    std::string json;
    const double seconds = poses.size() > 1 ? poses[1].time - poses[0].time : 1;
    const auto file = std::filesystem::path(output).filename().string();
    write(output, io::sprite_sheet(cells, names, file, seconds, json));
    files.expect(outputs[1]);
    write_text(outputs[1], json);
    facts += ", cells of " + describe(cells.front());
  }
  files.keep();
  if (arguments.quiet) return;
  std::cerr << output << ": " << facts << "; " << poses.size()
            << (poses.size() == 1 ? " pose\n" : " poses\n");
  warn_staying(staying, arguments.file.model);
}

}  // namespace

void add_deform_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<DeformArguments>();
  auto& a = *arguments;
  auto* command = app.add_subcommand("deform", "deform a model or a domain mesh with its cage");
  command->footer(
      "If MODEL and the result have the same format, only coordinates and normals change. In\n"
      "2D, z does not change. Gaussian splats (.ply) also rotate and stretch. Curves of a drawing\n"
      "stay curves; everything else in its document stays. A picture (.png .jpg) becomes a\n"
      ".png of its resolution; the canvas grows where pixels move beyond it.\n"
      "Another format receives the polygons, colors, normals, and texture coordinates that it\n"
      "supports. The program reports those that are lost.\n"
      "The results of a sequence have the numbers of --pose pose_%d.obj, or count from 0.\n"
      "\n"
      "Examples:\n"
      "  flbc deform model.obj --weights binding.npz --pose pose.obj -o moved.obj\n"
      "  flbc deform model.obj --method green --rest cage.obj --pose pose.obj -o green.obj");
  command
      ->add_option("MODEL", a.file.model,
                   "model (.obj .off .ply .stl .glb), drawing (.svg), picture (.png .jpg), domain "
                   "mesh (3D: .mesh .msh), or points (.npy .csv)")
      ->required();
  auto* weights = command->add_option("--weights", a.files.weights, describe_weight_file());
  auto* method =
      command
          ->add_option("--method", a.method,
                       "coordinates of --rest to compute instead of --weights: green, Green "
                       "coordinates, which also need normals and have no file of weights")
          ->check(CLI::IsMember({"green"}))
          ->type_name("green")
          ->excludes(weights);
  auto* poses = add_pose_option(*command, a.poses);
  command->add_option(
      "--rest", a.files.cage,
      "rest cage of weights that have none (all but .npz), to check that they belong to MODEL; "
      "also needed to move vertices outside of it (weights by --outside nearest)");
  auto* relative = command->add_flag(
      "--relative", a.is_relative,
      "add weighted displacements to MODEL, for weights that do not reproduce it (method bbw)");
  auto* domain = command->add_option(
      "--domain", a.files.domain,
      "domain mesh that has these weights (domain_weights.npy of flbc run), instead of MODEL");
  domain->excludes(method)->excludes(relative);
  relative->excludes(method);
  add_joint_option(*command, a.joint)->excludes(method)->excludes(relative);
  add_choice(*command, "--outside", a.outside,
             "method for splats and points outside the cage, and with --domain, as in flbc solve "
             "(default: that of the binding, or fail)");
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
  command->add_option("--scale", a.scale,
                      "pixels of the result per pixel of a picture (default: 1)");
  auto* sheet = command->add_flag("--sheet", a.is_sheet,
                                  "write a sprite sheet of all poses, and a .json of its cells");
  add_rate_option(*command, a.poses, poses)->needs(sheet);
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    const auto cages = find_cages(arguments->poses.cages);
    const auto& files = arguments->files;
    const int dim = files.has_cage() ? dimension_of(files) : dimension_of_cage(cages.paths.front());
    if (moves_picture(*arguments)) return deform_picture(*arguments, cages);
    dim == 2 ? deform_model<2>(*arguments, cages) : deform_model<3>(*arguments, cages);
  });
}

}  // namespace flbc::app

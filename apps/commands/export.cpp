// SPDX-License-Identifier: BSD-3-Clause
// flbc export: a model that moves with its cage in other programs.
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "front/bound_model.h"
#include "front/gltf_facts.h"
#include "front/load.h"
#include "front/movable_model.h"
#include "front/poses.h"
#include "front/up_axis.h"
#include "gltf/skeleton.h"
#include "gltf/skin.h"
#include "help/options.h"
#include "report/skin_facts.h"

namespace flbc::app {
namespace {

struct ExportArguments {
  std::string model;
  BindingFiles files;
  PoseArguments poses;
  std::string output;
  std::string skeleton;  // empty: joints are control points
  bool corrects = false;
  UpAxis up = UpAxis::kAuto;
  bool quiet = false;
  gltf::SkinOptions options;
};

void check_arguments(ExportArguments& arguments) {
  arguments.options.name = std::filesystem::path(arguments.model).stem().string();
  require_mesh_readable(arguments.model);
  require_writable(arguments.output, std::vector<std::string>{"glb", "usda"});
  if (io::extension_of(arguments.output) == "usda") {
    arguments.options.format = gltf::SkinFormat::kUsda;
  }
}

void check_files(const ExportArguments& arguments, const CageFiles& poses) {
  std::vector<std::string> inputs{arguments.model, arguments.files.weights, arguments.files.cage,
                                  arguments.skeleton};
  inputs.insert(inputs.end(), poses.paths.begin(), poses.paths.end());
  require_distinct(inputs, {arguments.output});
}

template <int Dim>
gltf::Animation<Dim> load_motion(const ExportArguments& arguments, const CageFiles& poses,
                                 const RestCage<Dim>& rest) {
  // One pose does not move: it begins at rest.
  const bool is_alone = poses.paths.size() == 1;
  return animation_of(load_poses(arguments.poses, poses, rest, is_alone ? 1 : 0),
                      is_alone ? &rest.points() : nullptr);
}

template <int Dim>
gltf::ExportedSkin export_by_skeleton(const ExportArguments& arguments, const Binding<Dim>& binding,
                                      const gltf::Surface& surface) {
  if constexpr (Dim == 3) {
    const auto skeleton = gltf::read_skeleton(arguments.skeleton, binding.cage.points);
    return naming(arguments.model, [&] {
      return gltf::export_skin(binding, surface, arguments.options, skeleton, arguments.corrects);
    });
  }
  throw OptionError("--skeleton: the cage is in 2D; skeletons need one in 3D");
}

template <int Dim>
void export_model(const ExportArguments& arguments, const CageFiles& poses) {
  const MovedFile same{arguments.model, arguments.model};
  require_formats_of<Dim>(same);
  const MovableModel<Dim> model(same);
  const auto& points = model.points();
  const auto binding = load_binding<Dim>(arguments.files, arguments.model, points, model.edges());
  const auto cage = rest_cage_of(arguments.files, binding);
  const auto animation = load_motion(arguments, poses, cage);
  const auto surface = model.surface();
  if (!arguments.quiet) warn_outside(binding, arguments.model);

  auto options = arguments.options;
  options.turn = turn_upright(up_axis(up_of(arguments.up, arguments.model), points));
  const auto skin = !arguments.skeleton.empty()
                        ? export_by_skeleton(arguments, binding, surface)
                        : naming(arguments.model, [&] {
                            return gltf::export_skin(binding, surface, options, animation);
                          });
  write_text(arguments.output, skin.content);
  const double size = bounding_box_diagonal<Dim>(points);
  if (!arguments.quiet) {
    std::cerr << arguments.output << ": " << describe_skin(skin, animation, size) << "; "
              << skin.content.size() << " bytes\n";
  }
  warn_left_out(arguments.output, arguments.model, skin.left_out);
}

}  // namespace

void add_export_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<ExportArguments>();
  auto& a = *arguments;
  auto* command =
      app.add_subcommand("export", "export a model as a glTF skin that the cage deforms");
  command->footer(
      "Each control point becomes a joint (control_point_0 and so on) that only translates. With\n"
      "--rigid there is one more for each solid region (solid_0 and so on). With --skeleton the\n"
      "joints are those that skin the cage in another file.\n"
      "Vertices are split along seams of texture coordinates and normals. The attribute _VERTEX\n"
      "maps them to the vertices of MODEL. Normals do not deform.\n"
      "\n"
      "Examples:\n"
      "  flbc export model.obj --weights binding.npz -o model.glb\n"
      "  flbc export model.obj --weights binding.npz --pose pose.obj -o posed.glb");
  command
      ->add_option("MODEL", a.model,
                   "model (.obj .off .ply .stl .glb .gltf), or domain mesh (3D: .mesh .msh) "
                   "whose boundary is exported")
      ->required();
  command->add_option("--weights", a.files.weights, describe_weight_file())->required();
  add_cage_option(*command, a.files.cage);
  auto* poses = add_pose_option(*command, a.poses);
  add_rate_option(*command, a.poses, poses);
  auto* skeleton = command->add_option("--skeleton", a.skeleton,
                                       "skinned cage (.glb .gltf .vrm) whose joints and animations "
                                       "the model gets");
  command
      ->add_flag("--correct", a.corrects,
                 "add a morph target for each key, so that the model is as the cage deforms it")
      ->needs(skeleton);
  auto* rigid = command->add_flag("--rigid", a.options.rigid,
                                  "move each solid region of the weights by a joint of its own, "
                                  "which turns it without distortion");
  command->add_option("-k,--max-influences", a.options.max_influences,
                      "maximum influences per vertex, 4 or 8 (default: 8)");
  command->add_option("-o,--output", a.output, "skin: .glb or .usda")->required();
  skeleton->excludes(poses)->excludes(rigid)->excludes(add_up_option(*command, a.up));
  command->add_flag("-q,--quiet", a.quiet, "print only errors");
  command->callback([arguments] {
    check_arguments(*arguments);
    const auto pose_files = find_cages(arguments->poses.cages);
    check_files(*arguments, pose_files);
    require_cage(arguments->files);
    dimension_of(arguments->files) == 2 ? export_model<2>(*arguments, pose_files)
                                        : export_model<3>(*arguments, pose_files);
  });
}

}  // namespace flbc::app

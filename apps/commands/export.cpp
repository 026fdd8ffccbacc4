// SPDX-License-Identifier: BSD-3-Clause
// flbc export: a model that moves with its cage in other programs.
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "commands/commands.h"
#include "flbc/bounding_box.h"
#include "flbc/cage.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "flbc/io/weights_io.h"
#include "flbc/placement.h"
#include "flbc/sparse_weights.h"
#include "front/bound_model.h"
#include "front/gltf_facts.h"
#include "front/load.h"
#include "front/movable_model.h"
#include "front/poses.h"
#include "front/up_axis.h"
#include "gltf/skin.h"
#include "help/options.h"
#include "report/skin_facts.h"

namespace flbc::app {
namespace {

constexpr const char* kHead =
    R"(# Written by flbc export. In Blender: import the model, select it, and run this as a script.
# The model gets a vertex group and a bone for every control point of its cage.
import bpy
from mathutils import Vector

)";

constexpr const char* kTail = R"(
model = bpy.context.view_layer.objects.active
if model is None or model.type != 'MESH' or len(model.data.vertices) != NUM_VERTICES:
    raise SystemExit(f'select the model, a mesh with {NUM_VERTICES} vertices, first')

for i, influences in enumerate(INFLUENCES):
    group = model.vertex_groups.new(name=f'control_point_{i}')
    for vertex, weight in influences:
        group.add([vertex], weight, 'REPLACE')

armature = bpy.data.objects.new('cage', bpy.data.armatures.new('cage'))
bpy.context.collection.objects.link(armature)
armature.matrix_world = model.matrix_world
bpy.context.view_layer.objects.active = armature
bpy.ops.object.mode_set(mode='EDIT')
for i, place in enumerate(CONTROL_POINTS):
    bone = armature.data.edit_bones.new(f'control_point_{i}')
    bone.head = Vector(place)
    bone.tail = Vector(place) + Vector((0, 0, BONE_LENGTH))
bpy.ops.object.mode_set(mode='OBJECT')
model.modifiers.new('cage', 'ARMATURE').object = armature
)";

struct Member {
  Index vertex;
  double weight;
};

// By control point: the vertices on which it has an influence.
std::vector<std::vector<Member>> groups_of(const SparseWeights& weights) {
  std::vector<std::vector<Member>> groups(weights.num_control_points());
  for (Index v = 0; v < weights.num_points(); ++v) {
    weights.visit(v, [&](Index i, double weight) {
      if (weight > 0) groups[i].push_back({v, weight});
    });
  }
  return groups;
}

// A program for Blender: run there with the imported model as active object, it gives the model a
// vertex group per control point, and an armature whose bones, as the groups, are named
// "control_point_0" and so on. Moving a bone moves the model as flbc deform does.
// \param control_points  Dim x n, in the model's coordinates
// \param weights  n x P
template <int Dim>
std::string blender_script(const PointList<Dim>& control_points, const SparseWeights& weights) {
  constexpr double kBoneLength = 0.02;  // of the cage's size
  std::ostringstream text;
  text.precision(9);
  text << kHead << "NUM_VERTICES = " << weights.num_points()
       << "\nBONE_LENGTH = " << kBoneLength * bounding_box_diagonal<Dim>(control_points)
       << "\nCONTROL_POINTS = [\n";
  for (Eigen::Index i = 0; i < control_points.cols(); ++i) {
    text << "    (" << control_points(0, i) << ", " << control_points(1, i) << ", "
         << (Dim == 3 ? control_points(Dim - 1, i) : 0) << "),\n";
  }
  text << "]\nINFLUENCES = [  # per control point: vertex, weight\n";
  for (const auto& group : groups_of(weights)) {
    text << "    [";
    for (const auto& [vertex, weight] : group) text << '(' << vertex << ", " << weight << "), ";
    text << "],\n";
  }
  text << "]\n" << kTail;
  return text.str();
}

struct ExportArguments {
  std::string model;
  BindingFiles files;
  PoseArguments poses;
  std::string output;
  UpAxis up = UpAxis::kAuto;
  bool quiet = false;
  gltf::SkinOptions options;
};

void check_arguments(ExportArguments& arguments) {
  arguments.options.name = std::filesystem::path(arguments.model).stem().string();
  require_mesh_readable(arguments.model);
  const auto extension = io::extension_of(arguments.output);
  require_writable(arguments.output, std::vector<std::string>{"glb", "usda", "py"});
  if (extension == "usda") arguments.options.format = gltf::SkinFormat::kUsda;
  if (extension != "py") return;
  if (is_gltf_file(arguments.model)) {
    throw OptionError(arguments.output +
                      ": Blender turns glTF models when it imports them, and bones would not fit; "
                      "write .glb");
  }
  if (arguments.up != UpAxis::kAuto) {
    throw OptionError(arguments.output +
                      ": vertex groups do not turn the imported model; leave out --up");
  }
  if (!arguments.poses.empty()) {
    throw OptionError(arguments.output + ": vertex groups have no poses; leave out --pose");
  }
}

// Vertex groups of Blender, as a program.
template <int Dim>
void write_vertex_groups(const Binding<Dim>& binding, const ExportArguments& arguments) {
  const auto& rest = binding.cage;
  const auto few = naming(
      arguments.model, [&] { return binding.reduced({arguments.options.max_influences}).weights; });
  const auto script = blender_script<Dim>(rest.points, few);
  write_text(arguments.output, script);
  if (arguments.quiet) return;
  std::cerr << arguments.output << ": " << rest.size() << " vertex groups and bones, at most "
            << count_influences(few).max << " influences per vertex; " << script.size()
            << " bytes; run it in Blender with the imported model selected\n";
}

void check_files(const ExportArguments& arguments, const CageFiles& poses) {
  std::vector<std::string> inputs{arguments.model, arguments.files.weights, arguments.files.cage};
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
  if (io::extension_of(arguments.output) == "py") return write_vertex_groups(binding, arguments);

  auto options = arguments.options;
  options.turn = turn_upright(up_axis(up_of(arguments.up, arguments.model), points));
  const auto skin = naming(arguments.model,
                           [&] { return gltf::export_skin(binding, surface, options, animation); });
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
      "Each control point becomes a joint (control_point_0 and so on) that only translates.\n"
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
  add_rate_option(*command, a.poses, add_pose_option(*command, a.poses));
  command->add_option("-k,--max-influences", a.options.max_influences,
                      "maximum influences per vertex, 4 or 8 (default: 8)");
  command
      ->add_option("-o,--output", a.output,
                   "skin: .glb, .usda, or .py for vertex groups in Blender")
      ->required();
  add_up_option(*command, a.up);
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

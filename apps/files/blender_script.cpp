// SPDX-License-Identifier: BSD-3-Clause
#include "files/blender_script.h"

#include <sstream>
#include <vector>

#include "flbc/bounding_box.h"

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

}  // namespace

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

template std::string blender_script(const PointList<2>&, const SparseWeights&);
template std::string blender_script(const PointList<3>&, const SparseWeights&);

}  // namespace flbc::app

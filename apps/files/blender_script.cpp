// SPDX-License-Identifier: BSD-3-Clause
#include "files/blender_script.h"

#include <sstream>

#include "flbc/bounding_box.h"

namespace flbc::app {
namespace {

constexpr const char* kHead = R"(# Written by flbc export. In Blender: import the model, select it, and run this as a script.
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

}  // namespace

template <int Dim>
std::string blender_script(const PointList<Dim>& control_points, const WeightMatrix& weights) {
  constexpr double kBoneLength = 0.02;  // of the cage's size
  std::ostringstream text;
  text.precision(9);
  text << kHead << "NUM_VERTICES = " << weights.cols() << "\nBONE_LENGTH = "
       << kBoneLength * bounding_box_diagonal<Dim>(control_points) << "\nCONTROL_POINTS = [\n";
  for (Eigen::Index i = 0; i < control_points.cols(); ++i) {
    text << "    (" << control_points(0, i) << ", " << control_points(1, i) << ", "
         << (Dim == 3 ? control_points(Dim - 1, i) : 0) << "),\n";
  }
  text << "]\nINFLUENCES = [  # per control point: vertex, weight\n";
  for (Eigen::Index i = 0; i < weights.rows(); ++i) {
    text << "    [";
    for (Eigen::Index v = 0; v < weights.cols(); ++v) {
      if (weights(i, v) > 0) text << '(' << v << ", " << weights(i, v) << "), ";
    }
    text << "],\n";
  }
  text << "]\n" << kTail;
  return text.str();
}

template std::string blender_script(const PointList<2>&, const WeightMatrix&);
template std::string blender_script(const PointList<3>&, const WeightMatrix&);

}  // namespace flbc::app

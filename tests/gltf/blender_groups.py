# SPDX-License-Identifier: BSD-3-Clause
# Whether the vertex groups and bones that flbc export writes for Blender move a model as flbc
# deform does:
#   blender ... --python blender_groups.py -- MODEL.obj GROUPS.py CAGE.obj POSE.obj MOVED.obj
# Positions may differ by 1e-6 of the size.
import sys

import bpy
from mathutils import Matrix, Vector

TOLERANCE = 1e-6


def read_points(path):
    with open(path) as file:
        rows = [line.split() for line in file if line.startswith('v ')]
    return [Vector((float(x), float(y), float(z))) for _, x, y, z, *_ in rows]


model_file, script, cage, pose, moved = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.wm.obj_import(filepath=model_file)
model = bpy.context.selected_objects[0]
bpy.context.view_layer.objects.active = model
with open(script) as file:
    exec(compile(file.read(), script, 'exec'))
armature = bpy.data.objects['cage']
for i, (before, after) in enumerate(zip(read_points(cage), read_points(pose))):
    bone = armature.pose.bones[f'control_point_{i}']
    bone.matrix = Matrix.Translation(after - before) @ bone.bone.matrix_local
bpy.context.view_layer.update()
expected = read_points(moved)
size = max((a - expected[0]).length for a in expected)
mesh = model.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
error = max((v.co - point).length for v, point in zip(mesh.vertices, expected)) / size
if len(mesh.vertices) != len(expected) or error > TOLERANCE:
    raise SystemExit(f'{script}: vertices are {error} of the size away from flbc deform')
print(f'{script}: {error:.2g} of the size from flbc deform')

# SPDX-License-Identifier: BSD-3-Clause
# Whether Blender moves a skin of flbc export as flbc deform moves the model, and draws short bones:
#   blender --background --factory-startup --python blender.py -- SKIN.glb CAGE.obj POSE.obj MOVED.obj
# Positions may differ by 1e-6 of the size; of the bones' lengths the median is looked at.
import statistics
import sys

import bpy
import numpy
from mathutils import Matrix, Vector

TOLERANCE = 1e-6
LONGEST_BONE = 1 / 20


def read_points(path):
    """The vertices of an .obj file as Blender turns a skin: glTF's y is its z."""
    with open(path) as file:
        rows = [Vector(map(float, line.split()[1:4])) for line in file if line.startswith('v ')]
    return [Vector((p.x, -p.z, p.y)) for p in rows]


def require(condition, message):
    if not condition:
        raise SystemExit(f'{skin}: {message}')


if not hasattr(numpy, 'bool'):  # Debian's Blender needs a name that Debian's NumPy has no more
    numpy.bool = bool
skin, cage, pose, moved = sys.argv[sys.argv.index('--') + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=skin)
mesh = next(item for item in bpy.data.objects
            if item.type == 'MESH' and any(m.type == 'ARMATURE' for m in item.modifiers))
armature = next(item for item in bpy.data.objects if item.type == 'ARMATURE')

expected = read_points(moved)
size = max((a - expected[0]).length for a in expected)
length = statistics.median(bone.length for bone in armature.data.bones) / size
require(length <= LONGEST_BONE, f'bones are {length} of the size long, half of them more')
for i, (before, after) in enumerate(zip(read_points(cage), read_points(pose))):
    bone = armature.pose.bones[f'control_point_{i}']
    bone.matrix = Matrix.Translation(after - before) @ bone.bone.matrix_local
bpy.context.view_layer.update()
evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
found = [evaluated.matrix_world @ vertex.co for vertex in evaluated.to_mesh().vertices]
require(len(found) == len(expected), f'{len(found)} vertices, expected {len(expected)}')
error = max((a - b).length for a, b in zip(found, expected)) / size
require(error <= TOLERANCE, f'vertices are {error} of the size away from flbc deform')
print(f'{skin}: {error:.2g} of the size from flbc deform, bones {length:.2g} long')

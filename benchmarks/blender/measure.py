# SPDX-License-Identifier: BSD-3-Clause
"""Times and errors of the Blender add-on, and of Blender's own modifier Mesh Deform:
  blender --background --factory-startup --python measure.py -- FLBC ADDON MODEL.obj CAGE.obj
ADDON is the folder of the add-on. Prints a line per method. Times are medians.
"""
import statistics
import sys
import time
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / 'tests' / 'blender'))
import scene  # noqa: E402

PROGRAM, ADDON, MODEL, CAGE = scene.arguments()
sys.path.insert(0, str(Path(ADDON).parent))
FRAMES = 30


def new_scene():
    scene.enable(PROGRAM)
    bpy.context.scene.flbc.cage = cage = scene.load(CAGE)
    model = scene.load(MODEL)
    scene.select(model)
    return model, cage


def add_pose(cage):
    cage.shape_key_add(name='Basis', from_mix=False)
    cage.shape_key_add(name='Pose', from_mix=False).value = 1


def posed(cage, points):
    """Seconds until Blender has the model for this pose."""
    start = time.perf_counter()
    scene.set_key(cage, 'Pose', points)
    bpy.context.view_layer.update()
    return time.perf_counter() - start


def measure(model, cage):
    """Milliseconds per frame, and the largest error of an affine map, relative to the cage size."""
    rest = scene.base(cage)
    random = np.random.default_rng(1)
    frames = [posed(cage, rest + 0.02 * scene.size(rest) * random.normal(size=rest.shape))
              for _ in range(FRAMES)]
    linear = np.array([[2, 0.3, 0], [0, 0.7, 0.2], [-0.4, 0, 1.5]])
    posed(cage, rest @ linear)
    affine = np.abs(scene.shown(model) - scene.base(model) @ linear).max() / scene.size(rest)
    return 1e3 * statistics.median(frames), affine


def bound_by_addon(quality, influences, binds):
    model, cage = new_scene()
    bpy.context.scene.flbc.quality = quality
    bpy.context.scene.flbc.influences = influences
    seconds = []
    for _ in range(binds):
        start = time.perf_counter()
        bpy.ops.flbc.bind()
        seconds.append(time.perf_counter() - start)
    rest = scene.base(cage)
    pose = rest + 0.05 * scene.size(rest) * np.random.default_rng(2).normal(size=rest.shape)
    posed(cage, pose)
    expected = scene.follow(model, pose, scene.relative(model, cage))
    error = np.abs(scene.shown(model) - expected).max() / scene.size(rest)
    weights = scene.influences(model)[1]
    frame, affine = measure(model, cage)
    print(f'{quality} {influences}: bind {statistics.median(seconds):.2f} s, frame {frame:.1f} ms, '
          f'pose error {error:.1e}, affine error {affine:.1e}, '
          f'{(weights > 1e-3).sum(1).mean():.1f} influences above 1e-3')


def bound_by_nothing():
    """What a frame takes without weights: the mesh is copied and gets normals."""
    from local_barycentric_cage import compat
    model, cage = new_scene()
    add_pose(cage)
    modifier = model.modifiers.new('cage', 'NODES')
    modifier.node_group = group = bpy.data.node_groups.new('empty', 'GeometryNodeTree')
    for add, name, kind in ((compat.add_input, 'Geometry', 'NodeSocketGeometry'),
                            (compat.add_input, 'Cage', 'NodeSocketObject'),
                            (compat.add_output, 'Geometry', 'NodeSocketGeometry')):
        add(group, name, kind)
    group.links.new(group.nodes.new('NodeGroupInput').outputs['Geometry'],
                    group.nodes.new('NodeGroupOutput').inputs['Geometry'])
    compat.set_input(modifier, 'Cage', cage)
    print(f'empty node group: frame {measure(model, cage)[0]:.1f} ms')


def bound_by_mesh_deform(precision):
    model, cage = new_scene()
    add_pose(cage)
    modifier = model.modifiers.new('cage', 'MESH_DEFORM')
    modifier.object = cage
    modifier.precision = precision
    start = time.perf_counter()
    bpy.ops.object.meshdeform_bind(modifier=modifier.name)
    seconds = time.perf_counter() - start
    frame, affine = measure(model, cage)
    print(f'Mesh Deform {precision}: bind {seconds:.2f} s, frame {frame:.1f} ms, '
          f'affine error {affine:.1e}')


print(f'{Path(MODEL).name}, Blender {bpy.app.version_string}')
bound_by_nothing()
for quality, influences, binds in (('DRAFT', '8', 5), ('GOOD', '8', 5), ('GOOD', '4', 5),
                                   ('EXACT', '8', 1)):
    bound_by_addon(quality, influences, binds)
for precision in (5, 6):
    bound_by_mesh_deform(precision)

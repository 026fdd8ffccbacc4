# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the Blender add-on with the sample limb, for blender.sh:
  blender --python blender.py -- FLBC MESHES panel PICTURE.png              (in a window)
  blender --background --python blender.py -- FLBC MESHES moved PICTURE.png
"""
import os
import subprocess
import sys
from pathlib import Path

import bpy
from mathutils import Euler, Matrix, Vector

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / 'tests' / 'blender'))
import scene  # noqa: E402

PROGRAM, MESHES, KIND, PICTURE = scene.arguments()
# Clay and ink of the program's pictures, as linear light.
SKIN, WIRE = (0.67, 0.54, 0.42, 1), (0.015, 0.02, 0.03, 1)
MOVED, HELD = (0.75, 0.16, 0.02, 1), (0.6, 0.01, 0.02, 1)
TURN = Euler((0.9, 0, 0.2)).to_matrix()  # of the camera


def smooth(item):
    for face in item.data.polygons:
        face.use_smooth = True


def bound_limb():
    model = scene.load(f'{MESHES}/3d/limb_model.obj')
    cage = scene.load(f'{MESHES}/3d/limb_cage.obj')
    cage.display_type = 'WIRE'
    smooth(model)
    bpy.context.scene.flbc.cage = cage
    scene.select(model)
    bpy.ops.flbc.bind()
    model.color = SKIN
    return model, cage


def material(color, roughness):
    made = bpy.data.materials.new('material')
    made.use_nodes = True
    surface = made.node_tree.nodes['Principled BSDF']
    surface.inputs['Base Color'].default_value = color
    surface.inputs['Roughness'].default_value = roughness
    return made


def as_tubes(cage):
    """The edges of a cage as a mesh that is rendered."""
    wire = cage.copy()
    bpy.context.collection.objects.link(wire)
    wire.display_type = 'SOLID'
    modifier = wire.modifiers.new('wire', 'WIREFRAME')
    modifier.thickness = 0.005 * scene.size(scene.base(cage))
    wire.data.materials.append(material(WIRE, 0.4))
    wire.visible_shadow = False
    cage.hide_render = True
    return wire


def center(items):
    bpy.context.view_layer.update()
    corners = [item.matrix_world @ Vector(corner) for item in items for corner in item.bound_box]
    low, high = (Vector(map(pick, zip(*corners))) for pick in (min, max))
    return (low + high) / 2, (high - low).length


def pose_limb(cage):
    from local_barycentric_cage import files
    scene.set_key(cage, 'Pose', files.read_obj(f'{MESHES}/3d/limb_cage_pose.obj')[0])


def take_moved():
    """One control point is dragged. Vertices that move by more than 1% of the drag are tinted: on the
    left by Blender's Mesh Deform, on the right by the add-on."""
    model, cage = bound_limb()
    other = model.copy()
    other.data = model.data.copy()
    other.modifiers.clear()
    bpy.context.collection.objects.link(other)
    by_blender = other.modifiers.new('Mesh Deform', 'MESH_DEFORM')
    by_blender.object, by_blender.precision = cage, 5
    scene.select(other)
    bpy.ops.object.meshdeform_bind(modifier=by_blender.name)
    rest, base = scene.shown(model), scene.base(cage)
    drag = 0.12 * scene.size(rest)

    base[33, 2] += drag  # at the wrist
    scene.set_key(cage, 'Pose', base)
    bpy.context.view_layer.update()
    tinted = [((scene.shown(item) - rest)**2).sum(axis=1)**0.5 > 0.01 * drag for item in (other, model)]
    skin = material(SKIN, 0.5)
    tint = skin.node_tree.nodes.new('ShaderNodeVertexColor')
    tint.layer_name = 'moved'
    skin.node_tree.links.new(tint.outputs[0], skin.node_tree.nodes['Principled BSDF'].inputs[0])
    faces = [tuple(face.vertices) for face in model.data.polygons]
    wire, items = as_tubes(cage), []
    for item, moved in zip((other, model), tinted):
        both = scene.add('moved', scene.shown(item), faces), wire.copy()
        bpy.context.collection.objects.link(both[1])
        colors = both[0].data.color_attributes.new('moved', 'FLOAT_COLOR', 'POINT')
        for color, is_moved in zip(colors.data, moved):
            color.color = MOVED if is_moved else SKIN
        both[0].data.materials.append(skin)
        smooth(both[0])
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.02 * scene.size(rest), location=base[33])
        both += (bpy.context.object,)
        both[2].data.materials.append(material(HELD, 0.4))
        for part in both:
            part.location += TURN @ Vector((len(items) / 3 * 1.08 * scene.size(rest), 0, 0))
        items += both
        item.hide_render = True
    wire.hide_render = True
    render(items)


def render(items):
    middle, size = center(items)
    camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    camera.data.type = 'ORTHO'
    camera.data.ortho_scale = 1.02 * size
    camera.data.shift_y = 0.02
    place = middle + TURN @ Vector((0, 0, 2 * size))
    camera.matrix_world = Matrix.Translation(place) @ TURN.to_4x4()
    sun = bpy.data.objects.new('sun', bpy.data.lights.new('sun', 'SUN'))
    sun.data.energy = 3
    sun.matrix_world = (TURN @ Euler((-0.6, 0.5, 0)).to_matrix()).to_4x4()
    for item in (camera, sun):
        bpy.context.collection.objects.link(item)
    view = bpy.context.scene
    view.camera = camera
    view.world = bpy.data.worlds.new('world')
    view.world.use_nodes = True
    view.world.node_tree.nodes['Background'].inputs['Color'].default_value = (1, 1, 1, 1)
    view.world.node_tree.nodes['Background'].inputs['Strength'].default_value = 0.6
    view.render.engine = 'CYCLES'
    view.cycles.samples = 64
    view.cycles.use_denoising = False  # Debian's Blender cannot
    view.view_settings.view_transform = 'Standard'
    view.render.film_transparent = True
    view.render.resolution_x, view.render.resolution_y = 1200, 400
    view.render.resolution_percentage = 100
    view.render.filepath = PICTURE
    bpy.ops.render.render(write_still=True)


def take_panel():
    pose_limb(bound_limb()[1])
    there = scene.viewport()
    event = there['window'].event_simulate
    place = {'x': there['area'].x + there['area'].width // 2,
             'y': there['area'].y + there['area'].height // 2}
    event(type='MOUSEMOVE', value='NOTHING', **place)
    event(type='SPACE', value='PRESS', ctrl=True, **place)
    yield
    scene.viewport()['area'].spaces.active.shading.color_type = 'OBJECT'
    with bpy.context.temp_override(**scene.viewport()):
        bpy.ops.view3d.view_all(center=True)
    yield from scene.show_panel()
    # Blender 4.3 takes black pictures of itself there.
    subprocess.run(['import', '-window', 'root', PICTURE], check=True)
    os._exit(0)


scene.enable(PROGRAM)
if KIND == 'panel':
    steps = take_panel()
    bpy.app.timers.register(lambda: next(steps) or 0.3, first_interval=0.5)
else:
    take_moved()

# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of the tests, and what the add-on should do with them, computed by NumPy."""
import sys
from pathlib import Path

import bpy
import numpy as np

ADDON = 'local_barycentric_cage'


def arguments():
    return sys.argv[sys.argv.index('--') + 1:]


def enable(program):
    """Enables the add-on that is installed, in an empty file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.preferences.addon_enable(module=ADDON)
    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.addons[ADDON].preferences.path = program


def add(name, points, faces):
    data = bpy.data.meshes.new(name)
    data.from_pydata([tuple(point) for point in points], [], faces)
    item = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(item)
    return item


def load(path):
    from local_barycentric_cage import files
    return add(Path(path).stem, *files.read_obj(path))


def select(*items):
    """Selects objects. The last one becomes the active one."""
    bpy.ops.object.select_all(action='DESELECT')
    for item in items:
        item.select_set(True)
    bpy.context.view_layer.objects.active = items[-1]


def numbers(items, name, dtype=np.float32, width=1):
    flat = np.empty(width * len(items), dtype)
    items.foreach_get(name, flat)
    return flat.reshape(-1, width) if width > 1 else flat


def base(item):
    """Positions of the mesh, without shape keys and modifiers."""
    keys = item.data.shape_keys
    vertices = keys.reference_key.data if keys else item.data.vertices
    return numbers(vertices, 'co', width=3).astype(float)


def shown(item):
    """Positions as Blender shows them, in the space of the object."""
    graph = bpy.context.evaluated_depsgraph_get()
    return numbers(item.evaluated_get(graph).data.vertices, 'co', width=3).astype(float)


def size(points):
    return np.linalg.norm(np.ptp(points, axis=0))


def influences(model):
    """Indices and weights of all vertices, each (V, k)."""
    attributes = model.data.attributes
    count = sum(a.name.startswith('flbc_index_') for a in attributes)
    return tuple(np.stack([numbers(attributes[f'flbc_{kind}_{k}'].data, 'value', dtype)
                           for k in range(count)], axis=1)
                 for kind, dtype in (('index', np.int32), ('weight', np.float32)))


def follow(model, cage_points, relative, start=None):
    """Where the model should be, in its space. start: its positions before, default: the base."""
    index, weight = influences(model)
    rest = numbers(model.data.attributes['flbc_rest'].data, 'vector', width=3).astype(float)
    control = cage_points @ relative[:3, :3].T + relative[:3, 3]
    moved = np.einsum('vk,vkx->vx', weight.astype(float), control[index])
    return (base(model) if start is None else start) + moved - rest


def relative(model, cage):
    bpy.context.view_layer.update()
    return np.linalg.inv(np.array(model.matrix_world)) @ np.array(cage.matrix_world)


def set_key(item, name, points):
    keys = item.data.shape_keys.key_blocks
    key = keys[name] if name in keys else item.shape_key_add(name=name, from_mix=False)
    key.data.foreach_set('co', np.asarray(points, np.float32).ravel())
    item.data.update()
    item.update_tag()
    return key


def viewport(kind='WINDOW'):
    """The 3D viewport and one of its regions, for temp_override."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == 'VIEW_3D')
    region = next(region for region in area.regions if region.type == kind)
    return {'window': window, 'area': area, 'region': region}


def show_panel():
    """Steps that open the tab of the add-on in the sidebar: clicks on its tabs until it is drawn.

    Blender must run with --enable-event-simulate.
    """
    from local_barycentric_cage import panel
    drawn, draw = [], panel.FLBC_PT_cage.draw

    def noted(self, context):
        drawn.append(True)
        draw(self, context)
    panel.FLBC_PT_cage.draw = noted
    viewport()['area'].spaces.active.show_region_ui = True
    yield
    region, event = viewport('UI')['region'], viewport()['window'].event_simulate
    x, top = region.x + region.width - 10, region.y + region.height
    for y in range(top - 10, region.y, -15):
        event(type='MOUSEMOVE', value='NOTHING', x=x, y=y)
        event(type='LEFTMOUSE', value='PRESS', x=x, y=y)
        event(type='LEFTMOUSE', value='RELEASE', x=x, y=y)
        yield
        if drawn:
            return
    raise AssertionError('the tab of the add-on was not found')

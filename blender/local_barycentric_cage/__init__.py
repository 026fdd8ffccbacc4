# SPDX-License-Identifier: BSD-3-Clause
"""Cage deformation by local barycentric coordinates, computed by the program flbc."""
import atexit

import bpy

from . import binding, operators, panel, preferences

bl_info = {  # for Blender before 4.2; later versions read blender_manifest.toml
    'name': 'Local Barycentric Cage',
    'description': 'Deform meshes with cages: local, exact at rest, few influences',
    'version': (0, 3, 1),
    'blender': (3, 4, 0),
    'location': '3D Viewport > Sidebar > Cage',
    'category': 'Rigging',
}

_CLASSES = (*preferences.CLASSES, binding.Binding, *operators.CLASSES, *panel.CLASSES)


def register():
    for item in _CLASSES:
        bpy.utils.register_class(item)
    atexit.register(operators.stop)
    bpy.types.Scene.flbc = bpy.props.PointerProperty(type=preferences.SceneSettings)
    bpy.types.Object.flbc = bpy.props.PointerProperty(type=binding.Binding)


def unregister():
    operators.stop()
    atexit.unregister(operators.stop)
    del bpy.types.Object.flbc
    del bpy.types.Scene.flbc
    for item in reversed(_CLASSES):
        bpy.utils.unregister_class(item)

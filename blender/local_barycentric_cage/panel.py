# SPDX-License-Identifier: BSD-3-Clause
"""The panel in the sidebar of the 3D viewport."""
import textwrap
import time

import bpy

from . import binding, compat, nodes, operators, preferences, skin
from .program import Refusal

_SECONDS = 1.0  # for which the state of a model counts as known
_known = {}  # model: time, problems


def _problems(model):
    """As binding.problems(), which is too slow for every redraw of a large model."""
    when, found = _known.get(model.name, (0, []))
    if time.monotonic() - when > _SECONDS:
        found = binding.problems(model)
        _known.clear()
        _known[model.name] = time.monotonic(), found
    return found


def _text(layout, text, icon):
    """Draws lines as long as the sidebar is wide."""
    letter = 8.5 * bpy.context.preferences.system.ui_scale
    columns = max(16, int(bpy.context.region.width / letter))
    column = layout.column(align=True)
    for line in textwrap.wrap(text, columns):
        column.label(text=line, icon=icon)
        icon = 'BLANK1'


class FLBC_PT_cage(bpy.types.Panel):
    bl_label = 'Local Barycentric Cage'
    bl_space_type = 'VIEW_3D'
    bl_region_type = 'UI'
    bl_category = 'Cage'

    def draw(self, context):
        layout = self.layout
        try:
            preferences.program(context)
        except Refusal as refusal:
            _text(layout, str(refusal), 'ERROR')
            button = layout.operator('preferences.addon_show', text='Open Preferences')
            button.module = __package__
            return
        self._draw_making(context)
        self._draw_binding(context)
        if operators.running:
            text, part = operators.running.progress()
            compat.show_progress(layout, part, text)
            layout.operator('flbc.cancel', icon='CANCEL')
        for model in operators.bound_models(context)[:1]:
            self._draw_state(model)

    def _draw_making(self, context):
        column = self.layout.column()
        column.prop(context.scene.flbc, 'control_points')
        column.operator('flbc.make_cage', icon='MESH_ICOSPHERE')
        column.separator()
        column.label(text='Cage')
        column.prop(context.scene.flbc, 'cage', text='')

    def _draw_binding(self, context):
        scene = context.scene.flbc
        column = self.layout.column()
        row = column.row(align=True)
        row.label(text='Influences')
        row.prop(scene, 'influences', expand=True)
        column.prop(scene, 'smoothness')
        column.row(align=True).prop(scene, 'quality', expand=True)
        models = operators.selected_models(context)
        groups = binding.locking_groups(models, scene.cage) if scene.cage else []
        if groups:
            _text(column, 'Control points never move vertices of the same group: '
                  + ', '.join(groups), 'LOCKED')
            column.prop(scene, 'falloff')
        solid = binding.solid_groups(models)
        if solid:
            _text(column, 'Vertices of these groups stay solid: '
                  + ', '.join(sorted({name for _, name in solid})), 'MOD_SOLIDIFY')
        text = f'Bind {models[0].name}' if len(models) == 1 else f'Bind {len(models)} Meshes'
        column.operator('flbc.bind', text=text if models else 'Bind to Cage', icon='MOD_MESHDEFORM')

    def _draw_state(self, model):
        box = self.layout.box()
        cage = nodes.cage_of(model)
        if cage:
            quality = model.flbc.quality.capitalize()
            leader = cage.name if nodes.modifier_of(model).show_viewport else f'bones of {cage.name}'
            _text(box, f'{model.name} follows {leader} ({quality})', 'CHECKMARK')
            if skin.armature_of(cage):
                box.operator('flbc.skin', icon='ARMATURE_DATA')
        if model.data.shape_keys:
            box.operator('flbc.transfer_keys', icon='SHAPEKEY_DATA')
        for text in [*_problems(model), *filter(None, [model.flbc.note])]:
            _text(box, text, 'ERROR')
        row = box.row(align=True)
        row.operator('flbc.rebind')
        row.operator('flbc.unbind')
        row.operator('flbc.apply')


CLASSES = (FLBC_PT_cage,)

# SPDX-License-Identifier: BSD-3-Clause
"""Settings of the user and of the scene."""
import bpy

from . import program as flbc


class FlbcPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    path: bpy.props.StringProperty(
        name='Program', subtype='FILE_PATH',
        description='Path of the program flbc. If it is empty, the search path is used')

    def draw(self, _context):
        self.layout.prop(self, 'path')


class SceneSettings(bpy.types.PropertyGroup):
    cage: bpy.props.PointerProperty(
        name='Cage', type=bpy.types.Object, poll=lambda _self, item: item.type == 'MESH',
        description='Closed mesh around the models')
    control_points: bpy.props.IntProperty(
        name='Control Points', default=0, min=0, max=5000,
        description='Maximum number of vertices of a new cage. 0: depends on the shape')
    influences: bpy.props.EnumProperty(
        name='Influences', default='8',
        items=(('4', '4', 'At most 4 control points move a vertex'),
               ('8', '8', 'At most 8 control points move a vertex')))
    smoothness: bpy.props.FloatProperty(
        name='Smoothness', default=0.003, min=0, max=0.03, precision=4, step=0.1,
        description='Removes creases, but control points reach farther. 0: as local as possible')
    falloff: bpy.props.FloatProperty(
        name='Falloff', default=0, min=0, max=0.3, precision=2, step=1,
        description='Width of the band next to protected vertices in which weights fade out, as a '
                    'part of the size of the cage. 0: they may end in a crease')
    quality: bpy.props.EnumProperty(
        name='Quality', default='GOOD',
        items=(('DRAFT', 'Draft', 'Bind at once, and refine in the background'),
               ('GOOD', 'Good', 'Compute once, and interpolate at the vertices'),
               ('EXACT', 'Exact', 'Compute at every vertex of the models. All must be inside')))


def program(context):
    """The path of the program flbc. Raises program.Refusal if it is missing."""
    return flbc.find(context.preferences.addons[__package__].preferences.path)


CLASSES = (FlbcPreferences, SceneSettings)

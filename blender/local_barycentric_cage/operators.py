# SPDX-License-Identifier: BSD-3-Clause
"""Buttons of the panel. From the user interface they work in the background, from scripts not."""
import bpy

from . import binding, keys, nodes, preferences, program, skin
from .program import Refusal

running = None  # the Job in the background


def stop():
    """Stops the Job in the background."""
    global running
    if running:
        running.cancel()
        running = None


def selected_models(context):
    """Selected meshes except for the cage."""
    cage = context.scene.flbc.cage
    return [item for item in context.selected_objects if item.type == 'MESH' and item != cage]


def bound_models(context):
    """Selected models that are bound, and those that are bound to a selected cage."""
    selected = set(context.selected_objects)
    return [item for item in context.view_layer.objects if item.type == 'MESH'
            and nodes.modifier_of(item) and (item in selected or nodes.cage_of(item) in selected)]


def choose_cage(context):
    """The cage of the panel. If it is empty, the other one of two selected meshes becomes it."""
    scene = context.scene.flbc
    meshes = selected_models(context)
    if not scene.cage and len(meshes) == 2 and context.active_object in meshes:
        meshes.remove(context.active_object)
        scene.cage = meshes[0]
    if not scene.cage:
        raise Refusal('Choose a cage in the panel, or select one model and then Make a Cage')
    return scene.cage


class _AtOnce:
    """Operators without the program."""
    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        return context.mode == 'OBJECT' and not running and bool(bound_models(context))

    def execute(self, context):
        try:
            self.change_models(context)
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        return {'FINISHED'}

    def change_models(self, context):
        for model in bound_models(context):
            self.change(model)


class _InBackground:
    """Operators that are a Job."""
    bl_options = {'UNDO'}

    def execute(self, context):
        try:
            program.Job(self.steps(context, False)).run()
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        return {'FINISHED'}

    def invoke(self, context, _event):
        global running
        try:
            job = program.Job(self.steps(context, True))
            job.poll()  # reads the meshes now: references to objects do not outlive undo
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return {'CANCELLED'}
        running = job
        manager = context.window_manager
        self._timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type != 'TIMER':
            return {'PASS_THROUGH'}
        for area in context.window.screen.areas:
            if area.type == 'VIEW_3D':
                area.tag_redraw()
        if not running:
            return self._end(context, {'CANCELLED'})
        try:
            if not running.poll():
                return {'PASS_THROUGH'}
        except Refusal as refusal:
            self.report({'ERROR'}, str(refusal))
            return self._end(context, {'CANCELLED'})
        except Exception:
            self._end(context, {'CANCELLED'})
            raise
        return self._end(context, {'FINISHED'})

    def _end(self, context, result):
        global running
        running = None
        context.window_manager.event_timer_remove(self._timer)
        return result


def _settings(context):
    scene = context.scene.flbc
    return binding.Settings(preferences.program(context), int(scene.influences),
                            scene.smoothness, scene.quality, scene.falloff)


class FLBC_OT_make_cage(_InBackground, bpy.types.Operator):
    bl_idname = 'flbc.make_cage'
    bl_label = 'Make a Cage'
    bl_description = (
        'Make a cage around the selected meshes. Weights of a vertex group named '
        f'"{binding.DENSITY}" add control points: at weight 1, {binding.MOST_DENSE} times as many')

    @classmethod
    def poll(cls, context):
        return (context.mode == 'OBJECT' and not running and context.active_object is not None
                and context.active_object.type == 'MESH')

    def steps(self, context, _refine):
        active = context.active_object
        models = [active] + [item for item in context.selected_objects
                             if item.type == 'MESH' and item != active]
        return binding.make_cage(models, active, preferences.program(context),
                                 context.scene.flbc.control_points)


class FLBC_OT_bind(_InBackground, bpy.types.Operator):
    bl_idname = 'flbc.bind'
    bl_label = 'Bind to Cage'
    bl_description = (
        'Bind the selected meshes to the cage. They then follow its vertices. If the cage and a mesh '
        f'have a vertex group of the same name that starts with "{binding.LOCK}", the vertices of '
        'the cage in it never move those of the mesh. Vertices of a group that starts with '
        f'"{binding.SOLID}" move together by one affine map')

    @classmethod
    def poll(cls, context):
        return context.mode == 'OBJECT' and not running and bool(selected_models(context))

    def steps(self, context, refine):
        cage = choose_cage(context)
        return binding.bind(selected_models(context), cage, _settings(context), refine)


class FLBC_OT_rebind(_InBackground, bpy.types.Operator):
    """Bind again after changes of the model or of the rest shape of the cage. The pose remains"""
    bl_idname = 'flbc.rebind'
    bl_label = 'Rebind'

    @classmethod
    def poll(cls, context):
        return context.mode == 'OBJECT' and not running and bool(bound_models(context))

    def steps(self, context, refine):
        models = bound_models(context)
        cages = {nodes.cage_of(model) for model in models}
        if len(cages) > 1 or None in cages:
            raise Refusal('Select models of one cage')
        return binding.bind(models, cages.pop(), _settings(context), refine)


class FLBC_OT_skin(_AtOnce, bpy.types.Operator):
    bl_idname = 'flbc.skin'
    bl_label = 'Weights from Cage'
    bl_description = (
        'Give all models of the cage vertex groups named like the bones that skin it. Their armature '
        'then poses the models, and their modifiers of the cage are turned off')

    existing: bpy.props.EnumProperty(
        name='Existing Weights', default='REPLACE',
        items=(('REPLACE', 'Replace', 'Vertices get new weights in vertex groups named like bones'),
               ('KEEP', 'Keep', 'Vertices with weights in such vertex groups keep them')))

    def change_models(self, context):
        cages = {nodes.cage_of(model) for model in bound_models(context)} - {None}
        models = [item for item in context.view_layer.objects
                  if item.type == 'MESH' and nodes.cage_of(item) in cages]
        bones = {cage: skin.bones_of(cage) for cage in cages}
        weights = [skin.weights_of(model, bones[nodes.cage_of(model)][1],
                                   int(context.scene.flbc.influences)) for model in models]
        for model, found in zip(models, weights):
            names = bones[nodes.cage_of(model)][0]
            difference = skin.write(model, names, found, self.existing == 'REPLACE')
            self.report({'INFO'}, f'{model.name}: {len(names)} bones. Largest difference from the '
                                  f'pose of the cage: {difference:.2%} of the size')


class FLBC_OT_transfer_keys(_AtOnce, bpy.types.Operator):
    bl_idname = 'flbc.transfer_keys'
    bl_label = 'Transfer Shape Keys'
    bl_description = (
        'Give the other selected models of the cage, such as garments, the shape keys of the active '
        'one. They move with the cage that is fitted to each key')

    @classmethod
    def poll(cls, context):
        body = context.active_object
        return (super().poll(context) and body in bound_models(context)
                and body.data.shape_keys is not None)

    def change_models(self, context):
        body = context.active_object
        others = [model for model in bound_models(context) if model != body]
        if not others or {nodes.cage_of(model) for model in others} != {nodes.cage_of(body)}:
            raise Refusal(f'Select models of the same cage, and {body.name} last: they get its '
                          'shape keys')
        count, distance = keys.transfer(body, others)
        self.report({'INFO'}, f'{count} shape keys, {len(others)} models. The cage fits those of '
                              f'{body.name} up to {distance:.2%} of the size')


class FLBC_OT_unbind(_AtOnce, bpy.types.Operator):
    """Remove the binding. The model returns to its rest shape"""
    bl_idname = 'flbc.unbind'
    bl_label = 'Unbind'

    change = staticmethod(binding.unbind)


class FLBC_OT_apply(_AtOnce, bpy.types.Operator):
    """Keep the present shape of the model, and remove the binding"""
    bl_idname = 'flbc.apply'
    bl_label = 'Apply'

    change = staticmethod(binding.apply)


class FLBC_OT_cancel(bpy.types.Operator):
    """Stop the program that runs in the background"""
    bl_idname = 'flbc.cancel'
    bl_label = 'Cancel'

    @classmethod
    def poll(cls, _context):
        return running is not None

    def execute(self, _context):
        stop()
        return {'FINISHED'}


CLASSES = (FLBC_OT_make_cage, FLBC_OT_bind, FLBC_OT_rebind, FLBC_OT_skin,
           FLBC_OT_transfer_keys, FLBC_OT_unbind, FLBC_OT_apply, FLBC_OT_cancel)

# SPDX-License-Identifier: BSD-3-Clause
"""Bones that skin a cage skin its models: vertex groups with the product of both weights."""
import bpy
import numpy as np

from . import binding, compat, mesh, nodes
from .program import Refusal


def armature_of(cage):
    """The Armature modifier of a cage, None if it has none with an armature."""
    return next((modifier for modifier in cage.modifiers
                 if modifier.type == 'ARMATURE' and modifier.object), None)


def _weights(item, names):
    """Weights of all vertices in vertex groups, (V, number of names)."""
    columns = {item.vertex_groups[name].index: k for k, name in enumerate(names)
               if name in item.vertex_groups}
    found = np.zeros((len(item.data.vertices), len(names)))
    for vertex in item.data.vertices:
        for part in vertex.groups:
            if part.group in columns:
                found[vertex.index, columns[part.group]] = part.weight
    return found


def bones_of(cage):
    """Names of the bones that skin a cage, and their weights, (control points, bones), with sum 1.

    Raises Refusal.
    """
    armature = armature_of(cage)
    if not armature:
        raise Refusal(f'The cage {cage.name} has no armature. Parent it to one, for example with '
                      'automatic weights')
    bones = armature.object.data.bones
    names = [group.name for group in cage.vertex_groups
             if group.name in bones and bones[group.name].use_deform]
    shares = _weights(cage, names)
    sums = shares.sum(1, keepdims=True)
    free = np.flatnonzero(sums[:, 0] == 0)
    if len(free):
        raise Refusal(f'{len(free)} of {len(sums)} vertices of the cage {cage.name} have no weights '
                      f'of bones, first vertex {free[0]}. Assign them to vertex groups named like '
                      'bones')
    return names, shares / sums


def weights_of(model, shares, influences):
    """The weights of a bound model for the bones, (V, bones), with sum 1. Raises Refusal."""
    binding.require_valid(model)
    found = sum(weight[:, None] * shares[index] for index, weight in mesh.read_binding(model.data))
    np.put_along_axis(found, np.argsort(-found, 1, kind='stable')[:, influences:], 0, 1)
    return found / found.sum(1, keepdims=True)


def _shown(model, modifier):
    """Positions of a model with one of its modifiers alone."""
    before = [(each, each.show_viewport) for each in model.modifiers]
    for each, _ in before:
        each.show_viewport = each == modifier
    found = mesh.places_of(model.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices)
    for each, was_shown in before:
        each.show_viewport = was_shown
    return found


def write(model, names, weights, replaces):
    """Writes vertex groups named like the bones, by which the armature poses the model.

    The modifier of the cage is turned off. replaces: else vertices keep the weights that they have
    for these bones. Returns the largest difference from the pose of the cage, relative to the size.
    """
    is_free = np.ones(len(weights), bool) if replaces else ~_weights(model, names).any(1)
    for name, column in zip(names, weights.T):
        group = model.vertex_groups.get(name)
        if group and replaces:
            group.remove(range(len(weights)))
        vertices = np.flatnonzero(is_free & (column > 0))
        if len(vertices):
            group = group or model.vertex_groups.new(name=name)
        for vertex in vertices:
            group.add([int(vertex)], column[vertex], 'REPLACE')
    by_cage = nodes.modifier_of(model)
    of_cage = armature_of(nodes.cage_of(model))
    armature = next((modifier for modifier in model.modifiers if modifier.type == 'ARMATURE'
                     and modifier.object == of_cage.object), None)
    if not armature:
        armature = model.modifiers.new(of_cage.object.name, 'ARMATURE')
        armature.object = of_cage.object
        compat.move_first(model, armature)
    armature.use_deform_preserve_volume = of_cage.use_deform_preserve_volume
    lengths = np.linalg.norm(_shown(model, armature) - _shown(model, by_cage), axis=1)
    by_cage.show_viewport = by_cage.show_render = False
    return lengths.max() / np.linalg.norm(np.ptp(mesh.shape_of(model.data).points, axis=0))

# SPDX-License-Identifier: BSD-3-Clause
"""The modifier: a node group that moves each vertex with the control points of its cage.

    position + sum_k weight_k position of control point(index_k) - rest

It reads the attributes of mesh.py and needs nothing else, so files work without the add-on. Rest is
where the weights put the vertex at rest, so the model is unchanged there, and changes by shape keys
or later edits of the model are added. If the cage or the model has another number of vertices than
when it was bound, the model stays at rest: new vertices have no weights, and the indices of
control points, which Blender interpolates for them, mean nothing.
"""
import bpy

from . import compat, mesh

MODIFIER = 'Local Barycentric Cage'
CAGE, COUNT, VERTICES = 'Cage', 'Control Points', 'Vertices'
_MARK = 'flbc_influences'
_NODES = 2  # changes whenever the nodes of a group do


def _socket(sockets, name):
    """The socket that is in use among those of the same name for other types."""
    return next(socket for socket in sockets if socket.name == name and socket.enabled)


class _Builder:
    def __init__(self, group):
        self._group = group
        self._column = 0

    def node(self, kind, **settings):
        node = self._group.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        self._column += 1
        node.location = (180 * self._column, 0)
        return node

    def link(self, output, target):
        self._group.links.new(output, target)

    def attribute(self, name, kind):
        node = self.node('GeometryNodeInputNamedAttribute', data_type=kind)
        node.inputs['Name'].default_value = name
        return _socket(node.outputs, 'Attribute')

    def vectors(self, operation, *operands):
        node = self.node('ShaderNodeVectorMath', operation=operation)
        for socket, operand in zip([s for s in node.inputs if s.enabled], operands):
            self.link(operand, socket)
        return _socket(node.outputs, 'Vector')


def _sample(builder, geometry, value, index):
    """A vector of a point of a geometry."""
    node = builder.node('GeometryNodeSampleIndex', data_type='FLOAT_VECTOR', domain='POINT')
    builder.link(geometry, node.inputs['Geometry'])
    builder.link(value, _socket(node.inputs, 'Value'))
    builder.link(index, node.inputs['Index'])
    return _socket(node.outputs, 'Value')


def _has_count(builder, geometry, count):
    """1 if a geometry has this number of points, else 0."""
    size = builder.node('GeometryNodeAttributeDomainSize', component='MESH')
    builder.link(geometry, size.inputs['Geometry'])
    equal = builder.node('ShaderNodeMath', operation='COMPARE')
    builder.link(size.outputs['Point Count'], equal.inputs[0])
    builder.link(count, equal.inputs[1])
    equal.inputs[2].default_value = 0.5
    return equal.outputs['Value']


def _product(builder, a, b):
    node = builder.node('ShaderNodeMath', operation='MULTIPLY')
    builder.link(a, node.inputs[0])
    builder.link(b, node.inputs[1])
    return node.outputs['Value']


def _fill(group, influences):
    builder = _Builder(group)
    inputs = builder.node('NodeGroupInput')
    info = builder.node('GeometryNodeObjectInfo', transform_space='RELATIVE')
    builder.link(inputs.outputs[CAGE], info.inputs['Object'])
    cage = info.outputs['Geometry']
    # Times 1, because Blender 3.4 reads computed vectors faster than positions.
    position = builder.vectors('SCALE',
                               builder.node('GeometryNodeInputPosition').outputs['Position'])
    place = None
    for k in range(influences):
        # Not MULTIPLY_ADD, because it needs a vector of each weight.
        part = builder.vectors('SCALE',
                               _sample(builder, cage, position,
                                       builder.attribute(mesh.index_name(k), 'INT')),
                               builder.attribute(mesh.weight_name(k), 'FLOAT'))
        place = builder.vectors('ADD', place, part) if place else part
    offset = builder.vectors('SUBTRACT', place, builder.attribute(mesh.REST, 'FLOAT_VECTOR'))
    move = builder.node('GeometryNodeSetPosition')
    builder.link(inputs.outputs['Geometry'], move.inputs['Geometry'])
    are_bound = _product(builder, _has_count(builder, cage, inputs.outputs[COUNT]),
                         _has_count(builder, inputs.outputs['Geometry'], inputs.outputs[VERTICES]))
    builder.link(are_bound, move.inputs['Selection'])
    builder.link(offset, move.inputs['Offset'])
    builder.link(move.outputs['Geometry'], builder.node('NodeGroupOutput').inputs['Geometry'])


def group_for(influences):
    """The node group for this number of influences. A file has at most one of each."""
    for group in bpy.data.node_groups:
        if (group.get(_MARK), group.get('flbc_nodes')) == (influences, _NODES) and not group.library:
            return group
    group = bpy.data.node_groups.new(f'{MODIFIER} ({influences})', 'GeometryNodeTree')
    compat.add_socket(group, 'Geometry', 'NodeSocketGeometry')
    compat.add_socket(group, CAGE, 'NodeSocketObject')
    compat.add_socket(group, COUNT, 'NodeSocketInt')
    compat.add_socket(group, VERTICES, 'NodeSocketInt')
    compat.add_socket(group, 'Geometry', 'NodeSocketGeometry', 'OUTPUT')
    compat.mark_as_modifier(group)
    _fill(group, influences)
    group[_MARK] = influences
    group['flbc_nodes'] = _NODES
    return group


def modifier_of(model):
    """The modifier of a model that is bound, else None."""
    return next((modifier for modifier in model.modifiers if modifier.type == 'NODES'
                 and modifier.node_group and _MARK in modifier.node_group), None)


def cage_of(model):
    """The cage of a model, None if the model is not bound or the cage was deleted."""
    modifier = modifier_of(model)
    return modifier and compat.get_input(modifier, CAGE)


def add_modifier(model, cage, influences):
    """Adds the modifier, or changes it if there is one, and moves it to the top of the stack."""
    modifier = modifier_of(model) or model.modifiers.new(MODIFIER, 'NODES')
    modifier.node_group = group_for(influences)
    compat.set_input(modifier, CAGE, cage)
    compat.set_input(modifier, COUNT, len(cage.data.vertices))
    compat.set_input(modifier, VERTICES, len(model.data.vertices))
    compat.move_first(model, modifier)
    model.update_tag()

# SPDX-License-Identifier: BSD-3-Clause
"""All differences between the Python interfaces of Blender 3.4, 4.x, and 5.x that matter here.

The functions look for features instead of comparing versions.
"""


def add_socket(group, name, socket_type, in_out='INPUT'):
    """Adds an input or 'OUTPUT' to a node group."""
    if hasattr(group, 'interface'):  # 4.0
        return group.interface.new_socket(name=name, in_out=in_out, socket_type=socket_type)
    return (group.inputs if in_out == 'INPUT' else group.outputs).new(socket_type, name)


def mark_as_modifier(group):
    """Lists a node group among those for modifiers, where Blender distinguishes them."""
    if hasattr(group, 'is_modifier'):  # 4.0
        group.is_modifier = True


def _identifier(group, name):
    if not hasattr(group, 'interface'):
        return group.inputs[name].identifier
    return next(item.identifier for item in group.interface.items_tree
                if item.item_type == 'SOCKET' and item.in_out == 'INPUT' and item.name == name)


def _typed_inputs(modifier):
    return getattr(getattr(modifier, 'properties', None), 'inputs', None)  # 5.2


def set_input(modifier, name, value):
    """Sets an input of the node group of a modifier."""
    identifier = _identifier(modifier.node_group, name)
    inputs = _typed_inputs(modifier)
    if inputs is None:
        modifier[identifier] = value
    else:
        getattr(inputs, identifier).value = value


def get_input(modifier, name):
    """Returns an input of the node group of a modifier."""
    identifier = _identifier(modifier.node_group, name)
    inputs = _typed_inputs(modifier)
    if inputs is None:
        return modifier.get(identifier)
    return getattr(inputs, identifier).value


def move_first(item, modifier):
    """Moves a modifier of an object to the top of the stack."""
    if hasattr(item.modifiers, 'move'):
        item.modifiers.move(item.modifiers.find(modifier.name), 0)
        return
    import bpy
    with bpy.context.temp_override(object=item):
        bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=0)


def show_progress(layout, part, text):
    """Draws a bar. `part` is in [0, 1]."""
    if hasattr(layout, 'progress'):  # 4.0
        layout.progress(factor=part, text=text)
    else:
        layout.label(text=f'{text}, {part:.0%}' if part else text, icon='TIME')

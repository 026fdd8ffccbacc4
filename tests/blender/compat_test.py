# SPDX-License-Identifier: BSD-3-Clause
"""The add-on uses the interface that each Blender version has. Stubs take the place of Blender."""
import sys
import types
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parents[2] / 'blender' / 'local_barycentric_cage'))
import compat  # noqa: E402


class Sockets(dict):
    """group.inputs of Blender 3.4."""

    def new(self, socket_type, name):
        self[name] = types.SimpleNamespace(identifier=f'Input_{len(self)}', type=socket_type)
        return self[name]


class OldGroup:
    def __init__(self):
        self.inputs, self.outputs = Sockets(), Sockets()


class NewGroup:
    """Of Blender 4.0, which has group.interface."""

    def __init__(self):
        self.interface, self.is_modifier = self, False
        self.items_tree = [types.SimpleNamespace(item_type='PANEL', name='Cage')]

    def new_socket(self, *, name, in_out, socket_type):
        self.items_tree.append(types.SimpleNamespace(
            item_type='SOCKET', name=name, in_out=in_out, type=socket_type,
            identifier=f'Socket_{len(self.items_tree)}'))
        return self.items_tree[-1]


class OldModifier(dict):
    def __init__(self, group):
        super().__init__()
        self.name, self.node_group = 'cage', group


class TypedModifier:
    """A modifier of Blender 5.2, which has no items."""

    def __init__(self, group):
        self.node_group = group
        names = [item.identifier for item in group.interface.items_tree
                 if item.item_type == 'SOCKET']
        inputs = {name: types.SimpleNamespace(value=None) for name in names}
        self.properties = types.SimpleNamespace(inputs=types.SimpleNamespace(**inputs))


def with_sockets(group):
    compat.add_socket(group, 'Cage', 'NodeSocketGeometry', 'OUTPUT')  # has the same name as the input
    compat.add_socket(group, 'Geometry', 'NodeSocketGeometry')
    compat.add_socket(group, 'Cage', 'NodeSocketObject')
    compat.mark_as_modifier(group)
    return group


class CompatTest(unittest.TestCase):
    def test_sockets_of_blender_3_are_in_two_lists(self):
        group = with_sockets(OldGroup())
        self.assertEqual(list(group.inputs), ['Geometry', 'Cage'])
        self.assertEqual(list(group.outputs), ['Cage'])
        self.assertEqual(group.inputs['Cage'].type, 'NodeSocketObject')
        self.assertFalse(hasattr(group, 'is_modifier'))

    def test_sockets_of_blender_4_are_in_the_interface(self):
        group = with_sockets(NewGroup())
        sockets = group.interface.items_tree[1:]
        self.assertEqual([(s.in_out, s.name) for s in sockets],
                         [('OUTPUT', 'Cage'), ('INPUT', 'Geometry'), ('INPUT', 'Cage')])
        self.assertEqual(sockets[2].type, 'NodeSocketObject')
        self.assertTrue(group.is_modifier)

    def test_inputs_are_found_by_name(self):
        for group in (with_sockets(OldGroup()), with_sockets(NewGroup())):
            modifier = OldModifier(group)
            self.assertIsNone(compat.get_input(modifier, 'Cage'))
            compat.set_input(modifier, 'Cage', 'object')
            self.assertEqual(compat.get_input(modifier, 'Cage'), 'object')
        self.assertEqual(modifier, {'Socket_3': 'object'})

    def test_inputs_of_blender_5_2_are_properties(self):
        modifier = TypedModifier(with_sockets(NewGroup()))
        compat.set_input(modifier, 'Cage', 'object')
        self.assertEqual(modifier.properties.inputs.Socket_3.value, 'object')
        self.assertEqual(compat.get_input(modifier, 'Cage'), 'object')

    def test_modifiers_move_by_method_where_there_is_one(self):
        moves = []
        modifiers = types.SimpleNamespace(find=lambda name: 2 if name == 'cage' else -1,
                                          move=lambda *places: moves.append(places))
        compat.move_first(types.SimpleNamespace(modifiers=modifiers), OldModifier(None))
        self.assertEqual(moves, [(2, 0)])

    def test_progress_is_a_bar_or_a_line(self):
        drawn = []
        new = types.SimpleNamespace(progress=lambda **settings: drawn.append(settings))
        old = types.SimpleNamespace(label=lambda **settings: drawn.append(settings))
        compat.show_progress(new, 0.25, 'solving')
        compat.show_progress(old, 0.25, 'solving')
        compat.show_progress(old, 0, 'meshing')
        self.assertEqual(drawn[0], {'factor': 0.25, 'text': 'solving'})
        self.assertEqual([line['text'] for line in drawn[1:]], ['solving, 25%', 'meshing'])


if __name__ == '__main__':
    unittest.main()

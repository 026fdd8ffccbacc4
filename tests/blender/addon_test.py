# SPDX-License-Identifier: BSD-3-Clause
"""The add-on in Blender, without a window:
  blender ... --python addon_test.py -- PROGRAM MESHES WORK
"""
import math
import os
import subprocess
import sys
import tempfile
import unittest
from contextlib import contextmanager
from pathlib import Path

import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix

sys.path.insert(0, str(Path(__file__).parent))
import scene  # noqa: E402
from scene import base, follow, relative, select, set_key, shown, size  # noqa: E402

PROGRAM, MESHES, WORK = scene.arguments()
TOLERANCE = 1e-6  # of the size of the cage


class AddonTest(unittest.TestCase):
    def setUp(self):
        scene.enable(PROGRAM)
        self.random = np.random.default_rng(1)
        self.model = scene.load(f'{MESHES}/3d/limb_model.obj')
        self.cage = scene.load(f'{MESHES}/3d/limb_cage.obj')
        for item in (self.model, self.cage):
            item.matrix_world = Matrix.LocRotScale((1, -2, 0.5), Euler((0.4, 0.2, -1)), (2, 2, 3))
        bpy.context.scene.flbc.cage = self.cage
        bpy.context.scene.flbc.quality = 'DRAFT'

    def bind(self, *models, **settings):
        for name, value in settings.items():
            setattr(bpy.context.scene.flbc, name, value)
        select(*(models or [self.model]))
        self.assertEqual(bpy.ops.flbc.bind(), {'FINISHED'})

    def refused(self, operator, words):
        """Whether an operator stops with these words."""
        with self.assertRaisesRegex(RuntimeError, words):
            operator()

    def problems(self, model=None):
        from local_barycentric_cage import binding
        bpy.context.view_layer.update()
        return ' '.join(binding.problems(model or self.model))

    def noise(self, amount=0.05):
        points = base(self.cage)
        return points + amount * size(points) * self.random.normal(size=points.shape)

    def pose(self, amount=0.05):
        """Moves the control points. Returns where they are."""
        points = self.noise(amount)
        set_key(self.cage, 'Pose', points)
        return points

    @contextmanager
    def edit(self, item):
        """Changes a mesh as in edit mode."""
        edited = bmesh.new()
        edited.from_mesh(item.data)
        for elements in (edited.verts, edited.edges, edited.faces):
            elements.ensure_lookup_table()
        yield edited
        edited.to_mesh(item.data)
        edited.free()

    def rebind(self, item):
        select(item)
        self.assertEqual(bpy.ops.flbc.rebind(), {'FINISHED'})
        self.assertEqual(self.problems(), '')

    def set_points(self, item, points):
        item.data.vertices.foreach_set('co', points.astype(np.float32).ravel())

    def require_equal(self, found, expected):
        self.assertLess(np.abs(found - expected).max() / size(base(self.cage)), TOLERANCE)

    def require_follows(self, cage_points, start=None, model=None):
        model = model or self.model
        found = shown(model)
        self.require_equal(found, follow(model, cage_points, relative(model, self.cage), start))
        return found

    # ---- locality --------------------------------------------------------------------------------
    def share_group(self, vertices, control_points, name='lock.hand'):
        for item, numbers in ((self.model, vertices), (self.cage, control_points)):
            group = item.vertex_groups.new(name=name)
            group.add([int(number) for number in numbers], 1, 'REPLACE')

    def test_groups_of_bones_do_not_protect(self):
        everything = range(len(self.model.data.vertices)), range(len(self.cage.data.vertices))
        self.share_group(*everything, name='hand')
        self.bind()
        self.assertEqual(self.problems(), '')

    def test_edits_of_locking_groups_ask_to_rebind(self):
        self.bind()
        along = base(self.cage)[:, 0], base(self.model)[:, 0]
        self.share_group(np.flatnonzero(along[1] < np.quantile(along[1], 0.2)),
                         np.flatnonzero(along[0] > np.quantile(along[0], 0.8)))
        self.assertIn('were changed. Rebind', self.problems())
        self.bind()
        self.assertEqual(self.problems(), '')
        self.model.vertex_groups['lock.hand'].remove([int(np.argmin(along[1]))])
        self.assertIn('were changed. Rebind', self.problems())

    def test_flat_meshes_are_refused(self):
        plane = scene.add('plane', [(0, 0, 0), (1, 0, 1), (1, 1, 1), (0, 1, 0)], [(0, 1, 2, 3)])
        select(plane)
        self.refused(bpy.ops.flbc.make_cage, 'plane is flat')
        bpy.context.scene.flbc.cage = plane
        select(self.model)
        self.refused(bpy.ops.flbc.bind, 'The cage plane is flat')

    def test_a_locking_vertex_group_protects_the_model_from_the_cage(self):
        along = base(self.cage)[:, 0]
        far = np.flatnonzero(along > np.quantile(along, 0.8))
        near = base(self.model)[:, 0] < np.quantile(base(self.model)[:, 0], 0.3)
        self.share_group(np.flatnonzero(near), far)
        for quality, influences in (('DRAFT', '8'), ('GOOD', '8'), ('GOOD', '4')):
            with self.subTest(quality=quality, influences=influences):
                self.bind(quality=quality, influences=influences)
                index, weight = scene.influences(self.model)
                self.assertEqual((weight * np.isin(index, far))[near].max(), 0)
                self.require_equal(shown(self.model), base(self.model))

    def test_a_solid_vertex_group_moves_by_one_affine_map(self):
        places = base(self.model)
        distance = np.linalg.norm(places - places[np.argmin(places[:, 0])], axis=1)
        solid = np.flatnonzero(distance <= np.sort(distance)[20])
        for name, members in (('solid.tip', solid), ('hat', range(len(places)))):
            self.model.vertex_groups.new(name=name).add([int(p) for p in members], 1, 'REPLACE')
        random = np.random.default_rng(1)
        for quality, influences in (('DRAFT', '8'), ('GOOD', '8')):
            with self.subTest(quality=quality, influences=influences):
                self.bind(quality=quality, influences=influences)
                self.assertEqual(self.problems(), '')
                index, weight = scene.influences(self.model)
                rows = np.zeros((len(places), len(base(self.cage))))
                np.add.at(rows, (np.arange(len(places))[:, None], index), weight)
                moved = rows @ random.normal(size=(rows.shape[1], 3))
                affine = np.c_[places, np.ones(len(places))]
                left = moved - affine @ np.linalg.lstsq(affine[solid], moved[solid], rcond=None)[0]
                self.assertLess(np.abs(left[solid]).max(), 1e-5)  # of single precision
                self.assertGreater(np.abs(left).max(), 0.01)
        self.model.vertex_groups['solid.tip'].remove([int(solid[0])])
        self.assertIn('were changed. Rebind', self.problems())
        self.model.vertex_groups['solid.tip'].remove(range(len(places)))
        select(self.model)
        self.refused(bpy.ops.flbc.bind, 'solid.tip')

    def test_what_cannot_be_protected_is_refused(self):
        self.share_group(range(len(self.model.data.vertices)), range(len(self.cage.data.vertices)))
        select(self.model)
        self.refused(bpy.ops.flbc.bind, 'control points')
        self.cage.vertex_groups['lock.hand'].remove(range(len(self.cage.data.vertices)))
        self.refused(bpy.ops.flbc.bind, 'empty')

    # ---- positions -------------------------------------------------------------------------------
    def test_the_model_follows_the_shape_keys_of_the_cage(self):
        self.bind()
        self.require_equal(shown(self.model), base(self.model))
        pose = self.pose()
        found = self.require_follows(pose)
        self.assertGreater(np.abs(found - base(self.model)).max(), 0.01 * size(base(self.cage)))
        self.cage.data.shape_keys.key_blocks['Pose'].value = 0.5
        own = self.noise()
        set_key(self.cage, 'Own', own).value = 0.5
        self.require_follows((pose + own) / 2)

    def test_affine_maps_of_the_cage_are_those_of_the_model(self):
        for quality, influences in (('GOOD', '8'), ('GOOD', '4'), ('EXACT', '8')):
            with self.subTest(quality=quality, influences=influences):
                self.bind(quality=quality, influences=influences)
                linear = np.array([[1, 0.3, 0], [0, 0.7, 0.2], [-0.4, 0, 1.5]])
                set_key(self.cage, 'Pose', base(self.cage) @ linear + 0.1)
                self.require_equal(shown(self.model), base(self.model) @ linear + 0.1)

    def test_weights_are_coordinates(self):
        for influences in (4, 8):
            self.bind(influences=str(influences), quality='GOOD')
            index, weight = scene.influences(self.model)
            self.assertEqual(index.shape, (len(self.model.data.vertices), influences))
            self.assertGreaterEqual(weight.min(), 0)
            self.assertLess(np.abs(weight.sum(1) - 1).max(), 1e-6)
            self.assertTrue(0 <= index.min() and index.max() < len(self.cage.data.vertices))

    def add_armature(self, *names):
        """Bones in a chain along the cage."""
        data = bpy.data.armatures.new('rig')
        rig = bpy.data.objects.new('rig', data)
        bpy.context.collection.objects.link(rig)
        rig.matrix_world = self.cage.matrix_world
        select(rig)
        bpy.ops.object.mode_set(mode='EDIT')
        low, high = (f(base(self.cage)[:, 0]) for f in (np.min, np.max))
        for k, name in enumerate(names):
            bone = data.edit_bones.new(name)
            bone.head, bone.tail = [(low + (high - low) * (k + end) / len(names), 0, 0)
                                    for end in (0, 1)]
            bone.parent = data.edit_bones[names[k - 1]] if k else None
        bpy.ops.object.mode_set(mode='OBJECT')
        self.cage.modifiers.new('rig', 'ARMATURE').object = rig
        return rig

    def skin_cage(self, *names):
        """Random weights of bones that do not sum to 1, (control points, bones)."""
        shares = self.random.random((len(self.cage.data.vertices), len(names)))
        shares *= self.random.random(shares.shape) < 0.7
        shares[np.arange(len(shares)), self.random.integers(len(names), size=len(shares))] = 0.5
        for name, column in zip(names, shares.T):
            group = self.cage.vertex_groups.new(name=name)
            for vertex in np.flatnonzero(column):
                group.add([int(vertex)], column[vertex], 'REPLACE')
        return shares / shares.sum(1, keepdims=True)

    def groups(self, model, *names):
        found = np.zeros((len(model.data.vertices), len(names)))
        for vertex in model.data.vertices:
            for part in vertex.groups:
                name = model.vertex_groups[part.group].name
                found[vertex.index, names.index(name)] = part.weight
        return found

    def skin(self, **options):
        """Presses the button. Returns the largest difference that it measures, by model."""
        from local_barycentric_cage import skin
        select(self.model)
        found, write = {}, skin.write
        skin.write = lambda model, *rest: found.setdefault(model.name, write(model, *rest))
        try:
            self.assertEqual(bpy.ops.flbc.skin(**options), {'FINISHED'})
        finally:
            skin.write = write
        return found

    def product(self, shares, influences):
        """What the vertex groups of the model should be."""
        index, weight = scene.influences(self.model)
        product = np.einsum('vk,vkb->vb', weight, shares[index])
        product[product < np.sort(product)[:, -influences:-influences + 1]] = 0
        return product / product.sum(1, keepdims=True)

    def test_bones_of_the_cage_skin_all_its_models(self):
        names = [f'bone {k}' for k in range(11)]
        other = self.model.copy()
        other.data = self.model.data.copy()
        other.name = 'other'
        bpy.context.collection.objects.link(other)
        rig = self.add_armature(*names)
        shares = self.skin_cage(*names)
        self.cage.vertex_groups.new(name='of no bone').add([0, 1], 1, 'REPLACE')
        for influences in (8, 4):
            self.bind(self.model, other, influences=str(influences))
            found = self.skin()
            self.assertEqual(set(found), {self.model.name, other.name})
            self.assertLess(max(found.values()), 1e-6, 'nothing is posed')
            for model in (self.model, other):
                groups = self.groups(model, *names)
                self.assertEqual((groups > 0).sum(1).max(), influences)
                np.testing.assert_allclose(groups, self.product(shares, influences), atol=1e-6)
            self.require_equal(shown(self.model), base(self.model))
        # A bone that moves all others poses the model as the cage does; others do not.
        self.bind(quality='GOOD')
        rig.pose.bones['bone 0'].matrix_basis = Matrix.LocRotScale((0.3, 0.1, 0), Euler((1, 2, 0.5)),
                                                                   (1, 1, 2))
        self.assertLess(self.skin()[self.model.name], 1e-5)
        self.assertGreater(np.abs(shown(self.model) - base(self.model)).max(), 0.1)
        rig.pose.bones['bone 5'].matrix_basis = Matrix.Rotation(0.5, 4, 'X')
        found = self.skin()[self.model.name]
        skinned = shown(self.model)
        self.model.modifiers['rig'].show_viewport = False
        self.model.modifiers['Local Barycentric Cage'].show_viewport = True
        by_cage = shown(self.model)
        apart = np.linalg.norm(skinned - by_cage, axis=1).max() / size(base(self.model))
        self.assertAlmostEqual(found, apart, places=6)
        self.assertGreater(found, 1e-3)
        # The armature poses the model without the binding.
        bpy.ops.flbc.unbind()
        self.model.modifiers['rig'].show_viewport = True
        self.require_equal(shown(self.model), skinned)

    def test_weights_of_bones_are_kept_or_replaced(self):
        self.bind()
        self.add_armature('a', 'b')
        shares = self.skin_cage('a', 'b')
        own = self.model.vertex_groups.new(name='a')
        own.add([3, 4], 0.25, 'REPLACE')
        self.model.vertex_groups.new(name='eyes').add([4], 1, 'REPLACE')
        expected = self.product(shares, 2)
        kept = np.isin(np.arange(len(expected)), [3, 4])
        for existing, free in (('KEEP', ~kept), ('REPLACE', kept | ~kept)):
            self.skin(existing=existing)
            groups = self.groups(self.model, 'a', 'b', 'eyes')
            np.testing.assert_allclose(groups[free, :2], expected[free], atol=1e-6)
            np.testing.assert_array_equal(groups[~free, :2], np.tile([0.25, 0], (sum(~free), 1)))
            self.assertEqual(groups[4, 2], 1)
            self.assertEqual(groups[:, 2].sum(), 1)

    def test_protected_vertices_have_no_weight_of_bones_of_the_others(self):
        along = base(self.cage)[:, 0]
        far = along > np.quantile(along, 0.8)
        near = base(self.model)[:, 0] < np.quantile(base(self.model)[:, 0], 0.3)
        self.share_group(np.flatnonzero(near), np.flatnonzero(far))
        self.bind()
        self.add_armature('near', 'far')
        for name, are in (('near', ~far), ('far', far)):
            self.cage.vertex_groups.new(name=name).add(np.flatnonzero(are).tolist(), 1, 'REPLACE')
        self.skin()
        groups = self.groups(self.model, 'near', 'far', 'lock.hand')
        self.assertEqual(groups[near, 1].max(), 0)
        self.assertGreater(groups[~near, 1].max(), 0.9)

    def test_undo_of_weights_from_the_cage(self):
        self.bind()
        self.add_armature('a', 'b')
        self.skin_cage('a', 'b')
        bpy.ops.ed.undo_push(message='before')
        self.skin()
        bpy.ops.ed.undo_push(message='after')
        bpy.ops.ed.undo()
        model = bpy.data.objects['limb_model']
        self.assertFalse(model.vertex_groups)
        self.assertEqual([m.show_viewport for m in model.modifiers], [True])

    def test_cages_without_bones_are_refused(self):
        self.bind()
        self.refused(bpy.ops.flbc.skin, 'limb_cage has no armature')
        self.add_armature('a', 'b')
        select(self.model)
        self.refused(bpy.ops.flbc.skin, '54 of 54 vertices')
        self.skin_cage('a', 'b')
        for name in 'ab':
            self.cage.vertex_groups[name].remove([7])
        self.refused(bpy.ops.flbc.skin, '1 of 54 vertices of the cage limb_cage .* first vertex 7')
        with self.edit(self.model) as edited:
            bmesh.ops.delete(edited, geom=edited.verts[-100:], context='VERTS')
        self.cage.vertex_groups['a'].add([7], 1, 'REPLACE')
        self.refused(bpy.ops.flbc.skin, 'limb_model: .* Rebind')
        self.assertFalse(self.model.vertex_groups)

    def test_shape_keys_move_other_models_of_the_cage(self):
        garment = self.model.copy()
        garment.data = self.model.data.copy()
        garment.name = 'garment'
        bpy.context.collection.objects.link(garment)
        # Half of the body, turned: in the world, both are at the same places. By a right angle,
        # because objects have no shear.
        turn = Matrix.LocRotScale((0.1, 0.2, 0.3), Euler((np.pi / 2, 0, 0)), (2, 2, 2))
        garment.data.transform(turn.inverted())
        garment.matrix_world = self.model.matrix_world @ turn
        with self.edit(garment) as edited:
            bmesh.ops.delete(edited, geom=edited.verts[len(edited.verts) // 2:], context='VERTS')
        self.bind(self.model, garment)
        index, weight = scene.influences(self.model)
        moves = {}
        self.model.shape_key_add(name='Basis')
        for name in ('smile', 'frown'):
            pose = 0.1 * self.random.standard_normal((len(self.cage.data.vertices), 3))
            moves[name] = np.einsum('vk,vkx->vx', weight, pose[index])
            key = self.model.shape_key_add(name=name)
            key.data.foreach_set('co', (base(self.model) + moves[name]).astype(np.float32).ravel())
        select(garment, self.model)
        for _ in range(2):  # the second time, keys are replaced
            self.assertEqual(bpy.ops.flbc.transfer_keys(), {'FINISHED'})
            blocks = garment.data.shape_keys.key_blocks
            self.assertEqual([key.name for key in blocks], ['Basis', 'smile', 'frown'])
        linear = np.array(turn)[:3, :3]
        for name, expected in moves.items():
            places = [np.array([point.co for point in blocks[each].data]) for each in ('Basis', name)]
            found = (places[1] - places[0]) @ linear.T
            error = np.linalg.norm(found - expected[:len(found)], axis=1).max()
            self.assertLess(error, 1e-3 * np.abs(expected).max())
        select(self.model)
        self.refused(bpy.ops.flbc.transfer_keys, 'limb_model last')

    def test_an_armature_on_the_cage(self):
        self.bind()
        rig = self.add_armature('bone')
        half = range(len(self.cage.data.vertices) // 2)
        self.cage.vertex_groups.new(name='bone').add(list(half), 1, 'REPLACE')
        rig.pose.bones['bone'].matrix_basis = Matrix.Rotation(0.5, 4, 'X')
        moved = shown(self.cage)
        self.assertGreater(np.abs(moved - base(self.cage)).max(), 0.01)
        self.require_follows(moved)

    def test_objects_that_move(self):
        self.bind()
        pose = self.pose()
        self.cage.matrix_world = Matrix.Translation((0.3, 0, 0)) @ self.cage.matrix_world
        followed = self.require_follows(pose)
        turn = Matrix.LocRotScale((5, 1, 2), Euler((1, 2, 3)), (1, 1, 1))
        for item in (self.cage, self.model):
            item.matrix_world = turn @ item.matrix_world
        self.require_equal(self.require_follows(pose), followed)
        self.model.parent = self.cage
        self.require_follows(pose)

    def test_edit_mode_is_live(self):
        self.bind()
        select(self.cage)
        bpy.ops.object.mode_set(mode='EDIT')
        edited = bmesh.from_edit_mesh(self.cage.data)
        pose = self.noise()
        for vertex, point in zip(edited.verts, pose):
            vertex.co = point
        bmesh.update_edit_mesh(self.cage.data)
        self.require_follows(pose)
        self.assertEqual(self.problems(), '')
        bpy.ops.object.mode_set(mode='OBJECT')
        self.require_follows(pose)
        self.assertEqual(self.problems(), '', 'an edit of the pose is no edit of the rest shape')

    def test_shape_keys_of_the_model_are_added(self):
        self.model.shape_key_add(name='Basis')
        smile = base(self.model) + 0.01 * self.random.normal(size=base(self.model).shape)
        set_key(self.model, 'Smile', smile).value = 1
        self.bind()
        pose = self.pose()
        self.require_follows(pose, start=smile)

    def test_models_in_one_cage_get_the_same_field(self):
        other = self.model.copy()
        other.data = self.model.data.copy()
        bpy.context.collection.objects.link(other)
        other.data.transform(Matrix.Scale(2, 4))
        other.matrix_world = self.model.matrix_world @ Matrix.Scale(0.5, 4)
        self.bind(self.model, other)
        for one, two in zip(scene.influences(self.model), scene.influences(other)):
            np.testing.assert_allclose(one, two, atol=1e-5)
        pose = self.pose()
        self.require_follows(pose)
        self.require_follows(pose, model=other)

    # ---- the life of a binding -------------------------------------------------------------------
    def test_the_node_group_is_made_once(self):
        for influences, count in (('8', 1), ('8', 1), ('4', 2), ('8', 2)):
            self.bind(influences=influences)
            self.assertEqual(len(bpy.data.node_groups), count)
            self.assertEqual(len(self.model.modifiers), 1)

    def test_two_selected_meshes_are_a_model_and_its_cage(self):
        bpy.context.scene.flbc.cage = None
        select(self.cage, self.model)
        self.assertEqual(bpy.ops.flbc.bind(), {'FINISHED'})
        self.assertEqual(bpy.context.scene.flbc.cage, self.cage)
        self.require_equal(shown(self.model), base(self.model))

    def test_the_modifier_comes_first(self):
        self.model.modifiers.new('smooth', 'SUBSURF')
        self.bind()
        self.assertEqual([m.type for m in self.model.modifiers], ['NODES', 'SUBSURF'])
        pose = self.pose()
        self.model.modifiers['smooth'].show_viewport = False
        expected = self.model.copy()
        expected.data = self.model.data.copy()
        self.set_points(expected, shown(self.model))
        expected.modifiers.remove(expected.modifiers[0])
        bpy.context.collection.objects.link(expected)
        for item in (self.model, expected):
            item.modifiers['smooth'].show_viewport = True
        self.assertEqual(self.problems(), '')
        self.require_equal(shown(self.model), shown(expected))
        with bpy.context.temp_override(object=self.model):
            bpy.ops.object.modifier_move_to_index(modifier='smooth', index=0)
        self.assertIn('smooth comes before the cage', self.problems())
        self.rebind(self.model)

    def test_rebinding_after_edits_of_the_model(self):
        self.bind()
        pose = self.pose()
        self.cage.matrix_world = Matrix.Translation((0.3, 0, 0)) @ self.cage.matrix_world
        before = shown(self.model)
        with self.edit(self.model) as edited:
            bmesh.ops.delete(edited, geom=edited.verts[-100:], context='VERTS')
        self.assertIn('limb_model were added or removed', self.problems())
        self.rebind(self.model)
        self.require_follows(pose)
        self.require_equal(shown(self.model), before[:-100])

    def test_new_vertices_of_the_model_leave_it_at_rest(self):
        for name, elements, count, options in (('subdivide_edges', 'edges', 90, {'cuts': 1}),
                                               ('inset_individual', 'faces', 50, {'thickness': 0.01}),
                                               ('poke', 'faces', 50, {})):
            with self.subTest(edit=name):
                self.bind()
                pose = self.pose()
                with self.edit(self.model) as edited:
                    options[elements] = getattr(edited, elements)[:count]
                    getattr(bmesh.ops, name)(edited, **options)
                self.assertIn('Rebind', self.problems())
                self.require_equal(shown(self.model), base(self.model))
                self.rebind(self.model)
                self.require_follows(pose)

    def test_rebinding_after_edits_of_the_cage(self):
        self.bind()
        set_key(self.cage, 'Basis', 1.05 * base(self.cage))
        self.assertIn('rest shape of limb_cage has changed', self.problems())
        self.rebind(self.cage)
        with self.edit(self.cage) as edited:
            bmesh.ops.poke(edited, faces=edited.faces[:1])
        self.assertIn('limb_cage were added or removed', self.problems())
        self.require_equal(shown(self.model), base(self.model))  # rather than torn
        self.rebind(self.cage)
        pose = self.pose(0.01)
        self.require_follows(pose)

    def test_a_deleted_cage(self):
        self.bind()
        bpy.data.objects.remove(self.cage)
        self.assertIn('cage was deleted', self.problems())
        self.assertLess(np.abs(shown(self.model) - base(self.model)).max(), 1e-6)

    def test_unbinding_leaves_nothing(self):
        names = {a.name for a in self.model.data.attributes}
        self.bind()
        self.pose()
        select(self.model)
        self.assertEqual(bpy.ops.flbc.unbind(), {'FINISHED'})
        self.assertFalse(self.model.modifiers)
        self.assertEqual({a.name for a in self.model.data.attributes}, names)
        self.assertFalse(self.model.get('flbc'))
        self.require_equal(shown(self.model), base(self.model))

    def test_applying_keeps_the_shape(self):
        self.bind()
        self.pose()
        before = shown(self.model)
        select(self.model)
        self.assertEqual(bpy.ops.flbc.apply(), {'FINISHED'})
        self.assertFalse(self.model.modifiers)
        self.require_equal(base(self.model), before)
        self.assertFalse([a for a in self.model.data.attributes if a.name.startswith('flbc')])

    def test_undo_and_redo(self):
        bpy.ops.ed.undo_push(message='before')
        self.bind()
        self.pose()
        before = shown(self.model)
        bpy.ops.ed.undo_push(message='after')
        bpy.ops.ed.undo()
        self.assertFalse(bpy.data.objects['limb_model'].modifiers)
        bpy.ops.ed.redo()
        self.cage = bpy.data.objects['limb_cage']
        self.require_equal(shown(bpy.data.objects['limb_model']), before)

    def test_saving_and_loading(self):
        self.bind()
        pose = self.pose()
        np.save(os.path.join(WORK, 'bound.npy'), shown(self.model))  # for without_addon.py
        path = os.path.join(WORK, 'bound.blend')
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        self.model, self.cage = (bpy.data.objects[name] for name in ('limb_model', 'limb_cage'))
        self.require_follows(pose)
        self.assertEqual(self.problems(), '')

    # ---- making cages ----------------------------------------------------------------------------
    def test_making_a_cage_and_binding_to_it(self):
        select(self.model)
        bpy.context.scene.flbc.control_points = 40
        self.assertEqual(bpy.ops.flbc.make_cage(), {'FINISHED'})
        self.cage = bpy.context.scene.flbc.cage
        self.assertEqual(self.cage.name, 'limb_model Cage')
        self.assertLessEqual(len(self.cage.data.vertices), 40)
        np.testing.assert_allclose(self.cage.matrix_world, self.model.matrix_world, atol=1e-6)
        self.bind()
        self.assertEqual(self.model.flbc.note, '')  # all vertices are inside
        pose = self.pose(0.01)
        self.require_follows(pose)

    def test_a_vertex_group_makes_a_cage_denser(self):
        half = np.median(base(self.model)[:, 0])
        odds = []
        for weight in (0, 1):
            group = self.model.vertex_groups.new(name='density')
            group.add(np.flatnonzero(base(self.model)[:, 0] > half).tolist(), weight, 'REPLACE')
            select(self.model)
            bpy.context.scene.flbc.control_points = 60
            self.assertEqual(bpy.ops.flbc.make_cage(), {'FINISHED'})
            share = (base(bpy.context.scene.flbc.cage)[:, 0] > half).mean()
            odds.append(share / (1 - share))
            self.model.vertex_groups.remove(group)
        self.assertGreater(odds[1], 2 * odds[0])

    def test_a_model_gets_the_cage_of_its_file(self):
        """Importers turn the mesh or the matrix, and separate vertices at seams."""
        from local_barycentric_cage import files, mesh
        points, faces = base(self.model), [list(face.vertices) for face in self.model.data.polygons]
        with tempfile.TemporaryDirectory() as folder:
            model, cage = Path(folder, 'model.obj'), Path(folder, 'cage.obj')
            model.write_text(''.join(f'v {x!r} {y!r} {z!r}\n' for x, y, z in points.tolist()) + ''.join(
                'f ' + ' '.join(str(v + 1) for v in face) + '\n' for face in faces))
            subprocess.run([PROGRAM, 'cage', model, '-q', '-o', cage], check=True)
            expected, _ = files.read_obj(cage)
        turned = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
        beyond = len(points) // 2
        seams = [[2 * v + (min(face) > beyond) for v in face] for face in faces]
        as_gltf = scene.add('as gltf', np.repeat(points, 2, 0) @ turned.T, seams)
        as_obj = scene.add('as obj', points, faces)
        as_obj.rotation_euler = math.pi / 2, 0, 0
        bpy.context.scene.flbc.control_points = 0
        for item in (as_gltf, as_obj):
            select(item)
            self.assertEqual(bpy.ops.flbc.make_cage(), {'FINISHED'})
            found = bpy.context.scene.flbc.cage
            places = mesh.transform(base(found), np.array(found.matrix_world))
            np.testing.assert_allclose(places @ turned, expected, atol=1e-5 * size(expected))

    def test_a_cage_with_fewer_points_than_influences(self):
        self.cage = scene.add('tetrahedron', [(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9)],
                              [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
        self.model = scene.add('points', 1 + self.random.random((20, 3)), [])  # has no faces
        bpy.context.scene.flbc.cage = self.cage
        for quality in ('DRAFT', 'GOOD', 'EXACT'):
            self.bind(quality=quality)
            pose = self.pose()
            self.require_follows(pose)

    # ---- refusals --------------------------------------------------------------------------------
    def test_a_missing_program(self):
        bpy.context.preferences.addons[scene.ADDON].preferences.path = '/nowhere/flbc'
        select(self.model)
        for operator in (bpy.ops.flbc.bind, bpy.ops.flbc.make_cage):
            self.refused(operator, '/nowhere/flbc is not a program')
        self.assertFalse(self.model.modifiers)

    def test_no_cage(self):
        bpy.context.scene.flbc.cage = None
        select(self.model)
        self.refused(bpy.ops.flbc.bind, 'Choose a cage')

    def test_a_cage_with_modifiers_that_add_vertices(self):
        self.cage.modifiers.new('smooth', 'SUBSURF')
        select(self.model)
        self.refused(bpy.ops.flbc.bind, 'number of vertices of the cage limb_cage')
        self.cage.modifiers.clear()
        self.bind()
        self.cage.modifiers.new('smooth', 'SUBSURF')
        self.assertIn('The model stays at rest', self.problems())
        self.require_equal(shown(self.model), base(self.model))

    def test_a_cage_with_a_hole(self):
        with self.edit(self.cage) as edited:
            edited.faces.remove(edited.faces[0])
        select(self.model)
        self.refused(bpy.ops.flbc.bind, 'limb_cage: ')
        self.assertFalse(self.model.modifiers)

    def test_vertices_outside(self):
        self.set_points(self.model, base(self.model) + 3 * (np.arange(len(base(self.model))) < 5)[:, None])
        for quality in ('DRAFT', 'GOOD'):
            self.bind(quality=quality)
            self.assertIn('5 vertices are outside the cage', self.model.flbc.note)
            self.require_equal(shown(self.model), base(self.model))
        bpy.context.scene.flbc.quality = 'EXACT'
        self.refused(bpy.ops.flbc.bind, 'limb_model')
        bpy.context.scene.flbc.quality = 'DRAFT'
        self.cage.location.x += 100
        bpy.ops.flbc.unbind()
        self.refused(bpy.ops.flbc.bind, 'All vertices are outside the cage limb_cage')

    def test_notes_are_those_of_each_model(self):
        other = scene.load(f'{MESHES}/3d/limb_model.obj')
        other.matrix_world = self.model.matrix_world
        self.set_points(other, base(other) + 3 * (np.arange(len(base(other))) < 3)[:, None])
        self.bind(self.model, other)
        self.assertEqual(self.model.flbc.note, '')
        self.assertIn('3 vertices are outside the cage', other.flbc.note)

    def test_a_cage_becomes_a_wire_once(self):
        self.bind()
        self.assertEqual(self.cage.display_type, 'WIRE')
        self.cage.display_type = 'SOLID'
        self.bind()
        self.assertEqual(self.cage.display_type, 'SOLID')

    def test_objects_without_volume_or_vertices(self):
        empty = scene.add('empty', [], [])
        select(empty)
        self.refused(bpy.ops.flbc.bind, 'empty has no vertices')
        self.model.scale = (0, 1, 1)
        select(self.model)
        self.refused(bpy.ops.flbc.bind, 'limb_model has a scale of 0')

    def test_applying_with_shape_keys(self):
        self.model.shape_key_add(name='Basis')
        self.bind()
        select(self.model)
        self.refused(bpy.ops.flbc.apply, 'limb_model has shape keys')
        self.assertEqual(len(self.model.modifiers), 1)

    def test_registering_twice(self):
        for _ in range(2):
            bpy.ops.preferences.addon_disable(module=scene.ADDON)
            self.assertFalse(hasattr(bpy.types.Scene, 'flbc'))
            bpy.ops.preferences.addon_enable(module=scene.ADDON)
            self.assertTrue(hasattr(bpy.types.Scene, 'flbc'))


result = unittest.main(argv=['addon_test'], exit=False, verbosity=1).result
sys.exit(not result.wasSuccessful())

# SPDX-License-Identifier: BSD-3-Clause
"""Binds models to a cage, and finds out whether a binding is still valid."""
import json
import tempfile
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np

from . import files, mesh, nodes
from .program import Command, Refusal


class _Quality(NamedTuple):
    solve: list     # options of flbc solve
    reduction: str  # option of flbc sparsify; empty: the largest weights are kept as they are


QUALITIES = {
    # One thread: so small a problem gains nothing from more, and Blender uses the others.
    'DRAFT': _Quality(['--vertices', 1000, '--tolerance', 1e-4, '--outside', 'nearest',
                       '--threads', 1], ''),
    'GOOD': _Quality(['--outside', 'nearest'], 'quadratic'),
    'EXACT': _Quality(['--embed'], 'auto'),
}
POSE = 'Pose'
LOCK = 'lock.'  # begins the names of vertex groups that protect; bones have groups as well
SOLID = 'solid.'  # begins those of vertex groups that move by one affine map
DENSITY = 'density'  # vertex group whose weights make cages denser
MOST_DENSE = 16  # times as many control points at weight 1
# Modifiers that change the number of vertices.
GENERATORS = {'ARRAY', 'BEVEL', 'BOOLEAN', 'BUILD', 'DECIMATE', 'EDGE_SPLIT', 'MASK', 'MIRROR',
              'MULTIRES', 'NODES', 'REMESH', 'SCREW', 'SKIN', 'SOLIDIFY', 'SUBSURF', 'WELD',
              'WIREFRAME'}


class Settings(NamedTuple):
    program: str
    influences: int
    smoothness: float  # 0 to 0.03
    quality: str       # one of QUALITIES
    falloff: float     # next to protected vertices, 0 to 0.3


class Binding(bpy.types.PropertyGroup):
    """What an object was bound with."""
    quality: bpy.props.StringProperty()
    note: bpy.props.StringProperty()
    model_faces: bpy.props.StringProperty()
    model_places: bpy.props.StringProperty()
    cage_faces: bpy.props.StringProperty()
    cage_places: bpy.props.StringProperty()
    locks: bpy.props.StringProperty()
    # From the space of the cage to that of the model, both at rest; row by row.
    matrix: bpy.props.FloatVectorProperty(size=16)


class _Part(NamedTuple):
    """A model that is being bound. Names outlive undo, references do not."""
    name: str
    shape: mesh.Shape
    matrix: np.ndarray
    locks: str  # fingerprint of its vertex groups


def relative_matrix(model, cage):
    """From the space of the cage to that of the model."""
    try:
        return np.linalg.inv(np.array(model.matrix_world)) @ np.array(cage.matrix_world)
    except np.linalg.LinAlgError:
        raise Refusal(f'{model.name} has a scale of 0. Change its scale') from None


def rest_matrix(model, cage):
    """The same at rest: when the model was bound to this cage, or now if it is not."""
    if nodes.cage_of(model) == cage and any(model.flbc.matrix):
        return np.array(model.flbc.matrix).reshape(4, 4)
    return relative_matrix(model, cage)


def locking_groups(models, cage):
    """Names of vertex groups of the cage that protect a model, which has them as well.

    The vertices of the cage in such a group never move the vertices of the models in it.
    """
    return [group.name for group in cage.vertex_groups if group.name.startswith(LOCK)
            and any(group.name in model.vertex_groups for model in models)]


def solid_groups(models):
    """Pairs of a number of a model and the name of a vertex group of it that is solid."""
    return [(k, group.name) for k, model in enumerate(models) for group in model.vertex_groups
            if group.name.startswith(SOLID)]


def _locks(model, cage):
    """A fingerprint of the vertex groups that _locality() reads; empty if there are none."""
    groups = [(mesh.members(cage, name), mesh.members(model, name))
              for name in locking_groups([model], cage)]
    groups += [mesh.members(model, name) for _, name in solid_groups([model])]
    return mesh.digest(np.frombuffer(json.dumps(groups).encode(), np.uint8)) if groups else ''


def _locality(models, cage):
    """What flbc reads as --locality, for the joined models. Raises Refusal."""
    begins = np.cumsum([0] + [len(model.data.vertices) for model in models])
    solid = []
    for k, name in solid_groups(models):
        vertices = [int(begins[k]) + vertex for vertex in mesh.members(models[k], name)]
        if not vertices:
            raise Refusal(f'The vertex group {name} of {models[k].name} is empty. Assign vertices '
                          'to it, or remove it')
        solid.append({'region': {'vertices': vertices}})
    masks = []
    for name in locking_groups(models, cage):
        control_points = mesh.members(cage, name)
        vertices = [int(begin) + vertex for begin, model in zip(begins, models)
                    for vertex in mesh.members(model, name)]
        if not control_points or not vertices:
            raise Refusal(f'The vertex group {name} is empty on the cage or on the model. '
                          'Assign vertices to it, or remove it from one of them')
        masks.append({'control_points': control_points, 'region': {'vertices': vertices}})
    return {'masks': masks, 'solid': solid}


def _evaluated_count(item):
    graph = bpy.context.evaluated_depsgraph_get()
    return len(item.evaluated_get(graph).data.vertices)


def _require_ready(models, cage):
    for item in [*models, cage]:
        if item.mode == 'EDIT':
            raise Refusal(f'{item.name} is in Edit Mode. Switch to Object Mode')
        if not item.data.vertices:
            raise Refusal(f'{item.name} has no vertices')
    if _evaluated_count(cage) != len(cage.data.vertices):
        raise Refusal(f'Modifiers change the number of vertices of the cage {cage.name}. '
                      'Apply or disable them')
    if mesh.is_flat(mesh.shape_of(cage.data)):
        raise Refusal(f'The cage {cage.name} is flat. Choose a closed mesh around the model')


def bind(models, cage, settings, refine=False):
    """Steps of a Job that bind models to a cage. All of them get the same coordinates.

    refine: after a draft bind again with good quality. Raises Refusal.
    """
    bpy.context.view_layer.update()
    _require_ready(models, cage)
    with tempfile.TemporaryDirectory(prefix='flbc_') as folder:
        task = _Task(Path(folder), models, cage, settings.falloff)
        yield from task.bind(settings)
        if refine and settings.quality == 'DRAFT':
            bpy.ops.ed.undo_push(message='Bind to Cage (Draft)')
            yield from task.bind(settings._replace(quality='GOOD'))


class _Task:
    """Models and a cage as they were at the start, and files of them."""

    def __init__(self, folder, models, cage, falloff):
        self._folder = folder
        self._cage_name = cage.name
        self._cage = mesh.shape_of(cage.data)
        self._parts = [_Part(model.name, mesh.shape_of(model.data), rest_matrix(model, cage),
                             _locks(model, cage)) for model in models]
        try:
            self._model = mesh.joined([mesh.moved(part.shape, np.linalg.inv(part.matrix))
                                       for part in self._parts])
        except np.linalg.LinAlgError:
            raise Refusal(f'{cage.name} has a scale of 0. Change its scale') from None
        files.write_ply(folder / 'cage.ply', *self._cage)
        files.write_ply(folder / 'model.ply', *self._model)
        locality = _locality(models, cage)
        (folder / 'locality.json').write_text(json.dumps({**locality, 'falloff': falloff}))
        self._locality = ['--locality', folder / 'locality.json'] if any(locality.values()) else []
        self._is_solid = bool(locality['solid'])

    def _command(self, settings, *arguments):
        names = {self._folder / 'cage.ply': self._cage_name,
                 self._folder / 'model.ply': ', '.join(part.name for part in self._parts),
                 self._folder / 'locality.json': 'Vertex groups'}
        return Command([settings.program, *arguments], names)

    def bind(self, settings):
        indices, weights, notes = yield from self._solve(settings)
        while any(item and item.mode == 'EDIT' for item in self._items()):
            yield None
        self._require_unchanged()
        self._store(indices, weights, settings, notes)

    def _solve(self, settings):
        """Returns indices and weights of all vertices, and a note for the user by model."""
        folder = self._folder
        solved, reduced = folder / 'binding.npz', folder / 'reduced.npz'
        quality, k = QUALITIES[settings.quality], settings.influences
        note = yield self._command(
            settings, 'solve', folder / 'cage.ply', '--model', folder / 'model.ply', '-o', solved,
            '--smoothness', settings.smoothness, *self._locality, *quality.solve)
        outside = files.vertices_outside(solved)
        if len(outside) == len(self._model.points):
            raise Refusal(f'All vertices are outside the cage {self._cage_name}')
        notes = [note + part for part in self._notes_outside(outside)]
        reduction = quality.reduction or ('quadratic' if self._is_solid else '')
        if not reduction:
            return *files.largest_weights(solved, k), notes
        yield self._command(settings, 'sparsify', solved, '--reduction', reduction, '-k', k,
                            '-o', reduced)
        return *files.largest_weights(reduced, k), notes

    def _notes_outside(self, outside):
        """By model, a sentence on its share of the vertices outside, or nothing."""
        is_outside = np.zeros(len(self._model.points), bool)
        is_outside[outside] = True
        ends = np.cumsum([len(part.shape.points) for part in self._parts])
        return [f'{part.sum()} vertices are outside the cage and follow its nearest point '
                'at a constant offset. ' if part.any() else ''
                for part in np.split(is_outside, ends[:-1])]

    def _items(self):
        return [bpy.data.objects.get(name)
                for name in [*(part.name for part in self._parts), self._cage_name]]

    def _require_unchanged(self):
        for item, shape in zip(self._items(), [*(part.shape for part in self._parts), self._cage]):
            if not item or mesh.fingerprint(mesh.shape_of(item.data)) != mesh.fingerprint(shape):
                name = item.name if item else 'An object'
                raise Refusal(f'{name} was changed or deleted meanwhile. Bind again')

    def _store(self, indices, weights, settings, notes):
        *models, cage = self._items()
        begin = 0
        for model, part, note in zip(models, self._parts, notes):
            rows = slice(begin, begin + len(part.shape.points))
            begin = rows.stop
            rest = np.einsum('vk,vkx->vx', weights[rows].astype(float),
                             mesh.transform(self._cage.points, part.matrix)[indices[rows]])
            mesh.write_binding(model.data, indices[rows], weights[rows], rest)
            nodes.add_modifier(model, cage, settings.influences)
            binding = model.flbc
            binding.quality = settings.quality
            binding.note = note
            binding.model_faces, binding.model_places = mesh.fingerprint(part.shape)
            binding.cage_faces, binding.cage_places = mesh.fingerprint(self._cage)
            binding.locks = part.locks
            binding.matrix = part.matrix.ravel()
        _give_pose(cage)


def _give_pose(cage):
    """Edits of the cage go to a shape key, so that its rest shape remains. A cage hides no model."""
    if cage.data.shape_keys:
        return
    cage.shape_key_add(name='Basis', from_mix=False)
    cage.shape_key_add(name=POSE, from_mix=False).value = 1
    cage.active_shape_key_index = 1
    cage.display_type = 'WIRE'


def problems(model):
    """Why a bound model may not follow its cage as it should: a list of sentences."""
    binding = model.flbc
    cage = nodes.cage_of(model)
    if not cage:
        return ['The cage was deleted. Choose another one and bind again']
    found = []
    if cage.mode == 'EDIT':
        return found
    if _evaluated_count(cage) != len(cage.data.vertices):
        found.append('Modifiers change the number of vertices of the cage. The model stays at rest')
    for item, faces, places in ((cage, binding.cage_faces, binding.cage_places),
                                (model, binding.model_faces, binding.model_places)):
        new_faces, new_places = mesh.fingerprint(mesh.shape_of(item.data))
        if new_faces != faces:
            found.append(f'Faces or vertices of {item.name} were added or removed. Rebind')
        elif new_places != places:
            found.append(f'The rest shape of {item.name} has changed. Rebind')
    if _locks(model, cage) != binding.locks:
        found.append(f'Vertex groups {LOCK}... or {SOLID}... were changed. Rebind')
    before = list(model.modifiers)[:model.modifiers.find(nodes.modifier_of(model).name)]
    found += [f'{modifier.name} comes before the cage and changes vertices. Rebind'
              for modifier in before if modifier.type in GENERATORS and modifier.show_viewport]
    return found


def require_valid(model):
    """Raises Refusal with the first of the problems."""
    for problem in problems(model):
        raise Refusal(f'{model.name}: {problem}')


def unbind(model):
    """Removes the modifier and everything that was stored."""
    model.modifiers.remove(nodes.modifier_of(model))
    mesh.remove_binding(model.data)
    model.property_unset('flbc')


def apply(model):
    """Makes the present shape of a model its rest shape, and removes the binding."""
    if model.data.shape_keys:
        raise Refusal(f'{model.name} has shape keys. Use Apply as Shape Key of the modifier')
    try:
        with bpy.context.temp_override(object=model):
            bpy.ops.object.modifier_apply(modifier=nodes.modifier_of(model).name)
    except RuntimeError as error:
        raise Refusal(f'{model.name}: {error}') from error
    mesh.remove_binding(model.data)
    model.property_unset('flbc')


def _turn_to_files(active):
    """The turn to the axes of files, with y up, which give the cage that the program makes of them.

    Imported models are turned in their mesh or in their matrix.
    """
    upright = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])
    axes = upright @ np.array(active.matrix_world)[:3, :3]
    turn = np.round(axes / np.maximum(np.linalg.norm(axes, axis=0), 1e-30))
    is_turn = (np.abs(turn).sum(0) == 1).all() and np.linalg.det(turn) > 0.5
    return turn if is_turn else upright


def make_cage(models, active, program, control_points):
    """Steps of a Job that make a cage around models, in the space of the active one.

    control_points: maximum, 0 for as many as the shape needs. Raises Refusal.
    """
    bpy.context.view_layer.update()
    active_name = active.name
    shape = mesh.joined([mesh.moved(mesh.shape_of(model.data), relative_matrix(active, model))
                         for model in models])
    if not len(shape.starts):
        raise Refusal(f'{active_name} has no faces')
    if mesh.is_flat(shape):
        raise Refusal(f'{active_name} is flat, and a cage encloses a volume. Give it thickness, '
                      'for example by extruding it')
    with tempfile.TemporaryDirectory(prefix='flbc_') as folder:
        model, cage = Path(folder, 'model.ply'), Path(folder, 'cage.obj')
        turn = _turn_to_files(active)
        files.write_ply(model, *shape._replace(points=shape.points @ turn.T))
        options = ['--control-points', control_points] if control_points else []
        weights = np.concatenate([mesh.group_weights(item, DENSITY) for item in models])
        if weights.any():
            np.savetxt(Path(folder, 'density.csv'), MOST_DENSE**weights)
            options += ['--density', Path(folder, 'density.csv')]
        yield Command([program, 'cage', model, '-o', cage, *options], {model: active_name})
        points, faces = files.read_obj(cage)
        _add_cage(active_name, points @ turn, faces)


def _add_cage(model_name, points, faces):
    model = bpy.data.objects.get(model_name)
    if not model:
        raise Refusal(f'{model_name} was deleted meanwhile')
    data = bpy.data.meshes.new(f'{model_name} Cage')
    data.from_pydata(points, [], faces)
    cage = bpy.data.objects.new(data.name, data)
    cage.matrix_world = model.matrix_world
    cage.display_type = 'WIRE'
    cage.hide_render = True
    for collection in model.users_collection:
        collection.objects.link(cage)
    bpy.context.scene.flbc.cage = cage

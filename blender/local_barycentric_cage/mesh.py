# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of Blender as arrays, and attributes on their vertices."""
import hashlib
from typing import NamedTuple

import numpy as np

PREFIX = 'flbc_'
REST = PREFIX + 'rest'


def index_name(k):
    return f'{PREFIX}index_{k}'


def weight_name(k):
    return f'{PREFIX}weight_{k}'


class Shape(NamedTuple):
    """A mesh at rest: without shape keys and modifiers."""
    points: np.ndarray   # (V, 3), float64
    corners: np.ndarray  # vertex numbers of all faces, one face after another
    starts: np.ndarray   # first corner of each face
    counts: np.ndarray   # number of corners of each face


def numbers(items, name, dtype, width=1):
    """A property of all items, one after another."""
    flat = np.empty(width * len(items), dtype)
    items.foreach_get(name, flat)
    return flat


def places_of(items):
    """Positions of the vertices of a mesh, or of the points of a shape key, (V, 3)."""
    return numbers(items, 'co', np.float32, 3).reshape(-1, 3).astype(float)


def shape_of(mesh):
    """The rest shape of a mesh that is not in Edit Mode."""
    keys = mesh.shape_keys
    vertices = keys.reference_key.data if keys else mesh.vertices
    return Shape(places_of(vertices),
                 numbers(mesh.loops, 'vertex_index', np.int32),
                 numbers(mesh.polygons, 'loop_start', np.int32),
                 numbers(mesh.polygons, 'loop_total', np.int32))


def group_weights(item, group):
    """The weight of each vertex in a vertex group, which need not exist."""
    weights = np.zeros(len(item.data.vertices))
    if group in item.vertex_groups:
        number = item.vertex_groups[group].index
        for vertex in item.data.vertices:
            weights[vertex.index] = sum(part.weight for part in vertex.groups if part.group == number)
    return weights


def members(item, group):
    """Numbers of the vertices with at least half the weight in a vertex group, if it exists."""
    return np.flatnonzero(group_weights(item, group) >= 0.5).tolist()


def joined(shapes):
    """One shape of several, in this order."""
    points = np.concatenate([shape.points for shape in shapes])
    vertices = np.cumsum([0] + [len(shape.points) for shape in shapes])
    corners = np.cumsum([0] + [len(shape.corners) for shape in shapes])
    return Shape(points,
                 np.concatenate([shape.corners + v for shape, v in zip(shapes, vertices)]),
                 np.concatenate([shape.starts + c for shape, c in zip(shapes, corners)]),
                 np.concatenate([shape.counts for shape in shapes]))


def moved(shape, matrix):
    """The shape after a 4 x 4 affine map."""
    return shape._replace(points=transform(shape.points, matrix))


def transform(points, matrix):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def is_flat(shape):
    """Whether all vertices are in one plane."""
    shifts = shape.points - shape.points.mean(0)
    spread = np.linalg.eigvalsh(shifts.T @ shifts)
    return bool(spread[0] <= 1e-12 * spread[2])


def digest(*arrays):
    sums = hashlib.blake2b(digest_size=16)
    for array in arrays:
        sums.update(np.ascontiguousarray(array))
    return sums.hexdigest()


def fingerprint(shape):
    """Hashes of the faces and of the places of a shape. They change when the shape changes."""
    return (digest(np.array(len(shape.points)), shape.corners, shape.starts),
            digest(shape.points))


def _write(mesh, name, kind, field, values):
    attribute = mesh.attributes.get(name) or mesh.attributes.new(name, kind, 'POINT')
    attribute.data.foreach_set(field, np.ascontiguousarray(values).ravel())


def write_binding(mesh, indices, weights, rest):
    """Stores a binding on the vertices.

    indices, weights: (V, k). rest: (V, 3), where the weights put the vertices when the cage is at
    rest.
    """
    remove_binding(mesh)
    for k in range(indices.shape[1]):
        _write(mesh, index_name(k), 'INT', 'value', indices[:, k].astype(np.int32))
        _write(mesh, weight_name(k), 'FLOAT', 'value', weights[:, k].astype(np.float32))
    _write(mesh, REST, 'FLOAT_VECTOR', 'vector', rest.astype(np.float32))
    mesh.update()


def read_binding(mesh):
    """Yields pairs of indices (V) and weights (V) of a binding."""
    k = 0
    while index_name(k) in mesh.attributes:
        yield (numbers(mesh.attributes[index_name(k)].data, 'value', np.int32),
               numbers(mesh.attributes[weight_name(k)].data, 'value', np.float32))
        k += 1


def remove_binding(mesh):
    """Removes all attributes of a binding."""
    for name in [attribute.name for attribute in mesh.attributes
                 if attribute.name.startswith(PREFIX)]:
        mesh.attributes.remove(mesh.attributes[name])

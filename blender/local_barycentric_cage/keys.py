# SPDX-License-Identifier: BSD-3-Clause
"""Shape keys of a model move others in the same cage: the cage is fitted to each key."""
import numpy as np

from . import binding, mesh, nodes

_STIFFNESS = 1e-5  # as in flbc fit


def _weights(model):
    """All weights of a bound model, (V, control points). Raises Refusal."""
    binding.require_valid(model)
    found = np.zeros((len(model.data.vertices), len(nodes.cage_of(model).data.vertices)))
    for index, weight in mesh.read_binding(model.data):
        found[np.arange(len(found)), index] += weight
    return found


def _laplacian(cage):
    """The graph Laplacian of the edges of a cage."""
    edges = mesh.numbers(cage.data.edges, 'vertices', np.int32, 2)
    found = np.zeros((len(cage.data.vertices),) * 2)
    np.add.at(found, (edges, edges.reshape(-1, 2)[:, ::-1].ravel()), -1)
    return found - np.diag(found.sum(1))


def _write(model, name, moves):
    """Writes the shape key of this name, by moves from rest."""
    if not model.data.shape_keys:
        model.shape_key_add(name='Basis', from_mix=False)
    keys = model.data.shape_keys
    key = keys.key_blocks.get(name) or model.shape_key_add(name=name, from_mix=False)
    places = mesh.places_of(keys.reference_key.data) + moves
    key.data.foreach_set('co', places.astype(np.float32).ravel())


def transfer(body, followers):
    """Gives models the shape keys of another one in the same cage, by least squares.

    Keys of the same names are replaced. Returns the number of keys and the largest distance between
    the body in a key and where the fitted cage puts it, relative to the size. Raises Refusal.
    """
    cage = nodes.cage_of(body)
    weights, others = _weights(body), [_weights(model) for model in followers]
    square = weights.T @ weights
    equations = square + _STIFFNESS * np.trace(square) / len(square) * _laplacian(cage)
    to_cage = np.linalg.inv(binding.rest_matrix(body, cage)[:3, :3]).T
    keys = body.data.shape_keys
    moving = [key for key in keys.key_blocks if key != keys.reference_key]
    farthest = 0
    for key in moving:
        moves = mesh.places_of(key.data) - mesh.places_of(key.relative_key.data)
        moves = moves @ to_cage
        # Of the solutions the shortest: a part of the cage may move no vertex of the body.
        pose = np.linalg.lstsq(equations, weights.T @ moves, rcond=None)[0]
        farthest = max(farthest, np.linalg.norm(weights @ pose - moves, axis=1).max())
        for model, own in zip(followers, others):
            _write(model, key.name, own @ pose @ binding.rest_matrix(model, cage)[:3, :3].T)
    return len(moving), farthest / np.linalg.norm(np.ptp(mesh.places_of(cage.data.vertices), axis=0))

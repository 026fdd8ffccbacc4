# SPDX-License-Identifier: BSD-3-Clause
"""Functions with damaged arguments return a result or raise an exception for wrong arguments."""
import os
import warnings

import flbc
import numpy as np
import pytest

# Seeds per function; 10,000 need minutes.
COUNT = int(os.environ.get("FLBC_MUTATIONS", "150"))

NUMBERS = [np.nan, np.inf, -np.inf, 0.0, -1.0, 1e300, -1e300, 1e155, 1e-300, 0.5]
INDICES = [-1, 0, 3, 2**31 - 1, 2**31, -(2**31), 2**63 - 1]


class Mutator:
    """Damages arrays, the same way for the same seed."""

    def __init__(self, seed):
        self.random = np.random.default_rng(seed)

    def one_of(self, choices):
        return choices[self.random.integers(len(choices))]

    def damaged(self, array):
        if self.random.integers(3) > 0:
            return array
        return self.one_of([self.other_entries, self.other_shape, self.other_type])(array.copy())

    def other_entries(self, array):
        values = NUMBERS if array.dtype.kind == "f" else INDICES
        if array.dtype.kind != "f":
            array = array.astype(np.int64)
        for _ in range(self.random.integers(1, 4)):
            array.flat[self.random.integers(array.size)] = self.one_of(values)
        return array

    def other_shape(self, array):
        return self.one_of(
            [array[:-1], array[:0], array[:, :1], array.T, array.ravel(), array[None],
             np.repeat(array, 2, axis=0), array[0, 0]]
        )

    def other_type(self, array):
        return self.one_of(
            [array.astype(np.float16), array.astype(str), array.astype(complex), array.tolist(),
             array.astype(object), array > 0, np.asfortranarray(array), array[::-1][::-1],
             array.astype(array.dtype.newbyteorder()), None, "text", 3]
        )


def small(dim):
    """A box, a mesh of it, and weights."""
    if dim == 2:
        cage = flbc.Cage([[0, 0], [1, 0], [1, 1], [0, 1]])
    else:
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
        quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        cage = flbc.Cage(corners, quads)
    mesh = flbc.mesh(cage, vertices=30 if dim == 2 else 0)
    return cage, mesh, flbc.solve(cage, mesh)


@pytest.fixture(scope="module", params=[2, 3])
def valid(request):
    return small(request.param)


def shapes(m, valid):
    cage, mesh, _ = valid
    return ((m.damaged(cage.points), m.damaged(cage.facets)),
            (m.damaged(mesh.points), m.damaged(mesh.cells)))


def solve(m, valid):
    phi = m.damaged(np.ones((len(valid[1].cells), len(valid[0]))))
    flbc.solve(*shapes(m, valid), max_iterations=10, phi=m.one_of([phi, "square", "linear"]))


def solver(m, valid):
    cage, mesh, _ = valid
    solver = flbc.Solver(cage, mesh, max_iterations=10)
    solver.reshape(m.damaged(cage.points * 1.01), iterations=2)


def at(m, valid):
    points = m.damaged(valid[1].points)
    valid[2].at(points, outside=m.one_of(["fail", "nearest", "extend", 1]))
    valid[2].gradients(points)


def bind(m, valid):
    cage, mesh, _ = valid
    cage_like, mesh_like = shapes(m, valid)
    binding = flbc.bind(
        m.damaged(mesh.points), m.damaged(mesh.cells), m.one_of([cage, cage_like]),
        domain=m.one_of([mesh, mesh_like]), max_influences=m.one_of([0, 4, 8, -1]),
        max_iterations=10,
    )
    binding.deform(m.damaged(cage.points))
    binding.jacobians(m.damaged(cage.points))
    binding.reduced(m.one_of([None, 4, 5, 0])).transferred(
        m.damaged(mesh.points), m.damaged(mesh.cells), from_faces=m.one_of([None, mesh.cells[:, :3]])
    )
    mask = m.one_of([m.damaged(np.eye(len(mesh.points), len(cage)) > 0), [([0], [1])]])
    flbc.Binding(m.damaged(valid[2].weights), cage, mesh.points, m.damaged(mesh.cells), mask)


def use_weights(m, valid):
    cage, mesh, solution = valid
    weights = m.one_of([m.damaged(solution.weights), solution.sparse_weights])
    points, faces = m.damaged(mesh.points), m.one_of([None, m.damaged(mesh.cells)])
    flbc.measure(weights, cage, points)
    binding = flbc.Binding(weights, shapes(m, valid)[0], points, faces)
    binding.reduced(m.one_of([None, 4, 5, 0, -1]), poses=[m.damaged(cage.points)])
    binding.transferred(m.damaged(mesh.points), from_faces=m.damaged(mesh.cells[:, :3]))


def look(m, valid):
    cage_like, mesh_like = shapes(m, valid)
    flbc.check(cage_like, m.damaged(valid[1].points), m.damaged(valid[2].weights))
    flbc.DomainMesh(*mesh_like)
    flbc.mean_value(cage_like, m.damaged(valid[1].points))


@pytest.mark.parametrize("call", [solve, solver, at, bind, use_weights, look])
def test_damaged_arguments_are_accepted_or_refused(call, valid):
    accepted = 0
    for seed in range(COUNT):
        try:
            with warnings.catch_warnings(), np.errstate(all="ignore"):
                warnings.simplefilter("ignore")
                call(Mutator(seed), valid)
            accepted += 1
        except (flbc.Error, ValueError, TypeError):
            pass
        except Exception as error:
            pytest.fail(f"seed {seed}: {type(error).__name__}: {error}")
    assert 0 < accepted < COUNT

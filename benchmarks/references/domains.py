# SPDX-License-Identifier: BSD-3-Clause
"""Small cages with meshes of their interiors.

A shape is a coarse complex of simplices whose boundary is the cage. Every simplex is subdivided
regularly, so every cage facet is a union of mesh facets; then interior vertices are jittered.
"""

import itertools
import math
import random
from dataclasses import dataclass

import numpy as np


@dataclass
class Shape:
    """A coarse complex in 2D or 3D. Its boundary vertices, the first ones, are control points."""
    points: np.ndarray  # rows are points
    simplices: list  # tuples of Dim + 1 vertices
    control_points: int


@dataclass
class Domain:
    """A cage and a mesh of its interior; the rows of all arrays are points, facets or cells."""
    cage_points: np.ndarray
    cage_facets: np.ndarray  # outward: counter-clockwise in 2D (holes clockwise)
    points: np.ndarray
    cells: np.ndarray  # positively oriented
    boundary_weights: dict  # vertex -> its barycentric coordinates in its cage facet, as a row

    @property
    def dim(self):
        return self.points.shape[1]

    def interior(self):
        return [v for v in range(len(self.points)) if v not in self.boundary_weights]


def make_domain(shape, parts, jitter, seed):
    """Cuts every edge of the shape into `parts` and moves every interior vertex by up to `jitter`
    of the least height of its cells, the same way on every machine."""
    cage_facets = boundary_facets(shape.points, shape.simplices)
    if {v for facet in cage_facets for v in facet} != set(range(shape.control_points)):
        raise ValueError("the vertices on the boundary of a shape have to be its first ones")
    vertices, cells = subdivide(shape.simplices, parts)
    # A vertex is a tuple of (coarse vertex, parts): barycentric coordinates, free of rounding.
    points = np.array([sum(count * shape.points[c] for c, count in v) / parts for v in vertices])
    on_boundary = boundary_of(vertices, cage_facets)
    cells = [oriented(points, cell) for cell in cells]
    points = move_interior(points, cells, on_boundary, jitter, seed)
    if min(measure(points[list(cell)]) for cell in cells) <= 0:
        raise ValueError("so much jitter turns a cell round")
    weights = {v: coarse_weights(vertices[v], parts, shape.control_points) for v in on_boundary}
    return Domain(shape.points[:shape.control_points], np.array(cage_facets), points,
                  np.array(cells), weights)


def boundary_facets(points, simplices):
    """The facets of only one simplex, in outward orientation."""
    found = {}
    for simplex in simplices:
        cell = oriented(points, simplex)
        for k in range(len(cell)):
            facet = cell[:k] + cell[k + 1:]
            found.setdefault(tuple(sorted(facet)), []).append(outward(facet, k))
    return [owners[0] for owners in found.values() if len(owners) == 1]


def outward(facet, left_out):
    """The induced orientation of the facet of a positively oriented simplex."""
    return facet if left_out % 2 == 0 else (facet[1], facet[0]) + facet[2:]


def measure(corners):
    """Signed area or volume."""
    edges = corners[1:] - corners[0]
    return np.linalg.det(edges) / math.factorial(len(edges))


def oriented(points, cell):
    """The cell with positive measure."""
    cell = tuple(cell)
    return cell if measure(points[list(cell)]) > 0 else (cell[1], cell[0]) + cell[2:]


def subdivide(simplices, parts):
    """Freudenthal's subdivision. It cuts a common facet alike from both sides because all simplices
    list their vertices in ascending order. Returns (vertices, cells)."""
    numbers, cells = {}, []
    for simplex in simplices:
        corners = sorted(simplex)
        for path in kuhn_cells(len(corners) - 1, parts):
            keys = [key_of(corners, parts, p) for p in path]
            cells.append([numbers.setdefault(key, len(numbers)) for key in keys])
    return list(numbers), cells


def kuhn_cells(dim, parts):
    """The cells of the grid simplex parts >= x_1 >= x_2 >= ... >= 0, each as a path of points."""
    for corner in itertools.product(range(parts), repeat=dim):
        for order in itertools.permutations(range(dim)):
            path = [corner]
            for axis in order:
                path.append(tuple(x + (k == axis) for k, x in enumerate(path[-1])))
            if all(tuple(sorted(p, reverse=True)) == p for p in path):
                yield path


def key_of(corners, parts, p):
    steps = (parts,) + p + (0,)
    counts = [steps[k] - steps[k + 1] for k in range(len(corners))]
    return tuple((corner, count) for corner, count in zip(corners, counts) if count)


def boundary_of(vertices, cage_facets):
    facets = [set(facet) for facet in cage_facets]
    return {number for number, vertex in enumerate(vertices)
            if any({corner for corner, _ in vertex} <= facet for facet in facets)}


def coarse_weights(vertex, parts, control_points):
    row = np.zeros(control_points)
    for corner, count in vertex:
        row[corner] = count / parts
    return row


def move_interior(points, cells, on_boundary, jitter, seed):
    source = random.Random(seed)
    dim = points.shape[1]
    room = np.full(len(points), math.inf)
    for cell in cells:
        corners = points[list(cell)]
        hats = hat_gradients(corners)
        room[list(cell)] = np.minimum(room[list(cell)], 1 / np.linalg.norm(hats, axis=0).max())
    moved = points.copy()
    for v in range(len(points)):
        if v in on_boundary:
            continue
        direction = np.array([source.random() - 0.5 for _ in range(dim)])
        moved[v] += jitter * room[v] * source.random() * direction / np.linalg.norm(direction)
        moved[v] = np.round(moved[v], 6)  # shorter files
    return moved


def hat_gradients(corners):
    """Dim x (Dim + 1), the gradients of a cell's hat functions."""
    inverse = np.linalg.inv(corners[1:] - corners[0])
    return np.hstack([-inverse.sum(axis=1, keepdims=True), inverse])

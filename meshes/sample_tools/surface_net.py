# SPDX-License-Identifier: BSD-3-Clause
"""The surface of a spatial field as a triangle mesh with one vertex per grid cell it crosses.

The method is the surface net: every grid edge with a change of sign gives a quadrilateral between
the four cells around it. Afterwards the vertices are evened out along the surface.
"""

from .fields import gradient, project
from .quads import split
from .vectors import add, dot, scale, sub

CORNERS = [(i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1)]


def polygonise(field, low, high, spacing, rounds=8):
    """Meshes the zero set within the box low..high. Returns (points, outward triangles)."""
    counts = [int((h - l) / spacing) + 2 for l, h in zip(low, high)]
    values = sample(field, low, counts, spacing)
    cells, points = cell_points(values, low, spacing)
    quads = crossing_quads(values, cells)
    check_edges(quads)
    points = even_out(field, points, quads, rounds)
    return points, split(points, quads)


def sample(field, low, counts, spacing):
    return {(i, j, k): field((low[0] + i * spacing, low[1] + j * spacing, low[2] + k * spacing))
            for i in range(counts[0]) for j in range(counts[1]) for k in range(counts[2])}


def cell_points(values, low, spacing):
    """A point for each cell with a change of sign: the mean of the crossings of its edges."""
    cells, points = {}, []
    for cell in values:
        corners = [add(cell, c) for c in CORNERS]
        signs = [values[c] < 0 for c in corners if c in values]
        if len(signs) < 8 or all(signs) or not any(signs):
            continue
        crossings = []
        for a in corners:
            for axis in range(3):
                b = a[:axis] + (a[axis] + 1,) + a[axis + 1:]
                if b in corners and (values[a] < 0) != (values[b] < 0):
                    t = values[a] / (values[a] - values[b])
                    crossings.append(a[:axis] + (a[axis] + t,) + a[axis + 1:])
        middle = [sum(c[axis] for c in crossings) / len(crossings) for axis in range(3)]
        cells[cell] = len(points)
        points.append(add(low, scale(spacing, middle)))
    return cells, points


def crossing_quads(values, cells):
    """A quadrilateral, outward, across each grid edge with a change of sign."""
    quads = []
    for a, value in values.items():
        for axis in range(3):
            b = a[:axis] + (a[axis] + 1,) + a[axis + 1:]
            if b not in values or (value < 0) == (values[b] < 0):
                continue
            quad = []
            for u, v in ((-1, -1), (0, -1), (0, 0), (-1, 0)):
                cell = list(a)
                cell[(axis + 1) % 3] += u
                cell[(axis + 2) % 3] += v
                if tuple(cell) not in cells:
                    raise RuntimeError("the shape reaches the side of its box")
                quad.append(cells[tuple(cell)])
            quads.append(quad if value < 0 else quad[::-1])
    return quads


def check_edges(quads):
    """Raises where two sheets meet in one cell, which the method cannot tell apart."""
    edges = [(a, b) for q in quads for a, b in zip(q, q[1:] + q[:1])]
    if len(edges) != len(set(edges)):
        raise RuntimeError("the surface is not manifold: move or refine the grid")


def even_out(field, points, quads, rounds):
    """Moves vertices towards the middle of their neighbours, but along the surface only."""
    neighbours = [[] for _ in points]
    for quad in quads:
        for k in range(4):
            neighbours[quad[k]].append(quad[(k + 1) % 4])
    for _ in range(rounds):
        moved = []
        for p, near in zip(points, neighbours):
            slope = gradient(field, p)
            normal = scale(1 / dot(slope, slope), slope)
            pull = sub(scale(1 / len(near), [sum(points[v][i] for v in near) for i in range(3)]), p)
            p = add(p, scale(0.7, sub(pull, scale(dot(pull, slope), normal))))
            moved.append(sub(p, scale(field(p), normal)))
        points = moved
    return [project(field, p) for p in points]

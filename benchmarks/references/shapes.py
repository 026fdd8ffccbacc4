# SPDX-License-Identifier: BSD-3-Clause
"""The coarse complexes from which the reference problems are made."""

import itertools
import math

import numpy as np

from domains import Shape


def star():
    """A non-convex decagon round an interior vertex, no two spikes alike."""
    radii = (1.0, 0.42, 0.85, 0.5, 1.15, 0.38, 0.95, 0.45, 0.8, 0.52)
    ring = [(r * math.cos(0.2 * math.pi * k), r * math.sin(0.2 * math.pi * k))
            for k, r in enumerate(radii)]
    return Shape(np.round(ring + [(0, 0)], 3), [(k, (k + 1) % 10, 10) for k in range(10)], 10)


def corner():
    """An L with a control point in the middle of its straight lower edge."""
    points = [(0, 0), (1.1, 0), (2.5, 0), (2.5, 0.75), (1, 1), (0.9, 2), (0, 2.2)]
    return Shape(np.array(points), [(0, 1, 4), (1, 2, 3), (1, 3, 4), (0, 4, 6), (4, 5, 6)], 7)


def annulus():
    """A square with a turned, off-centre square hole."""
    outer = [(0, 0), (3, 0), (3, 3), (0, 3)]
    inner = [(0.9, 0.8), (2, 1), (1.8, 2.1), (0.7, 1.9)]
    cells = []
    for k in range(4):
        n = (k + 1) % 4
        cells += [(k, n, 4 + n), (k, 4 + n, 4 + k)]
    return Shape(np.array(outer + inner), cells, 8)


def bolt():
    """A thin Z, whose triangles are flat."""
    points = [(0, 0), (2.6, 0), (2.2, 0.5), (1.2, 0.6), (3.4, 1.3), (3.5, 1.7), (0.8, 1.6),
              (1.0, 1.1)]
    cells = [(0, 1, 2), (0, 2, 3), (0, 3, 7), (3, 4, 7), (4, 5, 7), (5, 6, 7)]
    return Shape(np.array(points), cells, 8)


def box(x, y, z):
    """Boxes side by side, each split into six tetrahedra round its main diagonal. All their corners
    are control points, also those in the middle of an edge or a face; the grid must have no
    interior point. x, y, z: the places of the cuts."""
    cuts = (x, y, z)
    places = list(itertools.product(*(range(len(c)) for c in cuts)))
    number = {p: k for k, p in enumerate(places)}
    cells = []
    for low in itertools.product(*(range(len(c) - 1) for c in cuts)):
        for order in itertools.permutations(range(3)):
            path = [low]
            for axis in order:
                path.append(tuple(p + (k == axis) for k, p in enumerate(path[-1])))
            cells.append(tuple(number[p] for p in path))
    points = [[c[k] for c, k in zip(cuts, p)] for p in places]
    return Shape(np.array(points, dtype=float), cells, len(points))


def prism(base, height, shift):
    """A planar shape times an interval, its top shifted sideways. Each triangle gives three
    tetrahedra; common walls are cut alike because of the ascending order."""
    count = len(base.points)
    bottom = np.hstack([base.points, np.zeros((count, 1))])
    top = np.hstack([base.points + shift, np.full((count, 1), height)])
    cells = []
    for triangle in base.simplices:
        a, b, c = sorted(triangle)
        cells += [(a, b, c, c + count), (a, b, b + count, c + count),
                  (a, a + count, b + count, c + count)]
    return Shape(np.vstack([bottom, top]), cells, 2 * count)


def notched_prism():
    """An L-shaped prism of twelve control points."""
    points = [(0, 0), (2, 0), (2, 0.8), (0.9, 1), (0.8, 2), (0, 2.1)]
    base = Shape(np.array(points), [(0, 1, 2), (0, 2, 3), (0, 3, 5), (3, 4, 5)], 6)
    return prism(base, 0.9, (0.2, 0.1))


def spindle():
    """A non-convex bipyramid round the edge between its tips; its waist has six control points."""
    radii = (1.0, 0.5, 1.1, 0.45, 0.9, 0.55)
    waist = [(r * math.cos(k * math.pi / 3), r * math.sin(k * math.pi / 3), 0.1 * (k % 3))
             for k, r in enumerate(radii)]
    points = np.round(waist + [(0.1, 0, 1.3), (0, 0.1, -0.9)], 3)
    return Shape(points, [(k, (k + 1) % 6, 6, 7) for k in range(6)], 8)


def slanted(shape):
    """Sheared against the diagonals of its splitting: the obtuse angles make weights negative
    where nothing forbids it."""
    shear = np.array([[1, 0, 0], [-0.9, 0.7, 0], [-0.5, -0.9, 0.5]])
    return Shape(np.round(shape.points @ shear, 4), shape.simplices, shape.control_points)

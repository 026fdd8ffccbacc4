# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces put together from rings of points and quadrilaterals."""

from .vectors import norm, sub


def bridge(ring, other):
    """The quadrilaterals between two rings of as many vertices. They face outwards if the rings
    turn counter-clockwise for a viewer who looks from `other` back to `ring`."""
    n = len(ring)
    return [(ring[k], ring[(k + 1) % n], other[(k + 1) % n], other[k]) for k in range(n)]


def fan(ring, tip):
    """The triangles from a closed ring to a tip, facing as the ring turns."""
    return [(a, b, tip) for a, b in zip(ring, ring[1:] + ring[:1])]


def split(points, quads):
    """Two triangles for each quadrilateral, along its shorter diagonal."""
    triangles = []
    for a, b, c, d in quads:
        # The margin makes ties of symmetric shapes come out alike whatever the rounding.
        if norm(sub(points[a], points[c])) < norm(sub(points[b], points[d])) + 1e-6:
            triangles += [(a, b, c), (a, c, d)]
        else:
            triangles += [(a, b, d), (b, c, d)]
    return triangles

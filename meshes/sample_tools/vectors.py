# SPDX-License-Identifier: BSD-3-Clause
"""Points and vectors as tuples of floats, of any dimension."""

import math
import operator


def add(a, b):
    return tuple(map(operator.add, a, b))


def sub(a, b):
    return tuple(map(operator.sub, a, b))


def scale(s, a):
    return tuple([s * x for x in a])


def dot(a, b):
    return sum(map(operator.mul, a, b))


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scale(1.0 / norm(a), a)


def lerp(a, b, t):
    return tuple(x + t * (y - x) for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rotate(p, centre, degrees):
    """p turned about centre in the plane of the first two coordinates, counter-clockwise."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, y = p[0] - centre[0], p[1] - centre[1]
    return (centre[0] + c * x - s * y, centre[1] + s * x + c * y) + tuple(p[2:])


def catmull_rom(nodes, steps):
    """Points of the smooth curve through the nodes, `steps` per piece, both end nodes included.

    A node may carry more than a position, such as a radius: every component is interpolated.
    """
    padded = [sub(scale(2, nodes[0]), nodes[1]), *nodes, sub(scale(2, nodes[-1]), nodes[-2])]
    points = []
    for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:]):
        for t in (i / steps for i in range(steps)):
            points.append(tuple(
                0.5 * (2 * q + t * (r - p + t * (2 * p - 5 * q + 4 * r - s
                                                 + t * (3 * (q - r) + s - p))))
                for p, q, r, s in zip(a, b, c, d)))
    return points + [tuple(nodes[-1])]

# SPDX-License-Identifier: BSD-3-Clause
"""Awkward cages in 3D. A cage is (points, triangles); each is the same in every run."""

import math
import random

BOX_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1),
             (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
TET_FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def box(x, y, z, corner=(0.0, 0.0, 0.0)):
    return ([(corner[0] + a, corner[1] + b, corner[2] + c)
             for a in (0.0, x) for b in (0.0, y) for c in (0.0, z)], list(BOX_FACES))


def tet(height, corner=(0.0, 0.0, 0.0)):
    return ([(corner[0] + x, corner[1] + y, corner[2] + z)
             for x, y, z in ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0),
                             (0.2, 0.3, height))], list(TET_FACES))


def turned(cage):
    points, faces = cage
    return points, [(a, c, b) for a, b, c in faces]


def together(*cages):
    points, faces = [], []
    for more, triangles in cages:
        faces += [tuple(i + len(points) for i in face) for face in triangles]
        points = points + more
    return points, faces


def moved(cage, offset=0.0, scale=1.0):
    points, faces = cage
    return [tuple(offset + scale * x for x in p) for p in points], faces


def sphere(rows, columns, radius=lambda row, column: 1.0):
    """Poles, and `rows` circles of `columns` points: 2 + rows * columns control points."""
    points = [(0.0, 0.0, radius(-1, 0))]
    for i in range(rows):
        polar = math.pi * (i + 1) / (rows + 1)
        for j in range(columns):
            r, angle = radius(i, j), 2 * math.pi * j / columns
            points.append((r * math.sin(polar) * math.cos(angle),
                           r * math.sin(polar) * math.sin(angle), r * math.cos(polar)))
    points.append((0.0, 0.0, -radius(rows, 0)))
    faces, last = [], len(points) - 1
    for j in range(columns):
        k = (j + 1) % columns
        faces.append((0, 1 + j, 1 + k))
        faces.append((last, last - columns + k, last - columns + j))
        for i in range(rows - 1):
            a, b = 1 + i * columns, 1 + (i + 1) * columns
            faces += [(a + j, b + j, b + k), (a + j, b + k, a + k)]
    return points, faces


def rough(rows, columns, seed):
    numbers = random.Random(seed)
    radii = {}
    return sphere(rows, columns, lambda i, j: radii.setdefault((i, j), 0.6 + 0.4 * numbers.random()))


def cages():
    """Names, whether it has to be solved (True), refused (False) or either (None), and cages."""
    yield from ((f"plate_{h:g}", True if h > 1e-3 else None, box(1.0, 1.0, h)) for h in (1e-2, 1e-9))
    yield "rod_0.001", None, box(1.0, 1e-3, 1e-3)
    yield "tetrahedron_0.001", None, tet(1e-3)
    yield "sphere_3_8", True, sphere(3, 8)
    yield "rough_3_6", True, rough(3, 6, 3)
    ball, one = sphere(3, 6), box(1.0, 1.0, 1.0)
    yield "nested_0.3", True, together(ball, turned(moved(ball, scale=0.7)))
    yield "nested_boxes_shifted", True, together(one, turned(box(0.5, 0.5, 0.5, (0.49, 0.3, 0.3))))
    yield "touch_at_a_face", None, together(one, box(1.0, 1.0, 1.0, (1.0, 0.0, 0.0)))
    yield "overlap_by_a_hair", False, together(one, box(1.0, 1.0, 1.0, (1.0 - 1e-9, 0.2, 0.3)))
    yield "apart_many", True, together(*[tet(1.0, (2.0 * i, 0.0, 0.0)) for i in range(12)])
    points, faces = one
    yield "inside_out", True, (points, [(a, c, b) for a, b, c in faces])
    yield "open", False, (points, faces[:-1])
    yield "a_fin", False, (points + [(0.5, 0.5, 3.0)], faces + [(0, 1, 8)])
    yield "flat", False, ([(x, y, 0.0) for x, y, _ in points], faces)
    yield "size_1e-200", None, moved(sphere(2, 4), scale=1e-200)
    yield "far_1e+08", None, moved(sphere(2, 4), offset=1e8)

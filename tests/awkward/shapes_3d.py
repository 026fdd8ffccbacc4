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


def moved(cage, offset=0.0, scale=1.0, stretch=(1.0, 1.0, 1.0)):
    points, faces = cage
    return [tuple(offset + scale * x * s for x, s in zip(p, stretch)) for p in points], faces


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


def torus(around, across, thickness):
    points = [((1 + thickness * math.cos(b)) * math.cos(a),
               (1 + thickness * math.cos(b)) * math.sin(a), thickness * math.sin(b))
              for a in (2 * math.pi * i / around for i in range(around))
              for b in (2 * math.pi * j / across for j in range(across))]
    def at(i, j):
        return i % around * across + j % across
    faces = []
    for i in range(around):
        for j in range(across):
            faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)),
                      (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
    return points, faces


def cone(sides, height, radius=1.0):
    """A pyramid over a polygon whose middle is a control point."""
    points = [(radius * math.cos(2 * math.pi * i / sides),
               radius * math.sin(2 * math.pi * i / sides), 0.0) for i in range(sides)]
    points += [(0.0, 0.0, 0.0), (0.0, 0.0, height)]
    faces = []
    for i in range(sides):
        k = (i + 1) % sides
        faces += [(i, k, sides + 1), (k, i, sides)]
    return points, faces


def twisted(angle, height=2.0):
    """A box whose top is turned."""
    corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
    c, s = math.cos(angle), math.sin(angle)
    points = [(x, y, 0.0) for x, y in corners]
    points += [(c * x - s * y, s * x + c * y, height) for x, y in corners]
    faces = [(0, 2, 1), (0, 3, 2), (4, 5, 6), (4, 6, 7)]
    for i in range(4):
        k = (i + 1) % 4
        faces += [(i, k, 4 + k), (i, 4 + k, 4 + i)]
    return points, faces


def solids():
    """Cages of one piece."""
    yield from ((f"plate_{h:g}", True if h > 1e-3 else None, box(1.0, 1.0, h))
                for h in (0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-13))
    yield from ((f"rod_{w:g}", True if w > 1e-3 else None, box(1.0, w, w))
                for w in (0.1, 1e-2, 1e-3, 1e-5, 1e-8))
    yield from ((f"tetrahedron_{h:g}", True if 1e-3 < h < 1e3 else None, tet(h))
                for h in (1.0, 0.1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-12, 100.0, 1e4, 1e8))
    yield from ((f"sphere_{r}_{c}", True, sphere(r, c))
                for r, c in ((2, 3), (3, 8), (7, 12), (15, 24), (3, 100)))
    yield from ((f"sphere_{r}_{c}", None, sphere(r, c)) for r, c in ((1, 500), (24, 62)))
    yield from ((f"rough_{r}_{c}", True, rough(r, c, r)) for r, c in ((3, 6), (8, 12), (14, 20)))
    yield from ((f"rough_{r}_{c}", None, rough(r, c, r)) for r, c in ((3, 60), (20, 40), (27, 55)))
    yield from ((f"spikes_{c}_{d:g}", None,
                 sphere(5, c, lambda i, j, d=d: 1.0 if (i + j) % 2 else d))
                for c, d in ((6, 0.5), (8, 0.2), (12, 0.1), (8, 0.01)))
    yield from ((f"flat_ball_{s:g}", True if s > 1e-3 else None,
                 moved(sphere(5, 10), stretch=(1.0, 1.0, s)))
                for s in (0.1, 1e-2, 1e-4, 1e-7))
    yield from ((f"long_ball_{s:g}", None, moved(sphere(5, 10), stretch=(1.0, 1.0, s)))
                for s in (10.0, 1e3, 1e6))
    yield from ((f"torus_{n}_{m}_{t:g}", None if t < 0.05 else True, torus(n, m, t))
                for n, m, t in ((6, 3, 0.3), (12, 6, 0.5), (20, 4, 0.1), (30, 3, 0.02),
                                (40, 3, 1e-3)))
    yield from ((f"cone_{n}_{h:g}", None, cone(n, h))
                for n, h in ((3, 1.0), (20, 1.0), (100, 0.3), (100, 10.0), (10, 1e-3), (10, 1e-6),
                             (6, 1e5), (1200, 1.0)))
    yield from ((f"twisted_{a:g}", None if a > 1.3 else True, twisted(a))
                for a in (0.5, 1.2, 1.5, 2.0, 3.0))


def several():
    """Cages in a cage, beside each other, touching."""
    ball = sphere(3, 6)
    yield from ((f"nested_{g:g}", True if g > 1e-2 else None,
                 together(ball, turned(moved(ball, scale=1.0 - g))))
                for g in (0.9, 0.3, 1e-2, 1e-4, 1e-7, 1e-11, 0.0))
    yield "nested_boxes_shifted", True, together(
        box(1.0, 1.0, 1.0), turned(box(0.5, 0.5, 0.5, (0.49, 0.3, 0.3))))
    yield "nested_four_deep", True, together(
        ball, turned(moved(ball, scale=0.75)), moved(ball, scale=0.5),
        turned(moved(ball, scale=0.25)))
    yield "hole_touches_wall", False, together(
        box(1.0, 1.0, 1.0), turned(box(0.5, 0.5, 0.5, (0.5, 0.2, 0.2))))
    yield "hole_touches_corner", False, together(box(1.0, 1.0, 1.0), turned(tet(0.5)))
    one = box(1.0, 1.0, 1.0)
    yield "touch_at_a_corner", None, together(one, box(1.0, 1.0, 1.0, (1.0, 1.0, 1.0)))
    yield "touch_along_an_edge", None, together(one, box(1.0, 1.0, 1.0, (1.0, 1.0, 0.0)))
    yield "touch_at_a_face", None, together(one, box(1.0, 1.0, 1.0, (1.0, 0.0, 0.0)))
    yield from ((f"beside_{d:g}", None, together(one, box(1.0, 1.0, 1.0, (1.0 + d, 0.0, 0.0))))
                for d in (1e-3, 1e-6, 1e-9, 1e-14))
    yield "overlap", False, together(one, box(1.0, 1.0, 1.0, (0.5, 0.5, 0.5)))
    yield "overlap_by_a_hair", False, together(one, box(1.0, 1.0, 1.0, (1.0 - 1e-9, 0.2, 0.3)))
    yield "apart", True, together(one, box(1.0, 1.0, 1.0, (2.0, 0.0, 0.0)))
    yield "apart_many", True, together(*[tet(1.0, (2.0 * i, 0.0, 0.0)) for i in range(12)])
    yield "apart_far", None, together(one, box(1.0, 1.0, 1.0, (1e7, 0.0, 0.0)))
    yield "apart_uneven", None, together(one, box(1e-6, 1e-6, 1e-6, (2.0, 0.0, 0.0)))


def defective():
    """Cages that are none, which have to be refused, and orders that do not matter."""
    points, faces = box(1.0, 1.0, 1.0)
    yield "inside_out", True, (points, [(a, c, b) for a, b, c in faces])
    yield "mixed_orders", None, (points, [(a, c, b) if i % 3 == 0 else (a, b, c)
                                          for i, (a, b, c) in enumerate(faces)])
    yield "open", False, (points, faces[:-1])
    yield "a_face_twice", False, (points, faces + faces[:1])
    yield "a_fin", False, (points + [(0.5, 0.5, 3.0)], faces + [(0, 1, 8)])
    yield "loose_point", False, (points + [(0.5, 0.5, 0.5)], faces)
    yield "flat", False, ([(x, y, 0.0) for x, y, _ in points], faces)
    yield "on_one_point", False, ([(1.0, 2.0, 3.0)] * 4, list(TET_FACES))
    yield "corner_pushed_through", False, ([(3.0, 3.0, 0.3), *points[1:]], faces)
    yield "face_without_area", False, (points + [(0.5, 0.0, 0.0)], faces + [(0, 4, 8), (0, 8, 4)])


def placed():
    """Far from the origin, tiny, huge."""
    ball = sphere(2, 4)
    yield from ((f"far_{o:g}", True if abs(o) < 1e7 else None, moved(ball, offset=o))
                for o in (1e3, -1e6, 1e8, 1e11, 1e15, 1e200))
    yield from ((f"size_{s:g}", True if 1e-20 < s < 1e20 else None, moved(ball, scale=s))
                for s in (1e-6, 1e-12, 1e-40, 1e-110, 1e-200, 1e-310, 1e6, 1e40, 1e110, 1e300))


def cages():
    """Names, whether it has to be solved (True), refused (False) or either (None), and cages."""
    yield from solids()
    yield from several()
    yield from defective()
    yield from placed()

# SPDX-License-Identifier: BSD-3-Clause
"""Fills closed polygons with well-shaped triangles.

Coordinates are rounded to a grid of integers first: all decisions are then exact, so that the
result does not depend on the machine.
"""

import math

UNIT = 100000  # grid cells per unit of length; files are written with five decimals


def fill(loops, spacing):
    """Triangulates the inside of closed polygons whose points are about `spacing` apart.

    Returns (points, triangles): the loops' points in order, then interior ones; triangles
    counter-clockwise. Raises RuntimeError if an edge of a polygon is not an edge of a triangle.
    """
    border = [[to_grid(p) for p in loop] for loop in loops]
    edges = [e for loop in border for e in zip(loop, loop[1:] + loop[:1])]
    fixed = [p for loop in border for p in loop]
    inner = honeycomb(edges, spacing)
    for _ in range(4):
        points = fixed + inner
        inner = centred(points, inside(edges, points, delaunay(points)), len(fixed))
    points = fixed + inner
    triangles = inside(edges, points, delaunay(points))
    check_border(loops, triangles)
    return [(x / UNIT, y / UNIT) for x, y in points], triangles


def to_grid(p):
    return (round(p[0] * UNIT), round(p[1] * UNIT))


def honeycomb(edges, spacing):
    """Points of a regular triangular grid inside the polygons, not too close to their edges."""
    step = spacing * UNIT
    row_height = step * math.sqrt(3) / 2
    low_x, high_x = min(a[0] for a, _ in edges), max(a[0] for a, _ in edges)
    low_y, high_y = min(a[1] for a, _ in edges), max(a[1] for a, _ in edges)
    points = []
    for row in range(int((high_y - low_y) / row_height) + 1):
        for column in range(int((high_x - low_x) / step) + 1):
            p = (round(low_x + (column + 0.5 * (row % 2)) * step), round(low_y + row * row_height))
            if encloses(edges, p) and min(distance(p, a, b) for a, b in edges) > 0.6 * step:
                points.append(p)
    return points


def encloses(edges, p):
    """Whether p is inside, by the parity of crossings; exact in integers."""
    crossings = 0
    for a, b in edges:
        if (a[1] > p[1]) != (b[1] > p[1]):
            low, high = (a, b) if a[1] < b[1] else (b, a)
            crossings += turn(low, high, p) > 0
    return crossings % 2 == 1


def distance(p, a, b):
    ax, ay, bx, by = p[0] - a[0], p[1] - a[1], b[0] - a[0], b[1] - a[1]
    t = min(1.0, max(0.0, (ax * bx + ay * by) / (bx * bx + by * by)))
    return math.hypot(ax - t * bx, ay - t * by)


def turn(a, b, c):
    """Twice the signed area of the triangle a b c."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def in_circle(a, b, c, p):
    """Positive if p is inside the circle through a, b, c (counter-clockwise)."""
    ax, ay, bx, by, cx, cy = (a[0] - p[0], a[1] - p[1], b[0] - p[0], b[1] - p[1],
                              c[0] - p[0], c[1] - p[1])
    return ((ax * ax + ay * ay) * (bx * cy - cx * by) - (bx * bx + by * by) * (ax * cy - cx * ay)
            + (cx * cx + cy * cy) * (ax * by - bx * ay))


def delaunay(points):
    """The Delaunay triangulation, by adding one point after the other from left to right.

    A triangle whose circumscribed circle lies left of the points to come is final, and is not
    looked at again: that keeps the work per point small.
    """
    far = 1000 * max(abs(x) for p in points for x in p)
    all_points = points + [(-3 * far, -2 * far), (3 * far, -2 * far), (0, 3 * far)]
    n = len(points)
    final, active = [], [((n, n + 1, n + 2), float("inf"))]
    for i in sorted(range(n), key=lambda k: points[k]):
        p, kept, cavity = points[i], [], {}
        for triangle, reach in active:
            if reach < p[0]:
                final.append(triangle)
            elif in_circle(*(all_points[v] for v in triangle), p) > 0:
                for k in range(3):
                    u, v = triangle[k], triangle[(k + 1) % 3]
                    if cavity.pop((v, u), None) is None:
                        cavity[(u, v)] = True
            else:
                kept.append((triangle, reach))
        for u, v in cavity:
            if turn(all_points[u], all_points[v], p) > 0:
                kept.append(((u, v, i), circle_reach(all_points[u], all_points[v], p)))
        active = kept
    triangles = final + [triangle for triangle, _ in active]
    return sorted(t for t in triangles if max(t) < n)


def circle_reach(a, b, c):
    """The largest x of the circle through a, b, c, with some room for rounding errors."""
    d = 2 * turn(a, b, c)
    bx, by, cx, cy = b[0] - a[0], b[1] - a[1], c[0] - a[0], c[1] - a[1]
    x = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d
    y = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d
    radius = math.hypot(x, y)
    return a[0] + x + radius + 1000 if radius < 1e9 else float("inf")


def inside(edges, points, triangles):
    """The triangles whose centres are inside the polygons."""
    tripled = [tuple((3 * x, 3 * y) for x, y in e) for e in edges]
    return [t for t in triangles
            if encloses(tripled, (sum(points[v][0] for v in t), sum(points[v][1] for v in t)))]


def centred(points, triangles, first):
    """The points from number `first` on, each moved to the middle of its neighbours."""
    neighbours = [set() for _ in points]
    for t in triangles:
        for k in range(3):
            neighbours[t[k]].update((t[(k + 1) % 3], t[(k + 2) % 3]))
    return [tuple(round(sum(points[v][axis] for v in near) / len(near)) for axis in (0, 1))
            for near in neighbours[first:]]


def check_border(loops, triangles):
    """Raises unless the edges that belong to one triangle are exactly the polygons' edges."""
    expected, first = set(), 0
    for loop in loops:
        ids = list(range(first, first + len(loop)))
        expected.update(frozenset(e) for e in zip(ids, ids[1:] + ids[:1]))
        first += len(loop)
    count = {}
    for t in triangles:
        for k in range(3):
            edge = frozenset((t[k], t[(k + 1) % 3]))
            count[edge] = count.get(edge, 0) + 1
    if {e for e, uses in count.items() if uses == 1} != expected:
        raise RuntimeError("an outline's edge is missing in the triangulation: refine the outline")

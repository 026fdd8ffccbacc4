# SPDX-License-Identifier: BSD-3-Clause
"""Awkward cages in 2D. A cage is (points, closed polylines); each is the same in every run."""

import math
import random


def ring(count, radius=1.0, middle=(0.0, 0.0), squeeze=1.0):
    """Points on an ellipse; its second half axis is `squeeze` times the first."""
    angles = [2 * math.pi * i / count for i in range(count)]
    return [(middle[0] + radius * math.cos(a), middle[1] + squeeze * radius * math.sin(a))
            for a in angles]


def loop(points):
    return points, [list(range(len(points)))]


def loops(*rings):
    """Several polylines; every other one runs the other way round."""
    points, lines = [], []
    for k, corners in enumerate(rings):
        line = [len(points) + i for i in range(len(corners))]
        points += corners
        lines.append(line[::-1] if k % 2 else line)
    return points, lines


def moved(cage, offset=0.0, scale=1.0):
    points, lines = cage
    return [(offset + scale * x, offset + scale * y) for x, y in points], lines


def rectangle(width, height, x=0.0, y=0.0):
    return [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]


def needle(width):
    return loop([(0.0, 0.0), (1.0, -width / 2), (1.0, width / 2), (0.5, width)])


def strip(height, count):
    """A rectangle whose long sides have `count` segments each."""
    steps = [i / count for i in range(count + 1)]
    return loop([(x, 0.0) for x in steps] + [(x, height) for x in reversed(steps)])


def star(spikes, inner):
    return loop([((1.0 if i % 2 else inner) * math.cos(math.pi * i / spikes),
                  (1.0 if i % 2 else inner) * math.sin(math.pi * i / spikes))
                 for i in range(2 * spikes)])


def comb(teeth, gap):
    """Teeth side by side, `gap` apart, on a common bar."""
    points = [(0.0, -0.2), (teeth + (teeth - 1) * gap, -0.2)]
    for i in reversed(range(teeth)):
        left = i * (1.0 + gap)
        points += [(left + 1.0, 0.0), (left + 1.0, 2.0), (left, 2.0), (left, 0.0)]
    # The bar's upper corners are the outer teeth's feet.
    return loop(points)


def spiral(count, turns, width):
    """A corridor rolled up: walls nearly touch turn by turn."""
    half = count // 2
    def arm(shift):
        return [((0.2 + shift + i / half) * math.cos(2 * math.pi * turns * i / half),
                 (0.2 + shift + i / half) * math.sin(2 * math.pi * turns * i / half))
                for i in range(half)]
    return loop(arm(width) + arm(0.0)[::-1])


def zigzag(count, height):
    return loop([(i / count, (i % 2) * 1.0) for i in range(count)]
                + [(i / count, (i % 2) * 1.0 + height) for i in reversed(range(count))])


def rough(count, seed):
    """A star-shaped polygon of random radii."""
    numbers = random.Random(seed)
    corners = [(2 * math.pi * (i + 0.8 * numbers.random()) / count, 0.5 + 0.5 * numbers.random())
               for i in range(count)]
    return loop([(radius * math.cos(angle), radius * math.sin(angle)) for angle, radius in corners])


def nested(gap, count=12):
    return loops(ring(count), ring(count, 1.0 - gap))


def cages():
    """Names, whether it has to be solved (True), refused (False) or either (None), and cages."""
    yield from ((f"needle_{w:g}", True if w > 1e-6 else None, needle(w))
                for w in (0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-12))
    yield from ((f"strip_{h:g}_{n}", True, strip(h, n))
                for h, n in ((0.1, 10), (1e-2, 10), (1e-2, 100), (1e-3, 40)))
    yield from ((f"strip_{h:g}_{n}", None, strip(h, n))
                for h, n in ((1e-4, 10), (1e-6, 4), (1e-9, 4), (1e-13, 2)))
    yield from ((f"star_{n}_{r:g}", True, star(n, r))
                for n, r in ((2, 0.1), (5, 0.1), (5, 0.01), (20, 0.3), (20, 1e-3), (100, 0.8),
                             (750, 0.95)))
    yield from ((f"comb_{n}_{g:g}", True if g > 1e-6 else None, comb(n, g))
                for n, g in ((3, 0.5), (3, 1e-2), (10, 1e-3), (40, 0.1), (3, 1e-6), (3, 1e-9),
                             (3, 0.0)))
    yield from ((f"spiral_{n}_{t}_{w:g}", True, spiral(n, t, w))
                for n, t, w in ((40, 1, 0.3), (200, 3, 0.1), (400, 5, 0.1), (200, 3, 0.01)))
    yield from ((f"zigzag_{n}_{h:g}", None, zigzag(n, h))
                for n, h in ((10, 0.5), (10, 0.05), (60, 0.1)))
    yield from ((f"rough_{n}", True, rough(n, n)) for n in (4, 7, 15, 60, 200, 800, 1500))
    yield from ((f"ellipse_{n}_{s:g}", True if s > 1e-5 else None, loop(ring(n, squeeze=s)))
                for n, s in ((4, 1.0), (300, 1.0), (1500, 1.0), (100, 0.01), (20, 1e-4),
                             (20, 1e-7)))
    yield from ((f"nested_{g:g}", True if g >= 1e-3 else None, nested(g))
                for g in (0.9, 0.1, 1e-2, 1e-3, 1e-5, 1e-8, 1e-12, 0.0))
    yield ("nested_four_deep", True,
           loops(ring(8), ring(8, 0.8), ring(8, 0.6), ring(8, 0.4)))
    yield "holes_many", True, loops(rectangle(10, 10), *[
        corners if k % 2 == 0 else corners[::-1]
        for k, corners in enumerate(rectangle(0.5, 0.5, 1 + 2 * (i % 4), 1 + 2 * (i // 4))
                                    for i in range(16))])
    square = rectangle(1.0, 1.0)
    yield "touch_at_a_corner", None, loops(square, rectangle(1.0, 1.0, 1.0, 1.0)[::-1])
    yield "touch_along_a_side", None, loops(square, rectangle(1.0, 1.0, 1.0, 0.0)[::-1])
    yield "touch_nearly", None, loops(square, rectangle(1.0, 1.0, 1.0 + 1e-9, 0.0)[::-1])
    yield "hole_touches_corner", False, loops(square, [(0.0, 0.0), (0.5, 0.2), (0.2, 0.5)])
    yield "hole_touches_side", False, loops(square, [(0.5, 0.0), (0.7, 0.5), (0.3, 0.5)])
    yield "hole_crosses", False, loops(square, rectangle(0.5, 0.5, 0.75, 0.25))
    yield "apart", True, loops(square, rectangle(1.0, 1.0, 3.0, 0.0)[::-1])
    yield "apart_far", None, loops(square, rectangle(1.0, 1.0, 1e9, 0.0)[::-1])
    yield "apart_uneven", None, loops(square, rectangle(1e-7, 1e-7, 3.0, 0.0)[::-1])
    yield "eight", False, loop([(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)])
    yield "waist", False, loop([(0.0, 0.0), (1.0, 0.0), (0.5, 0.5), (1.0, 1.0), (0.0, 1.0),
                                (0.5, 0.5)])
    yield "on_a_line", False, loop([(0.0, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, 3.0)])
    yield "on_one_point", False, loop([(1.0, 1.0)] * 4)
    yield "twice_a_point", False, loop([(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    yield "points_on_sides", True, loop([(0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 0.3),
                                         (1.0, 1.0), (0.1, 1.0), (0.0, 1.0)])
    yield from ((f"close_points_{d:g}", True if d > 1e-6 else None,
                 loop([(0.0, 0.0), (1.0, 0.0), (1.0, d), (1.0, 1.0), (0.0, 1.0)]))
                for d in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-17))
    yield from ((f"slit_{d:g}", None,
                 loop([(0.0, 0.0), (1.0, 0.0), (1.0, 0.5 - d), (0.5, 0.5), (1.0, 0.5 + d),
                       (1.0, 1.0), (0.0, 1.0)])) for d in (1e-3, 1e-7, 1e-12))
    hexagon = loop(ring(6))
    yield from ((f"far_{o:g}", True if o < 1e8 else None, moved(hexagon, offset=o))
                for o in (1e3, -1e6, 1e8, 1e12, 1e16, 1e200))
    yield from ((f"size_{s:g}", True if 1e-30 < s < 1e30 else None, moved(hexagon, scale=s))
                for s in (1e-6, 1e-20, 1e-100, 1e-160, 1e-310, 1e20, 1e100, 1e160, 1e308))
    yield "reverse", True, loop(ring(9)[::-1])
    yield "bent_thin", True, loop([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.99, 1.0), (0.99, 0.01),
                                   (0.0, 0.01)])
    yield "two_points", False, loop([(0.0, 0.0), (1.0, 0.0)])
    yield "loose_point", False, ([*rectangle(1.0, 1.0), (0.5, 0.5)], [[0, 1, 2, 3]])

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


def cages():
    """Names, whether it has to be solved (True), refused (False) or either (None), and cages."""
    yield "needle_0.01", True, needle(1e-2)
    yield "strip_0.001_40", True, strip(1e-3, 40)
    yield "star_5_0.01", True, star(5, 0.01)
    yield from ((f"comb_{n}_{g:g}", True if g > 0 else None, comb(n, g)) for n, g in ((10, 1e-3), (3, 0.0)))
    yield "spiral_200_3_0.01", True, spiral(200, 3, 0.01)
    yield "zigzag_10_0.05", None, zigzag(10, 0.05)
    yield "rough_60", True, rough(60, 60)
    yield "ellipse_20_0.0001", True, loop(ring(20, squeeze=1e-4))
    yield "nested_0.001", True, loops(ring(12), ring(12, 1 - 1e-3))
    yield "nested_four_deep", True, loops(ring(8), ring(8, 0.8), ring(8, 0.6), ring(8, 0.4))
    square = rectangle(1.0, 1.0)
    yield "hole_touches_side", False, loops(square, [(0.5, 0.0), (0.7, 0.5), (0.3, 0.5)])
    yield "apart_uneven", None, loops(square, rectangle(1e-7, 1e-7, 3.0, 0.0)[::-1])
    yield "close_points_1e-09", None, loop([(0.0, 0.0), (1.0, 0.0), (1.0, 1e-9), (1.0, 1.0), (0.0, 1.0)])
    yield "far_1e+12", None, moved(loop(ring(6)), offset=1e12)
    yield "size_1e-160", None, moved(loop(ring(6)), scale=1e-160)
    yield "eight", False, loop([(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)])

# SPDX-License-Identifier: BSD-3-Clause
"""The outline of a planar field as an evenly spaced closed polygon."""

from .fields import gradient, project
from .vectors import add, lerp, norm, scale, sub, unit


def trace(field, start, spacing):
    """Follows the zero set through the point next to `start`, with the shape on the left.

    Returns points `spacing` apart, or a little less so that the last gap is no exception.
    """
    step = spacing / 4
    first = p = project(field, start, 10)
    curve = [first]
    while len(curve) < 4 or norm(sub(p, first)) > 0.75 * step:
        if len(curve) > 100000:
            raise RuntimeError("the outline does not close")
        g = unit(gradient(field, p))
        p = project(field, add(p, scale(step, (-g[1], g[0]))), 2)
        curve.append(p)
    return [project(field, q) for q in resample(curve[:-1], spacing)]


def resample(loop, spacing):
    """Evenly spaced points on a closed polygon, at most `spacing` apart along it."""
    lengths = [norm(sub(b, a)) for a, b in zip(loop, loop[1:] + loop[:1])]
    count = int(sum(lengths) / spacing) + 1
    gap = sum(lengths) / count
    points, travelled, target = [], 0.0, 0.0
    for i, length in enumerate(lengths):
        while len(points) < count and target < travelled + length:
            t = (target - travelled) / length
            points.append(lerp(loop[i], loop[(i + 1) % len(loop)], t))
            target += gap
        travelled += length
    return points

# SPDX-License-Identifier: BSD-3-Clause
"""Shapes as fields: functions of a point, negative inside, roughly the distance to the surface.

Shapes that are joined as fields meet in smooth fillets, which no drawing by hand gives as easily.
"""

from .vectors import catmull_rom, dot, lerp, norm, scale, sub


def chain(nodes):
    """A bead chain whose thickness runs linearly from node to node; a node is (*point, radius).

    Far away the field is a mere lower bound, which is all that signs and fillets need, and cheap.
    """
    centre = lerp(nodes[0][:-1], nodes[-1][:-1], 0.5)
    reach = max(norm(sub(n[:-1], centre)) + n[-1] for n in nodes)
    pieces = []
    for a, b in zip(nodes, nodes[1:]):
        axis = sub(b[:-1], a[:-1])
        pieces.append((a[:-1], axis, 1.0 / dot(axis, axis), a[-1], b[-1] - a[-1]))

    def field(p):
        least = float("inf")
        bound = norm(sub(p, centre)) - reach
        if bound > 0.6:
            return bound
        for start, axis, inverse, radius, growth in pieces:
            offset = sub(p, start)
            t = min(1.0, max(0.0, dot(offset, axis) * inverse))
            least = min(least, norm(sub(offset, scale(t, axis))) - radius - t * growth)
        return least

    return field


def limb(nodes, steps=6):
    """A chain along the smooth curve through the nodes."""
    return chain(catmull_rom(nodes, steps))


def rounded_polygon(corners, radius):
    """A convex polygon, counter-clockwise, grown by `radius` with round corners."""
    edges = list(zip(corners, corners[1:] + corners[:1]))
    outline = chain([(*c, 0.0) for c in corners + corners[:1]])

    def field(p):
        inside = all((b[0] - a[0]) * (p[1] - a[1]) >= (b[1] - a[1]) * (p[0] - a[0])
                     for a, b in edges)
        return (-outline(p) if inside else outline(p)) - radius

    return field


def union(fields, fillet=0.0):
    """Joins shapes; within `fillet` of each other they flow into one another."""

    def field(p):
        value = fields[0](p)
        for other in fields[1:]:
            near = other(p)
            gap = abs(value - near)
            value = min(value, near)
            if gap < fillet:
                value -= (fillet - gap) ** 2 / (4 * fillet)
        return value

    return field


def gradient(field, p, step=1e-4):
    """The field's gradient by central differences."""
    slopes = []
    for i in range(len(p)):
        ahead, behind = list(p), list(p)
        ahead[i] += step
        behind[i] -= step
        slopes.append((field(tuple(ahead)) - field(tuple(behind))) / (2 * step))
    return tuple(slopes)


def project(field, p, rounds=3):
    """The point of the zero set near p, by Newton's method along the gradient."""
    for _ in range(rounds):
        g = gradient(field, p)
        p = sub(p, scale(field(p) / max(dot(g, g), 1e-12), g))
    return p

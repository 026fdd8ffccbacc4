#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the sample cages and models of this folder, the same bytes on every run.

usage: make_samples.py [OUTDIR]        (default: the folder of this script; takes about two minutes)
"""

import math
import pathlib
import sys

from sample_tools import fields, outline, surface_net, triangulation
from sample_tools.obj_file import write_obj
from sample_tools.quads import bridge, fan, split
from sample_tools.vectors import add, cross, dot, rotate, scale, sub, unit


def make_figure(folder):
    """A lizard seen from above, and the same cage with an arm raised and the tail swung."""
    cage = [
        (0.65, 5.1), (-0.5, 5.1), (-1.2, 3.65), (-1.1, 2.45),  # head
        (-1.6, 2.15), (-1.55, 3.3), (-2.6, 3.8), (-3.8, 3.05), (-3.9, 1.6), (-2.4, 0.75),  # arm
        (-1.15, 0.72), (-1.15, 0.05),  # left side
        (-2.3, 0.0), (-3.5, -1.15), (-3.25, -3.25), (-1.05, -3.1), (-1.05, -1.5),  # leg
        (-0.65, -3.1), (0.5, -4.6), (2.0, -5.05), (3.4, -4.4), (4.1, -3.2), (3.45, -2.7),
        (2.3, -3.55), (1.1, -2.75),  # tail
        (1.1, -1.5), (1.55, -2.6), (3.05, -2.6), (3.75, -1.6), (3.4, -0.35), (1.95, 0.2),  # leg
        (1.3, 0.2), (1.3, 0.8),  # right side
        (3.3, 0.75), (3.9, 2.05), (3.4, 3.2), (2.05, 3.42), (1.5, 2.25),  # arm
        (1.05, 2.5), (1.2, 3.65),  # head again
    ]
    trunk = [(0.1, 4.3, 0.42), (0, 3.55, 0.78), (-0.05, 2.7, 0.55), (0, 1.6, 0.75),
             (0.1, 0.2, 0.85), (0.05, -1.0, 0.7), (-0.05, -1.9, 0.46), (0.15, -2.9, 0.38),
             (0.8, -3.8, 0.32), (1.8, -4.25, 0.26), (2.8, -4.0, 0.19), (3.45, -3.3, 0.14)]
    limbs = [  # shoulder or hip, elbow or knee, wrist, and the direction in which the toes point
        ((-0.4, 1.7), (-1.8, 1.45), (-2.55, 2.25), 130),
        ((0.4, 1.6), (1.65, 1.55), (2.45, 2.0), 20),
        ((-0.35, -0.9), (-1.7, -0.75), (-2.1, -1.85), 235),
        ((0.35, -0.9), (1.65, -0.5), (2.35, -1.35), -40),
    ]
    parts = [fields.limb(trunk)]
    for root, joint, wrist, heading in limbs:
        foot = []
        for turn in (-75, -25, 25, 75):
            toe = rotate(add(wrist, (0.85, 0)), wrist, heading + turn)
            foot.append(fields.chain([(*wrist, 0.2), (*toe, 0.15)]))
        leg = fields.limb([(*root, 0.42), (*joint, 0.3), (*wrist, 0.25)])
        parts.append(fields.union([leg, *foot], fillet=0.12))
    shape = fields.union(parts, fillet=0.35)
    loop = outline.trace(shape, (0.1, 4.8), 0.105)
    points, triangles = triangulation.fill([loop], 0.145)

    pose = list(cage)
    hips, neck = (0.0, -1.9), (0.0, 2.6)
    for moved, centre, degrees in [
            ((33, 34, 35, 36), (0.7, 1.6), 22), ((32, 37), (0.7, 1.6), 8),  # an arm up
            ((4, 5, 6, 7, 8, 9), (-0.7, 1.6), 8),
            ((0, 1, 2, 39), neck, 14),
            ((13, 14, 15), (-0.6, -0.7), -12), ((12,), (-0.6, -0.7), -4),  # a leg out
            ((24,), hips, -10), ((18, 23), hips, -25), ((19, 20, 21, 22), hips, -40)]:  # the tail
        for i in moved:
            pose[i] = rotate(cage[i], centre, degrees)
    loop = [range(len(cage))]
    write_obj(folder / "2d/figure_cage.obj", "cage of a lizard", cage, loop)
    write_obj(folder / "2d/figure_cage_pose.obj", "figure_cage.obj in another pose", pose, loop)
    write_obj(folder / "2d/figure_model.obj", "a lizard", points, faces=triangles)


def make_letter(folder):
    """The letter S, in a cage with control points in the middle of straight sides."""
    half = [(0, -0.1), (3, -0.1), (5, -0.1), (6, 1.2), (6, 4.3), (5, 5.2), (3.7, 5.45),
            (2.4, 5.7), (1.95, 6.15), (1.95, 6.65), (2.35, 7.05), (6, 7.05)]
    cage = half + [(6 - x, 9 - y) for x, y in half]  # the other half is the same, turned round
    stroke = [(5.1, 7.95), (4.2, 8.12), (3.0, 8.15), (1.5, 7.7), (0.95, 6.3), (1.6, 4.95)]
    stroke = stroke + [(3, 4.5)] + [(6 - x, 9 - y) for x, y in reversed(stroke)]
    shape = fields.limb([(*p, 0.58) for p in stroke])
    loop = outline.trace(shape, (3, 0.3), 0.13)
    points, triangles = triangulation.fill([loop], 0.15)
    write_obj(folder / "2d/letter_cage.obj", "cage of a letter", cage, [range(len(cage))])
    write_obj(folder / "2d/letter_model.obj", "a letter", points, faces=triangles)


def make_ring(folder):
    """A finger ring with its stone: a cage of two loops, the second around the hole."""
    outer = [rotate((2.85, 0), (0, 0), 147.5 + 35 * k) for k in range(8)]
    outer += [(1.4, 2.4), (1.65, 3.15), (0.95, 4.1), (-0.95, 4.1), (-1.65, 3.15), (-1.4, 2.4)]
    inner = [rotate((1.3, 0), (0, 0), -45 * k) for k in range(8)]
    loops = [range(len(outer)), range(len(outer), len(outer) + len(inner))]
    band = fields.chain([(*rotate((2, 0), (0, 0), 5 * k), 0.33) for k in range(73)])
    stone = fields.rounded_polygon([(0, 2.1), (1.0, 3.1), (0.6, 3.6), (-0.6, 3.6), (-1.0, 3.1)],
                                   0.12)
    shape = fields.union([band, stone], fillet=0.2)
    outline_loops = [outline.trace(shape, (2.3, 0), 0.11), outline.trace(shape, (1.7, 0), 0.11)]
    points, triangles = triangulation.fill(outline_loops, 0.13)
    write_obj(folder / "2d/ring_cage.obj", "cage of a finger ring", outer + inner, loops)
    write_obj(folder / "2d/ring_model.obj", "a finger ring", points, faces=triangles)


ELBOW = (2.7, 0, 0)
WRIST = 2.3  # along the forearm


def forearm(along, side, out=0.0):
    """A point given in the forearm's frame: from the elbow, towards the thumb, out of the plane."""
    return rotate((ELBOW[0] + along, side, out), ELBOW, 40)


def limb_cage():
    """Rings of six control points along an arm, a box for the thumb, a point for each end.

    Returns points, triangles, and the numbers of the points by ring; the thumb's come last with
    those of the finger tips.
    """
    upward, sideways = (0, 1, 0), sub(forearm(0, 1), ELBOW)
    rings = [  # centre, direction of the half width, half width, half thickness
        ((-0.85, 0, 0), upward, 0.85, 0.95),
        ((1.2, 0, 0), upward, 0.9, 1.0),
        (ELBOW, rotate(upward, (0, 0), 20), 0.85, 0.88),
        (forearm(1.1, 0), sideways, 0.8, 0.85),
        (forearm(1.8, 0), sideways, 0.66, 0.68),
        (forearm(2.3, 0), sideways, 0.92, 0.66),
        (forearm(3.35, 0), sideways, 1.02, 0.66),
        (forearm(4.55, 0), sideways, 1.12, 0.58),
    ]
    cage, numbers = [], []
    for centre, side, width, thickness in rings:
        numbers.append(list(range(len(cage), len(cage) + 6)))
        for w, t in [(1, -0.7), (1, 0.7), (0, 1), (-1, 0.7), (-1, -0.7), (0, -1)]:
            cage.append(add(add(centre, scale(w * width, side)), (0, 0, t * thickness)))
    quads = [q for a, b in zip(numbers, numbers[1:]) for q in bridge(a, b)]

    thumb = list(range(len(cage), len(cage) + 4))
    cage += [forearm(along, 1.66, out)
             for along, out in [(2.38, -0.46), (2.38, 0.46), (3.44, 0.46), (3.44, -0.46)]]
    root = (numbers[5][0], numbers[5][1], numbers[6][1], numbers[6][0])
    quads.remove(root)
    quads += bridge(root, thumb) + [tuple(thumb)]

    shoulder, tip = len(cage), len(cage) + 1
    cage += [(-1.0, 0, 0), forearm(4.65, 0)]
    ends = fan(numbers[0][::-1], shoulder) + fan(numbers[-1], tip)
    numbers[-1] += [*thumb, tip]
    return cage, split(cage, quads) + ends, numbers


def limb_shape():
    arm = fields.limb([(-0.05, 0, 0, 0.5), (0.6, 0.03, 0, 0.58), (1.4, 0.05, 0, 0.55),
                       (2.606, -0.053, 0, 0.42), (*forearm(0.7, 0), 0.46),
                       (*forearm(1.5, 0), 0.36), (*forearm(WRIST, 0), 0.27)])
    hand = [fields.chain([(*forearm(WRIST, 0), 0.26), (*forearm(3.1, side), 0.25),
                          (*forearm(tip, 1.6 * side), 0.18)])
            for side, tip in [(-0.4, 3.9), (0, 4.1), (0.4, 3.95)]]
    hand.append(fields.chain([(*forearm(2.5, 0.15), 0.25), (*forearm(2.75, 0.8), 0.2),
                              (*forearm(2.98, 1.22), 0.18)]))
    return fields.union([arm, fields.union(hand, fillet=0.15)], fillet=0.2)


def make_limb(folder):
    """An arm with a hand, and the same cage with the elbow and the wrist bent further."""
    cage, faces, rings = limb_cage()
    pose = list(cage)
    for number, ring in enumerate(rings):
        for i in ring:
            if number >= 5:
                pose[i] = rotate(pose[i], forearm(WRIST, 0), 20)
            if number >= 2:
                pose[i] = rotate(pose[i], ELBOW, 50 if number > 2 else 25)
    points, triangles = surface_net.polygonise(limb_shape(), (-0.75, -0.75, -0.7),
                                               (6.7, 4.0, 0.7), 0.1)
    write_obj(folder / "3d/limb_cage.obj", "cage of an arm with a hand", cage, faces=faces)
    write_obj(folder / "3d/limb_cage_pose.obj", "limb_cage.obj in another pose", pose, faces=faces)
    write_obj(folder / "3d/limb_model.obj", "an arm with a hand", points, faces=triangles)


def make_character(folder):
    """A little person with long ears, arms held out, in colors. Its cage is to be made."""

    def both(*nodes):
        """A limb and its mirror image."""
        return [fields.limb([(side * x, *rest) for x, *rest in nodes]) for side in (1, -1)]

    head = [fields.chain([(0, 3.55, 0, 0.72), (0, 3.62, 0.08, 0.7)]),
            *both((0.3, 4.1, 0, 0.16), (0.42, 4.75, -0.02, 0.2), (0.5, 5.2, -0.05, 0.12))]
    hands = both((1.9, 2.42, 0, 0.2), (2.12, 2.42, 0, 0.24), (2.35, 2.42, 0, 0.17))
    shirt = [fields.limb([(0, 1.75, 0, 0.5), (0, 2.0, 0.02, 0.53), (0, 2.5, 0, 0.46)]),
             *both((0.3, 2.5, 0, 0.3), (0.8, 2.45, 0, 0.25), (1.25, 2.42, -0.02, 0.22),
                   (1.9, 2.42, 0, 0.19))]
    trousers = both((0, 1.4, 0, 0.5), (0.3, 1.25, 0, 0.37), (0.36, 0.85, 0.03, 0.3), (0.38, 0.2, 0, 0.24))
    shoes = both((0.38, -0.02, -0.02, 0.25), (0.4, -0.05, 0.2, 0.26), (0.42, -0.08, 0.42, 0.22))
    parts = {(0.95, 0.78, 0.6): head + hands, (0.85, 0.3, 0.25): shirt,
             (0.25, 0.4, 0.7): trousers, (0.35, 0.22, 0.16): shoes}
    shape = fields.union([field for some in parts.values() for field in some], fillet=0.12)
    points, triangles = surface_net.polygonise(shape, (-2.66, -0.46, -0.87), (2.66, 5.42, 0.97),
                                               0.11)
    colors = [min(parts, key=lambda color: min(field(p) for field in parts[color])) for p in points]
    eyes = [(side * 0.26, 3.72, 0.75) for side in (1, -1)]
    for v, p in enumerate(points):
        if any(dot(sub(p, eye), sub(p, eye)) < 0.13 ** 2 for eye in eyes):
            colors[v] = (0.1, 0.1, 0.12)
    write_obj(folder / "3d/character_model.obj", "a little person",
              [(*p, *color) for p, color in zip(points, colors)], faces=triangles)


def make_star(folder):
    """A star with twelve blunt arms, and a cage whose valleys are the corners of a dodecahedron."""
    golden = (1 + math.sqrt(5)) / 2
    arms = [cyclic for a in (-1, 1) for b in (-golden, golden)
            for cyclic in ((a, 0, b), (0, b, a), (b, a, 0))]
    arms = [unit(arm) for arm in arms]
    valleys = [unit((a, b, c)) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    valleys += [unit(cyclic) for a in (-1 / golden, 1 / golden) for b in (-golden, golden)
                for cyclic in ((0, a, b), (a, b, 0), (b, 0, a))]
    cage, quads, faces = [scale(0.97, v) for v in valleys], [], []
    for arm in arms:
        base = sort_around(arm, [v for v in range(20) if dot(valleys[v], arm) > 0.5], valleys)
        end = list(range(len(cage), len(cage) + 5))
        for v in base:
            outward = unit(sub(valleys[v], scale(dot(valleys[v], arm), arm)))
            cage.append(add(scale(1.55, arm), scale(0.4, outward)))
        quads += bridge(base, end)
        faces += fan(end, len(cage))
        cage.append(scale(1.65, arm))
    parts = [fields.chain([(0, 0, 0, 0.45), (*scale(1.3, arm), 0.18)]) for arm in arms]
    shape = fields.union(parts, fillet=0.2)
    box = 1.543, 1.543, 1.543
    points, triangles = surface_net.polygonise(shape, scale(-1, box), box, 0.09)
    write_obj(folder / "3d/star_cage.obj", "cage of a star", cage, faces=faces + split(cage, quads))
    write_obj(folder / "3d/star_model.obj", "a star", points, faces=triangles)


def sort_around(axis, ring, points):
    """The ring's vertices in counter-clockwise order for a viewer at the tip of the axis."""
    u = unit(sub(points[ring[0]], scale(dot(points[ring[0]], axis), axis)))
    v = cross(axis, u)

    def angle(i):
        return math.atan2(dot(points[i], v), dot(points[i], u))

    # The shift keeps the first vertex first even if rounding puts its angle just below zero.
    return sorted(ring, key=lambda i: (angle(i) + 0.1) % (2 * math.pi))


def make_torus(folder):
    """A twisted pastry ring: a cage and a model of genus 1."""

    def swept(around, across, section):
        """Vertices and quadrilaterals of a profile (distance from the axis, height) swept round."""
        points, numbers = [], []
        for i in range(around):
            numbers.append(range(len(points), len(points) + across))
            for k in range(across):
                distance, height = section(i, k)
                points.append(rotate((distance, 0, height), (0, 0), 360 * i / around))
        return points, [q for a, b in zip(numbers, numbers[1:] + numbers[:1])
                        for q in bridge(a, b)]

    def cage_section(_, k):
        return [(3.2, -0.5), (2.1, -1.08), (1.1, -0.5), (1.1, 0.5), (2.1, 1.08), (3.2, 0.5)][k]

    def model_section(i, k):
        angle = -2 * math.pi * k / 32
        radius = 0.55 + 0.09 * math.cos(4 * angle + 2 * math.pi * 7 * i / 88)
        return 2 + radius * math.cos(angle), radius * math.sin(angle)

    cage, quads = swept(8, 6, cage_section)
    write_obj(folder / "3d/torus_cage.obj", "cage of a pastry ring", cage, faces=split(cage, quads))
    points, quads = swept(88, 32, model_section)
    write_obj(folder / "3d/torus_model.obj", "a pastry ring", points, faces=split(points, quads))


def make_knot(folder):
    """A trefoil knot in a cage of 300 control points, of which few matter anywhere."""

    def centre(t):
        return scale(1.35, (math.sin(t) + 2 * math.sin(2 * t), math.cos(t) - 2 * math.cos(2 * t),
                            -1.2 * math.sin(3 * t)))

    def frame(t):
        """Two unit vectors across the curve. It is never vertical."""
        along = unit((math.cos(t) + 4 * math.cos(2 * t), -math.sin(t) + 4 * math.sin(2 * t),
                      -3.6 * math.cos(3 * t)))
        upward = unit(sub((0, 0, 1), scale(along[2], along)))
        return upward, cross(along, upward)

    def swept(around, across, radius):
        points, rings = [], []
        for i in range(around):
            t = 2 * math.pi * i / around
            up, side = frame(t)
            rings.append(range(len(points), len(points) + across))
            for k in range(across):
                angle = 2 * math.pi * k / across
                points.append(add(centre(t), add(scale(radius * math.cos(angle), up),
                                                 scale(radius * math.sin(angle), side))))
        quads = [q for a, b in zip(rings, rings[1:] + rings[:1]) for q in bridge(a, b)]
        return points, split(points, quads)

    points, faces = swept(50, 6, 0.9)
    write_obj(folder / "3d/knot_cage.obj", "cage of a trefoil knot", points, faces=faces)
    points, faces = swept(160, 16, 0.36)
    write_obj(folder / "3d/knot_model.obj", "a trefoil knot", points, faces=faces)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    for make in (make_figure, make_letter, make_ring, make_limb, make_character, make_star,
                 make_torus, make_knot):
        make(folder)


if __name__ == "__main__":
    main()

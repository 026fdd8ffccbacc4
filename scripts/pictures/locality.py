#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""locality.py PICTURE WORK: the same drag of a hand under harmonic and local coordinates, animated.

Writes frames and joins them by gifsicle.
"""

import pathlib
import subprocess
import sys

import numpy as np

import common
from common import INK, MESHES, flbc, write

CAGE, MODEL = (MESHES / "2d" / f"figure_{what}.obj" for what in ("cage", "model"))
HAND = [33, 34, 35, 36]  # control points
DRAG = np.array([0.9, 1.5, 0])
TURN = np.radians(25)  # of the hand on the way
SHOWN = 0.01  # displacement, relative to the drag, from which a part of the model is orange
POSES, DELAY = 24, 9  # there and back again; hundredths of a second
METHODS = [("Harmonic", "harmonic"), ("Local", "weights")]
SIZE, SCALE, FINER = (900, 450), 35, 3
BODY, MOVED, HELD, EDGE = (222, 217, 209), (240, 128, 24), (230, 18, 26), (92, 88, 84)
GHOST = (170, 174, 180)


def pose(corners, part):
    """The cage with its hand dragged so far."""
    moved, hand = corners.copy(), corners[HAND]
    angle, middle = TURN * part, hand.mean(0)
    turn = np.array([[np.cos(angle), np.sin(angle), 0], [-np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    moved[HAND] = middle + (hand - middle) @ turn + part * DRAG
    return moved


def deform(work):
    """Places of the cage, and those of the model by each method, in all poses."""
    work.mkdir(parents=True, exist_ok=True)
    corners, _ = common.read_obj(CAGE)
    parts = (1 - np.cos(np.pi * np.linspace(0, 1, POSES))) / 2
    cages = [pose(corners, part) for part in parts]
    for k, moved in enumerate(cages):
        common.write_moved(CAGE, moved, work / f"cage_{k}.obj")
    models = []
    for _, method in METHODS:
        flbc("solve", CAGE, "--model", MODEL, "--method", method, "--vertices", 8000, "-q",
             "-o", work / f"{method}.npy")
        flbc("deform", MODEL, "--weights", work / f"{method}.npy", "--pose", work / "cage_%d.obj",
             "-q", "-o", work / f"{method}_%d.obj")
        models.append([common.read_obj(work / f"{method}_{k}.obj")[0] for k in range(POSES)])
    return cages, models


def above(corners, values, level):
    """The part of a polygon where a linear function is above the level."""
    part = []
    ends = zip(corners, corners[1:] + corners[:1], values, [*values[1:], values[0]])
    for p, q, u, v in ends:
        if u > level:
            part.append(p)
        if (u > level) != (v > level):
            part.append(tuple(np.array(p) + (level - u) / (v - u) * (np.array(q) - p)))
    return part


def paint(draw, middle, cage, rest, points, polygons, shares):
    def pixels(places):
        x = middle + SCALE * (places[:, 0] - 0.1)
        y = SIZE[1] / 2 + 20 - SCALE * (places[:, 1] - 0.45)
        return [tuple(FINER * np.array(p)) for p in zip(x, y)]
    at, before, corners = pixels(points), pixels(rest), pixels(cage)
    edges = {}
    for polygon in polygons:
        for a, b in zip(polygon, polygon[1:] + polygon[:1]):
            edges[min(a, b), max(a, b)] = (min(a, b), max(a, b)) not in edges
    outline = [edge for edge, is_border in edges.items() if is_border]
    for a, b in outline:
        draw.line((before[a], before[b]), fill=GHOST, width=FINER)
    for polygon in polygons:
        draw.polygon([at[k] for k in polygon], fill=BODY, outline=BODY)
    for polygon in polygons:
        part = above([at[k] for k in polygon], shares[polygon], SHOWN)
        if len(part) > 2:
            draw.polygon(part, fill=MOVED, outline=MOVED)
    for a, b in outline:
        draw.line((at[a], at[b]), fill=EDGE, width=round(1.4 * FINER))
    draw.line(corners + corners[:1], fill=INK, width=round(1.4 * FINER))
    for k, (x, y) in enumerate(corners):
        radius = FINER * (5 if k in HAND else 3)
        draw.ellipse((x - radius, y - radius, x + radius, y + radius), fill=HELD if k in HAND else INK)


def frames(work):
    cages, models = deform(work)
    rest, polygons = common.read_obj(MODEL)
    drag = np.linalg.norm(DRAG)
    shares = [np.max([np.linalg.norm(points - rest, axis=1) for points in places], 0) / drag
              for places in models]
    for k in range(POSES):
        page, draw = common.page(*(FINER * x for x in SIZE))
        for column, places in enumerate(models):
            paint(draw, 225 + 450 * column, cages[k], rest, places[k], polygons, shares[column])
        page = page.resize(SIZE, common.Image.Resampling.LANCZOS)
        draw = common.ImageDraw.Draw(page)
        draw.line((450, 20, 450, 430), fill=(222, 224, 228))
        for column, (title, _) in enumerate(METHODS):
            left = 24 + 450 * column
            write(draw, (left, 34), title, 28, weight="Bold", anchor="ls")
            part = 100 * (shares[column] > SHOWN).mean()
            write(draw, (left, 58), f"{part:.0f}% of the model moves by more than {100 * SHOWN:g}% of the drag",
                  17, anchor="ls")
        yield page


def palette():
    """All colors, and mixtures of two where one meets the other."""
    colors = np.array([(255, 255, 255), BODY, MOVED, HELD, EDGE, INK, GHOST])
    mixtures = [a + t * (b - a) for k, a in enumerate(colors) for b in colors[:k]
                for t in np.linspace(0, 1, 5)]
    picture = common.Image.new("P", (1, 1))
    picture.putpalette(np.round(mixtures).astype(int).flatten().tolist())
    return picture


def main(path, work):
    for k, page in enumerate(frames(work)):
        page.quantize(palette=palette(), dither=common.Image.Dither.NONE).save(work / f"{k}.gif")
    order = [*range(POSES), *range(POSES - 2, 0, -1)]
    subprocess.run(["gifsicle", "-O3", "--loopcount=forever", f"--delay={DELAY}", "-o", path,
                    *(work / f"{k}.gif" for k in order)], check=True)


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:3]))

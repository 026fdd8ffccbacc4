#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""ring.py PICTURE WORK: the same turn of a thumb in 3D under harmonic and local coordinates, animated."""

import pathlib
import sys

import numpy as np

import common
from common import GRAY, INK, MESHES, flbc, write

CAGE, MODEL = (MESHES / "3d" / f"limb_{what}.obj" for what in ("cage", "model"))
THUMB = [48, 49, 50, 51]  # the ring of control points around its tip
BASE = [30, 31, 36, 37]  # the ring that stays, about which the thumb turns
TURN = np.radians(40)
SHOWN = 0.01  # displacement, relative to the largest of a control point, from which a part is orange
POSES, DELAY, PAUSE = 22, 80, 700  # there and back again; milliseconds of a frame, and at both ends
METHODS = [("Harmonic coordinates", "harmonic"), ("Local coordinates", "weights")]
SIZE, SCALE, FINER = (900, 400), 84, 2
BODY, MOVED, HELD = np.array((214, 190, 168)), np.array((240, 128, 24)), (214, 16, 28)
LIGHT = np.array((-0.35, 0.55, 0.76))
COLORS = 96


def rotation(axis, angle):
    cos, sin, (a, b) = np.cos(angle), np.sin(angle), [d for d in range(3) if d != axis]
    matrix = np.eye(3)
    matrix[a, a] = matrix[b, b] = cos
    matrix[a, b], matrix[b, a] = -sin, sin
    return matrix


VIEW = rotation(0, np.radians(18)) @ rotation(1, np.radians(-14))


def pose(corners, part):
    moved, center = corners.copy(), corners[BASE].mean(0)
    moved[THUMB] = center + (corners[THUMB] - center) @ rotation(2, TURN * part).T
    return moved


def deform(work):
    """The cage in all poses, and the model in them by each method."""
    work.mkdir(parents=True, exist_ok=True)
    corners, _ = common.read_obj(CAGE)
    cages = [pose(corners, (1 - np.cos(np.pi * t)) / 2) for t in np.linspace(0, 1, POSES)]
    for k, moved in enumerate(cages):
        common.write_moved(CAGE, moved, work / f"cage_{k}.obj")
    models = []
    for _, method in METHODS:
        flbc("solve", CAGE, "--model", MODEL, "--method", method, "-q", "-o", work / f"{method}.npy")
        flbc("deform", MODEL, "--weights", work / f"{method}.npy", "--pose", work / "cage_%d.obj",
             "-q", "-o", work / f"{method}_%d.obj")
        models.append([common.read_obj(work / f"{method}_{k}.obj")[0] for k in range(POSES)])
    return cages, models


def pixels(places):
    x, y = (places @ VIEW.T)[:, :2].T
    return np.stack([215 + SCALE * (x - 4.4), SIZE[1] - 175 - SCALE * (y - 1.9)], axis=1) * FINER


def paint(draw, cage, facets, points, triangles, moves):
    """The triangles from back to front, then the cage."""
    seen = points @ VIEW.T
    corners = seen[triangles]
    flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    smooth = np.zeros_like(points)
    for corner in range(3):
        np.add.at(smooth, triangles[:, corner], flat)
    normals = smooth[triangles].sum(1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    shade = np.round(0.5 + 0.5 * np.clip(normals @ LIGHT, 0, 1), 2)
    colors = np.where(moves[triangles].mean(1)[:, None] > 0.5, MOVED, BODY) * shade[:, None]
    at = pixels(points)
    for k in np.argsort(corners[:, :, 2].mean(1)):
        if flat[k, 2] > 0:
            color = tuple(colors[k].astype(int))
            draw.polygon([tuple(at[v]) for v in triangles[k]], fill=color, outline=color)
    places = pixels(cage)
    for a, b in {tuple(sorted(edge)) for f in facets for edge in zip(f, f[1:] + f[:1])}:
        draw.line((*places[a], *places[b]), fill=GRAY, width=FINER // 2)
    for k, (x, y) in enumerate(places):
        radius = FINER * (4 if k in THUMB else 2.5)
        draw.ellipse((x - radius, y - radius, x + radius, y + radius), fill=HELD if k in THUMB else INK)


def frames(work):
    cages, models = deform(work)
    rest, triangles = common.read_obj(MODEL)
    triangles = np.array(triangles)
    facets = common.read_obj(CAGE)[1]
    far = np.linalg.norm(cages[-1] - cages[0], axis=1).max()
    moves = [np.linalg.norm(places[-1] - rest, axis=1) / far > SHOWN for places in models]
    for k in range(POSES):
        page, draw = common.page(*SIZE)
        for column, places in enumerate(models):
            half, brush = common.page(FINER * SIZE[0] // 2, FINER * SIZE[1])
            paint(brush, cages[k], facets, places[k], triangles, moves[column])
            page.paste(half.resize((SIZE[0] // 2, SIZE[1]), common.Image.Resampling.LANCZOS), (450 * column, 0))
        draw.line((450, 20, 450, SIZE[1] - 20), fill=(222, 224, 228))
        for column, (title, _) in enumerate(METHODS):
            write(draw, (24 + 450 * column, 34), title, 24, weight="Bold", anchor="ls")
            write(draw, (24 + 450 * column, 58), f"{100 * moves[column].mean():.0f}% of the vertices move", 17,
                  anchor="ls")
        yield page


def main(path, work):
    pages = list(frames(work))
    swatch = pages[-1].copy()  # colors of few pixels that must be in the palette
    for k, color in enumerate((HELD, (255, 255, 255), INK)):
        swatch.paste(color, (k * 100, 300, k * 100 + 100, 400))
    palette = swatch.quantize(COLORS, dither=common.Image.Dither.NONE)
    pages = [page.quantize(palette=palette, dither=common.Image.Dither.NONE) for page in pages]
    pages += pages[-2:0:-1]
    times = [DELAY] * len(pages)
    times[0] = times[POSES - 1] = PAUSE
    pages[0].save(path, save_all=True, append_images=pages[1:], duration=times, loop=0, optimize=False)
    pages[POSES - 1].save(path.with_suffix(".png"), optimize=True)


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:3]))

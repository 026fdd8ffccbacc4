#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""automatic_cages.py PICTURE WORK MODELS: models in cages that flbc makes, and one pose of each."""

import pathlib
import sys

import numpy as np

import common
from common import flbc, write

CONTROL_POINTS = 80
CELL, HEIGHT, LEFT, TOP = 400, 360, 60, 60


def ramp(values, start, end):
    """From 0 at the start to 1 at the end, smoothly."""
    t = np.clip((values - start) / (end - start), 0, 1)
    return t * t * (3 - 2 * t)


def turn(points, u, part, degrees, axis, pivot):
    """The points turned about an axis through a place in the bounding box, each by its part."""
    low, size = points.min(0), np.ptp(points, axis=0)
    angle = np.radians(degrees) * part
    a, b = (axis + 1) % 3, (axis + 2) % 3
    moved, center = points.copy(), low + size * pivot
    x, y = points[:, a] - center[a], points[:, b] - center[b]
    moved[:, a] = center[a] + np.cos(angle) * x - np.sin(angle) * y
    moved[:, b] = center[b] + np.sin(angle) * x + np.cos(angle) * y
    return moved


# Poses of control points; u: places in the bounding box of the cage, from 0 to 1.
def lower_head(points, u):
    return turn(points, u, ramp(u[:, 0] + u[:, 1], 1.3, 1.6), -45, 2, (0.7, 0.65, 0.5))


def raise_arm(points, u):
    part = ramp(-u[:, 0], -0.36, -0.22) * ramp(u[:, 1], 0.5, 0.6)
    return turn(points, u, part, -40, 2, (0.36, 0.72, 0.5))


def swing_arm(points, u):
    part = ramp(-u[:, 0], -0.4, -0.22) * ramp(u[:, 1], 0.42, 0.5)
    return turn(points, u, part, -55, 2, (0.4, 0.75, 0.5))


def bend_tail(points, u):
    return turn(points, u, ramp(u[:, 0], 0.3, 1.1), 60, 1, (0.35, 0.5, 0.5))


# File, title, axes that become right, up and toward the eye, with signs; view from the front; pose.
CASES = [("horse", "Horse", ("+y", "+z", "+x"), "-65,12", lower_head),
         ("armadillo", "Armadillo", ("-x", "+y", "-z"), "20,10", raise_arm),
         ("beast", "Beast", ("+x", "+y", "+z"), "15,8", swing_arm),
         ("shark", "Shark", ("+x", "+z", "-y"), "35,25", bend_tail)]


def turned(points, axes):
    return np.stack([(1 if axis[0] == "+" else -1) * points[:, "xyz".index(axis[1])] for axis in axes], 1)


def draw(model, weights, cage, view, picture):
    flbc("draw", model, "--weights", weights, "--cage", cage, "--color", "plain", "--view", view,
         "--width", CELL - 10, "-o", picture)
    return common.Image.open(picture).convert("RGB")


def pictures(case, work, models):
    """The model in its cage, in the pose, and the number of control points."""
    name, _, axes, view, pose = case
    folder = work / name
    folder.mkdir(parents=True, exist_ok=True)
    model, cage, weights = folder / "model.obj", folder / "cage.obj", folder / "weights.npy"
    source = models / "3d" / f"{name}.obj"
    common.write_moved(source, turned(common.read_obj(source)[0], axes), model)
    flbc("cage", model, "-o", cage, "--control-points", CONTROL_POINTS)
    flbc("solve", cage, "--model", model, "--vertices", 10000, "-q", "-o", weights)
    points, _ = common.read_obj(cage)
    moved = pose(points, (points - points.min(0)) / np.ptp(points, axis=0))
    common.write_moved(cage, moved, folder / "pose.obj")
    common.write_moved(model, np.load(weights) @ moved, folder / "posed.obj")
    yield draw(model, weights, cage, view, folder / "rest.png")
    yield draw(folder / "posed.obj", weights, folder / "pose.obj", view, folder / "pose.png")


def main(path, work, models):
    page, paint = common.page(LEFT + CELL * len(CASES), TOP + 2 * HEIGHT)
    for k, case in enumerate(CASES):
        write(paint, (LEFT + CELL * (k + 0.5), 32), case[1], 28, weight="Bold")
        for row, picture in enumerate(pictures(case, work, models)):
            if picture.height > HEIGHT:
                picture = picture.resize((round(picture.width * HEIGHT / picture.height), HEIGHT),
                                         common.Image.Resampling.LANCZOS)
            page.paste(picture, (round(LEFT + CELL * (k + 0.5) - picture.width / 2),
                                 round(TOP + HEIGHT * (row + 0.5) - picture.height / 2)))
    for row, label in enumerate(("Automatic cage", "Pose")):
        text, pen = common.page(HEIGHT, 40)
        write(pen, (HEIGHT / 2, 20), label, 24)
        page.paste(text.rotate(90, expand=True), (10, TOP + HEIGHT * row))
    common.save(page, path, colors=200)


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:4]))

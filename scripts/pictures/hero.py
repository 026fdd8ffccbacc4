#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""hero.py PICTURE WORK: one control point of the lizard under three kinds of coordinates."""

import pathlib
import sys

import numpy as np

import common
from common import INK, MESHES, flbc, write

CAGE = MESHES / "2d" / "figure_cage.obj"
CONTROL_POINT = 32
THRESHOLD = 1e-4  # of an influence, as flbc check counts them
METHODS = [("Harmonic", "harmonic"), ("Mean value", "meanvalue"), ("Local", "weights")]
SIZE, PANEL, TOP = (1800, 700), 500, 46
LEFT = (18, 548, 1078)  # of the panels
UNIT = PANEL / 1200  # of a pixel of flbc draw's usual width; the next three are of its layout
MARGIN, BAR_LEFT, BAR_RIGHT = 44 * UNIT, PANEL - 130 * UNIT, PANEL - 104 * UNIT


def solve(work):
    """Per method: weights, findings, and the picture of the function."""
    domain = work / "domain.obj"
    flbc("solve", CAGE, "-q", "--save-domain", domain, "-o", work / "weights.npy")
    for _, method in METHODS:
        weights = work / f"{method}.npy"
        if method != "weights":
            flbc("solve", CAGE, "--domain", domain, "--method", method, "-q", "-o", weights)
        picture = work / f"{method}.png"
        flbc("draw", domain, "--weights", weights, "--cage", CAGE, "--control-point", CONTROL_POINT,
             "--width", PANEL, "-o", picture)
        yield (np.load(weights)[:, CONTROL_POINT],
               common.check(CAGE, "--domain", domain, "--weights", weights)["weights"],
               common.Image.open(picture).convert("RGB"))


def pixel_of(place, picture):
    """Where flbc draw puts a place in the plane."""
    corners, _ = common.read_obj(CAGE)
    low, high = corners[:, :2].min(0), corners[:, :2].max(0)
    width, height = PANEL - 218 * UNIT, picture.height - 2 * MARGIN
    scale = min(width / (high - low)[0], height / (high - low)[1])
    x, y = scale * (np.array(place) - (low + high) / 2)
    return np.array([MARGIN + width / 2 + x, MARGIN + height / 2 - y])


def paint_legend(page, draw, picture):
    """The color bar of a picture that has negative weights."""
    height = min(picture.height - 240 * UNIT, 620 * UNIT)
    top = (picture.height - height) / 2 + 16 * UNIT
    left, bar_top, bar_height = 1612, 176, 300
    box = [round(x) for x in (BAR_LEFT + 2, top + 1, BAR_RIGHT - 2, top + height - 1)]
    patch = [round(x) for x in (BAR_LEFT + 2, top + height + 12 * UNIT, BAR_RIGHT - 2,
                                top + height + 32 * UNIT)]
    page.paste(picture.crop(box).resize((34, bar_height)), (left, bar_top))
    page.paste(picture.crop(patch).resize((34, 34)), (left, bar_top + bar_height + 14))
    draw.rectangle((left, bar_top, left + 34, bar_top + bar_height), outline=INK)
    draw.rectangle((left, bar_top + bar_height + 14, left + 34, bar_top + bar_height + 48), outline=INK)
    for text, y in (("1", 0), ("0.5", bar_height / 2), ("0", bar_height), ("negative", bar_height + 31)):
        write(draw, (left + 46, bar_top + y), text, 20, anchor="lm")
    write(draw, (left, bar_top - 30), "weight of", 20, anchor="ls")
    draw.ellipse((left + 94, bar_top - 45, left + 112, bar_top - 27), fill=(230, 18, 26))


def main(path, work):
    work.mkdir(parents=True, exist_ok=True)
    page, draw = common.page(*SIZE)
    for (title, method), left, (weights, found, picture) in zip(METHODS, LEFT, solve(work)):
        middle = left + MARGIN + (PANEL - 218 * UNIT) / 2
        page.paste(picture.crop((0, 0, round(PANEL - 150 * UNIT), picture.height)), (left, TOP))
        write(draw, (middle, 34), title, 34, weight="Bold")
        smallest = f"{found['min_weight']:.3f}".replace("-", "\u2212") if found["min_weight"] else "0"
        reach = 100 * (abs(weights) > THRESHOLD).mean()
        bottom = TOP + picture.height + 8
        write(draw, (middle, bottom), f"{found['mean_influences']:.1f} influences per vertex", 27,
              weight="Bold")
        write(draw, (middle, bottom + 34), f"smallest weight of the cage: {smallest}", 21)
        write(draw, (middle, bottom + 62), f"this control point reaches {reach:.0f}% of the vertices", 21)
        if method == "meanvalue":
            paint_legend(page, draw, picture)
        if method == "weights":
            points, _ = common.read_obj(work / "domain.obj")
            inside = points[weights > THRESHOLD][:, :2]
            end = pixel_of(inside[(inside @ [-0.5, -1]).argmax()], picture) + (left, TOP)
            label = pixel_of((-2.2, -1.7), picture) + (left, TOP)
            draw.line((*(label + (20, -12)), *end), fill=INK, width=2)
            for k, text in enumerate(("support", "outline", "(weight 0.0001)")):
                write(draw, label + (0, 23 * k), text, 20 if k < 2 else 15)
    common.save(page, path)


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:3]))

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""smoothness.py PICTURE WORK: one control point of the lizard at several smoothness values."""

import pathlib
import sys

import common
from common import flbc, write

CAGE = common.MESHES / "2d" / "figure_cage.obj"
CONTROL_POINT = 32
VALUES = ("0", "0.003", "0.01", "0.03", "harmonic")
PANEL, WIDTH, TOP = 420, 364, 44  # of a picture, of the part with the cage, above it


def main(path, work):
    work.mkdir(parents=True, exist_ok=True)
    domain = work / "domain.obj"
    flbc("mesh", CAGE, "--vertices", 10000, "-q", "-o", domain)
    panels = []
    for value in VALUES:
        weights, picture = work / f"{value}.npy", work / f"{value}.png"
        how = ("--method", value) if value == "harmonic" else ("--smoothness", value)
        flbc("solve", CAGE, "--domain", domain, *how, "-q", "-o", weights)
        flbc("draw", domain, "--weights", weights, "--cage", CAGE, "--control-point", CONTROL_POINT,
             "--width", PANEL, "-o", picture)
        found = common.check(CAGE, "--domain", domain, "--weights", weights)["weights"]
        panels.append((value, common.Image.open(picture).convert("RGB"), found))
    height = TOP + panels[0][1].height + 44
    page, draw = common.page(WIDTH * len(panels), height)
    for k, (value, picture, found) in enumerate(panels):
        middle = k * WIDTH + WIDTH / 2
        page.paste(picture.crop((0, 0, WIDTH, picture.height)), (k * WIDTH, TOP))
        title = "harmonic" if value == "harmonic" else f"smoothness {value}"
        write(draw, (middle, 28), title, 26, weight="Bold")
        bottom = TOP + picture.height + 14
        write(draw, (middle, bottom), f"{found['mean_influences']:.1f} influences per vertex", 22)
    common.save(page, path)


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:3]))

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Automatic cages at work: a contact sheet of models in random smooth poses of cages made for them.

    contact_sheet.py FLBC MODEL... -o FOLDER [--control-points 100] [--vertices 6000] [--poses 3]

FOLDER gets the cages, weights, poses and pictures, and `sheet.png` of all. Standard output gets a
line per model: control points, seconds of cage and solve, smallest weight, reproduction error.
Needs NumPy and matplotlib.
"""

import argparse
import json
import pathlib
import subprocess
import time

import numpy

PART = 0.1  # of the size: how far linear and quadratic parts of a pose move


def smooth_pose(points, rng):
    """The points moved by a random linear and a random quadratic map."""
    low, high = points.min(0), points.max(0)
    size = numpy.linalg.norm(high - low)
    x = 2 * (points - (low + high) / 2) / size
    dim = x.shape[1]
    squares = numpy.stack([x[:, a] * x[:, b] for a in range(dim) for b in range(a + 1)], 1)
    moved = points.copy()
    for terms in (x, squares):
        part = terms @ rng.normal(size=(terms.shape[1], dim))
        moved += PART * size * part / numpy.abs(part).max()
    return moved


def read_points(path):
    rows = [line.split()[1:] for line in path.read_text().splitlines() if line.startswith("v ")]
    return numpy.array(rows, float)


def write_moved(source, points, path):
    """The file with other vertices."""
    rows = iter(points)
    lines = ["v " + " ".join(f"{x:.17g}" for x in next(rows)) if line.startswith("v ") else line
             for line in source.read_text().splitlines()]
    path.write_text("\n".join(lines) + "\n")


def timed(command):
    start = time.monotonic()
    subprocess.run([str(word) for word in command], check=True)
    return time.monotonic() - start


def make(model, arguments):
    """Cage, weights and pictures of a model; returns the pictures' paths."""
    folder = arguments.output / model.stem
    folder.mkdir(parents=True, exist_ok=True)
    cage, weights, report = (folder / name for name in ("cage.obj", "weights.npy", "solve.json"))
    caging = timed([arguments.flbc, "cage", model, "-o", cage, "-q",
                    "--control-points", arguments.control_points])
    solving = timed([arguments.flbc, "solve", cage, "--model", model, "-o", weights, "-q",
                     "--vertices", arguments.vertices, "--report", report])
    points = read_points(cage)
    rng = numpy.random.default_rng(1)
    pictures = []
    for number in range(arguments.poses):
        pose, picture = folder / f"pose_{number}.obj", folder / f"pose_{number}.png"
        write_moved(cage, smooth_pose(points, rng), pose)
        timed([arguments.flbc, "draw", "--model", model, "--weights", weights, "--cage", cage,
               "--pose", pose, "-o", picture, "--color", "plain", "--width", 1000])
        pictures.append(picture)
    told = json.loads(report.read_text())
    print(f"{model.stem}: {len(points)} control points, cage {caging:.2f} s, solve {solving:.1f} s, "
          f"smallest weight {told['min_weight']:.1e}, "
          f"reproduction {told['max_reproduction_error']:.1e}, {told['iterations']} iterations, "
          f"converged: {told['converged']}", flush=True)
    return pictures


def sheet(lines, names, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(len(lines), len(lines[0]), squeeze=False,
                                figsize=(4.6 * len(lines[0]), 2.7 * len(lines)))
    for row, name, line in zip(axes, names, lines):
        for axis, picture in zip(row, line):
            axis.imshow(plt.imread(picture))
            axis.set_axis_off()
        row[0].set_title(name, loc="left", fontsize=9)
    figure.tight_layout(pad=0.3)
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("flbc")
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--control-points", type=int, default=100)
    parser.add_argument("--vertices", type=int, default=6000)
    parser.add_argument("--poses", type=int, default=3)
    arguments = parser.parse_args()
    lines = [make(model, arguments) for model in arguments.models]
    sheet(lines, [model.stem for model in arguments.models], arguments.output / "sheet.png")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""Automatic cages at work: models in random smooth poses of the cages made for them, in one picture."""

import numpy

POSES = 3
COLOURS = 128
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


def pictures_of(context, model, folder):
    """Draws the model at rest beside three poses of its cage; returns the pictures' paths."""
    points = read_points(folder / "cage.obj")
    rng = numpy.random.default_rng(1)
    pictures = []
    for number in range(POSES):
        pose, picture = folder / f"pose_{number}.obj", folder / f"pose_{number}.png"
        write_moved(folder / "cage.obj", smooth_pose(points, rng), pose)
        done = context.run([context.flbc, "draw", "--model", model, "--weights",
                            folder / "weights.npy", "--cage", folder / "cage.obj", "--pose", pose,
                            "-o", picture, "--color", "plain", "--width", 1000])
        if done.status:
            raise RuntimeError(done.errors)
        pictures.append(picture)
    return pictures


def write(context, cases, path):
    """A line per case, a pair of a model and the folder of its cage and weights."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    lines = [pictures_of(context, model, folder) for model, folder in cases]
    names = [model.stem for model, _ in cases]
    figure, axes = plt.subplots(len(lines), len(lines[0]), squeeze=False,
                                figsize=(4.6 * len(lines[0]), 2.7 * len(lines)))
    for row, name, line in zip(axes, names, lines):
        for axis, picture in zip(row, line):
            axis.imshow(plt.imread(picture))
            axis.set_axis_off()
        row[0].set_title(name, loc="left", fontsize=9)
    figure.tight_layout(pad=0.3)
    figure.savefig(path, dpi=80)
    from PIL import Image
    with Image.open(path) as picture:  # a sixth of the bytes
        few_colours = picture.convert("RGB").quantize(COLOURS)
    few_colours.save(path, optimize=True)

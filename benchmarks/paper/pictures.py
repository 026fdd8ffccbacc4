# SPDX-License-Identifier: BSD-3-Clause
"""Figures 2 and 4: coordinate functions, drawn by `flbc draw` and put side by side."""

import subprocess

import results
from curves import plt, saved

WIDTH = 4.2  # of a picture, in inches


def draw_all(models, out, flbc):
    """Draws every figure whose CSV there is; yields the paths."""
    for figure in ("figure2", "figure4"):
        rows, _ = results.read(out, figure)
        for row in rows or []:
            draw(row, models, out, flbc)
        # A line per model; models with a single picture share one.
        lines = results.by(rows or [], "model")
        if all(len(line) == 1 for line in lines):
            lines = [[line[0] for line in lines]]
        if rows:
            yield saved(montage(lines, out), out / f"{figure}.png")


def draw(row, models, out, flbc):
    """One picture by the program."""
    picture = out / row["picture"]
    picture.parent.mkdir(exist_ok=True)
    command = [flbc, "draw", out / row["domain"], "--weights", out / row["weights"],
               "--cage", models / row["cage"], "--control-point", row["control_point"],
               "-o", picture, "--width", "1000"]
    if int(row["slices"]) > 0:
        command += ["--slices", row["slices"]]
    subprocess.run([str(word) for word in command], check=True)


def montage(lines, out):
    """Pictures in lines, each with its title, all of the same width."""
    images = [[plt.imread(out / row["picture"]) for row in line] for line in lines]
    heights = [max(image.shape[0] / image.shape[1] for image in line) * WIDTH + 0.35
               for line in images]
    columns = max(len(line) for line in lines)
    figure, axes = plt.subplots(len(lines), columns, squeeze=False, layout="constrained",
                                figsize=(WIDTH * columns, sum(heights)),
                                gridspec_kw={"height_ratios": heights})
    for axis in axes.flat:
        axis.axis("off")
    for k, line in enumerate(lines):
        for axis, row, image in zip(axes[k], line, images[k]):
            axis.imshow(image)
            axis.set_anchor("N")  # titles of a line at one height
            axis.set_title(f"{row['model']}, {results.thousands(row['vertices'])} vertices")
    return figure

# SPDX-License-Identifier: BSD-3-Clause
"""Figures 1, 2 and 4: coordinate functions, drawn by `flbc draw` and put side by side."""

import subprocess

import results

TITLES = {"with": "with non-negativity", "without": "without"}


def draw_all(plt, models, out, flbc):
    """Draws every figure whose CSV there is; returns the paths."""
    paths = []
    for figure, columns in (("figure1", 2), ("figure2", 3), ("figure4", 2)):
        rows, _ = results.read(out, figure)
        if rows:
            for row in rows:
                draw(row, models, out, flbc)
            paths.append(montage(plt, rows, columns, out / f"{figure}.png", out))
    return paths


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


def montage(plt, rows, columns, path, out):
    images = [plt.imread(out / row["picture"]) for row in rows]
    lines = [list(range(k, min(k + columns, len(rows)))) for k in range(0, len(rows), columns)]
    width = 4.2
    heights = [max(images[k].shape[0] / images[k].shape[1] for k in line) * width + 0.35
               for line in lines]
    figure, axes = plt.subplots(len(lines), columns, squeeze=False, layout="constrained",
                                figsize=(width * columns, sum(heights)),
                                gridspec_kw={"height_ratios": heights})
    for axis in axes.flat:
        axis.axis("off")
    for line_number, line in enumerate(lines):
        for column, k in enumerate(line):
            axes[line_number, column].imshow(images[k])
            axes[line_number, column].set_title(title(rows[k]))
    figure.savefig(path)
    plt.close(figure)
    return path


def title(row):
    text = f"{row['model']}, {results.thousands(row['vertices'])} vertices"
    return text + (f", {TITLES[row['variant']]}" if row["variant"] else "")

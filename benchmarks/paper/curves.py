#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Figures 3, 5 and 6: curves. And the times of the race.

    curves.py RESULTS_FOLDER PICTURES_FOLDER NAME...   draws results of these names
"""

import math
import pathlib
import sys

import matplotlib
import matplotlib.ticker

import results
from results import value

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

SMALLEST_ERROR = 1e-10  # below, a curve would show the references' own error
MARKED_ERROR = 1e-5     # a line across: the error of the race
# Methods of the race, as in the table of README.md.
RACE = {"paper": "2019 gradient ADMM, as published", "lbc2014-tuned": "2014 splitting, penalty tuned by us",
        "weights": "libflbc, default method"}


plt.rcParams.update({
    "font.family": ["Lato", "DejaVu Sans"], "figure.dpi": 130, "savefig.dpi": 130, "font.size": 10, "axes.titlesize": 11,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
    "grid.color": "#e4e4e4", "grid.linewidth": 0.7, "axes.axisbelow": True,
    "lines.linewidth": 1.6, "lines.markersize": 5, "legend.frameon": False,
    "legend.fontsize": 8.5})


def saved(figure, path):
    figure.savefig(path, dpi=figure.dpi)
    plt.close(figure)
    return path


def footer(figure, comments):
    """The machine and the commit, without the line that only explains columns."""
    lines = [line.split(";")[0] if line.startswith("commit ") else line for line in comments[1:]]
    figure.supxlabel("\n".join(lines), fontsize=7.5, color="#666666")


def scaling(rows, comments):
    models = results.by(rows, "model")
    figure, axes = plt.subplots(2, len(models), squeeze=False, layout="constrained",
                                figsize=(5.6 * len(models), 8.4))
    for mine, top, bottom in zip(models, axes[0], axes[1]):
        vertices = [value(row, "vertices") for row in mine]
        for name, label, color, marker in results.METHODS:
            curve = [row for row in mine if row["method"] == name]
            for axis, column, what, look in (
                    (top, "total_seconds", "", {}), (bottom, "solve_mebibytes", ", solve alone", {}),
                    (bottom, "peak_mebibytes", ", whole process", {"linestyle": ":", "markerfacecolor": "white"})):
                if curve:
                    plot_power(axis, [value(row, "vertices") for row in curve],
                               [value(row, column) for row in curve], label + what, color=color,
                               marker=marker, **look)
        top.set_title(f"{mine[0]['model']}, {mine[0]['control_points']} control points")
        for axis, what, share in ((top, "time with setup [s]", 0.2), (bottom, "peak memory [MiB]", 0.4)):
            axis.set_ylabel(what)
            axis.set_xlabel("vertices V of the mesh")
            set_vertex_ticks(axis, vertices)
            plain_ticks(axis.yaxis)
            axis.legend(loc="upper left")
            leave_room_above(axis, share)
    footer(figure, comments)
    return figure


def plot_power(axis, x, y, label, **look):
    slope = results.exponent(x, y)
    axis.loglog(x, y, label=label + (f" ~ V$^{{{slope:.2f}}}$" if slope is not None else ""),
                **look)


def set_vertex_ticks(axis, vertices):
    """The resolutions themselves, rounded: powers of ten would be one or two ticks."""
    ticks = sorted({float(f"{v:.1g}") for v in vertices})
    axis.set_xticks(ticks, [f"{t / 1000:g}k" for t in ticks])
    axis.set_xticks([], minor=True)


def plain_ticks(axis):
    """Numbers in full, and on a short axis 1, 2, 5, 10 ...: powers of ten alone would be few."""
    low, high = axis.get_view_interval()
    subs = (1, 2, 5) if high < 300 * low else (1,)
    axis.set_major_locator(matplotlib.ticker.LogLocator(subs=subs))
    axis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
    axis.set_minor_locator(matplotlib.ticker.NullLocator())


def leave_room_above(axis, share):
    """Space for the legend above the curves of a logarithmic axis, relative to their height."""
    low, high = axis.get_ylim()
    axis.set_ylim(low, high * (high / low) ** share)


def meaningful(curve):
    """The points up to the first below SMALLEST_ERROR."""
    for k, row in enumerate(curve):
        if value(row, "error") < SMALLEST_ERROR:
            return curve[:k + 1]
    return curve


def least_times(curve):
    """The least time of all runs with at least as many iterations: every point is a run of its own,
    and one that went further in less time shows how soon the others could have been there."""
    times = [results.after_setup(row) for row in curve]
    for k in range(len(times) - 2, -1, -1):
        times[k] = min(times[k], times[k + 1])
    return times


# Names at the ends of curves, which need no knowledge of options.
CURVE_NAMES = {"lbc2014": "LBC 2014", "lbc2014-tuned": "LBC 2014,\ntuned", "paper": "FLBC 2019",
               "gradient": "gradient\nADMM", "weights": "libflbc"}
MODEL_NAMES = {"woody": "woody (2D)", "horse": "horse (3D)"}


def convergence(rows, comments):
    models = results.by(rows, "model")
    figure, axes = plt.subplots(1, len(models), squeeze=False, layout="constrained",
                                figsize=(5.9 * len(models), 4.7))
    for mine, axis in zip(models, axes[0]):
        model = mine[0]["model"]
        reached, ends = {}, []
        for name, _, color, marker in results.METHODS:
            curve = meaningful([row for row in mine if row["method"] == name])
            if not curve or name not in CURVE_NAMES:
                continue
            errors = [value(row, "error") for row in curve]
            times = least_times(curve)
            axis.loglog(times, errors, color=color, marker=marker, markersize=4)
            reached[name] = results.reach(zip(times, errors), MARKED_ERROR)
            ends.append((times, errors, name, color))
        low = max(axis.get_ylim()[0], SMALLEST_ERROR)
        axis.set_ylim(bottom=low)
        labels = [name_end(axis, times, errors, low, factor_of(name, reached), color)
                  for times, errors, name, color in ends]
        axis.axhline(MARKED_ERROR, color="#888888", linestyle="--", linewidth=0.9)
        axis.set_title(f"{MODEL_NAMES.get(model, model)}: {mine[0]['control_points']} control points, "
                       f"{results.thousands(mine[0]['vertices'])} vertices")
        axis.set_xlim(right=axis.get_xlim()[1] * 2.2)
        plain_ticks(axis.xaxis)
        axis.set_xlabel("seconds of solve and recovery")
        axis.set_ylabel("mean squared error")
        move_apart(axis, labels)
    footer(figure, ["", "\u00d7: time to an error of 1e-5 (dashed), relative to libflbc"]
           + comments[1:])
    return figure


def factor_of(name, reached):
    """The name, with how many times as long as libflbc the method takes to the marked error."""
    if name == "weights" or math.isnan(reached[name]):
        return CURVE_NAMES[name]
    factor = reached[name] / reached["weights"]
    return f"{CURVE_NAMES[name]} ({factor:.{0 if factor >= 10 else 1}f}\u00d7)"


def name_end(axis, times, errors, low, label, color):
    """The label to the right of where a curve ends, or, where it leaves the axis, to its better side."""
    end = results.reach(zip(times, errors), low)
    place, offset, sides = (times[-1], errors[-1]), (8, 0), ("left", "center")
    if not math.isnan(end):
        place, offset, sides = (end, low), (6, 14), ("left", "bottom")
    if label == CURVE_NAMES["weights"]:
        offset, sides = (-64, 6), ("right", "bottom")
    return axis.annotate(label, place, xytext=offset, textcoords="offset points", color=color,
                         fontsize=9.5, fontweight="bold", ha=sides[0], va=sides[1],
                         bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.6, "pad": 0.5})


def move_apart(axis, labels):
    """Moves labels up until they are above the axis and cover no label below them."""
    axis.figure.canvas.draw()
    points_per_pixel = 72 / axis.figure.dpi
    boxes = []
    for label in sorted(labels, key=lambda label: label.get_window_extent().y0):
        box = label.get_window_extent()
        least = max([axis.get_window_extent().y0 + 3,
                     *(other.y1 + 2 for other in boxes if box.overlaps(other))])
        up = max(0, least - box.y0)
        label.xyann = (label.xyann[0], label.xyann[1] + up * points_per_pixel)
        boxes.append(box.translated(0, up))


def times(rows, comments):
    """Seconds to the error of the race, 900 x 400 pixels; no mark where a method did not reach it.
    Marks and not bars, because a logarithmic axis has no zero."""
    models = results.by(rows, "model")
    figure, axis = plt.subplots(figsize=(9, 4), dpi=100, layout="constrained")
    reached = {(row["model"], row["method"]): value(row, "total_seconds") for row in rows if row["converged"] == "1"}
    for method, _, color, marker in results.METHODS:
        for place, model in enumerate(mine[0]["model"] for mine in models):
            if method not in RACE or (model, method) not in reached:
                continue
            seconds = reached[model, method]
            axis.plot(place, seconds, marker, color=color, markersize=8, label=RACE[method] if place == 0 else None)
            ratio = seconds / reached.get((model, "weights"), math.nan)
            text = f"{seconds:.2f} s" if method == "weights" else f"{ratio:.{0 if ratio >= 10 else 1}f}\u00d7"
            left = method == "lbc2014-tuned"  # on the other side, because the two are close
            axis.annotate(text, (place, seconds), xytext=(-8 if left else 8, 0), textcoords="offset points",
                          color=color, fontsize=9, ha="right" if left else "left", va="center")
    axis.set_yscale("log")
    leave_room_above(axis, 0.18)
    plain_ticks(axis.yaxis)
    axis.grid(axis="x", visible=False)
    axis.set_xlim(-0.4, len(models) - 0.3)
    axis.set_xticks(range(len(models)), [f"{mine[0]['model']}\nn = {mine[0]['control_points']}" for mine in models])
    axis.set_ylabel("seconds (logarithmic)")
    axis.set_title("Seconds to a true mean squared error of 1e-5, setup included")
    axis.legend(loc="upper center", ncol=len(RACE))
    machine = comments[1].split("; compiler")[0] if len(comments) > 1 else ""
    figure.supxlabel("n: control points. \u00d7: time relative to libflbc. We implemented the 2014 and 2019 methods. "
                     f"{machine}.", fontsize=8, color="#666666")
    return figure


DRAWN = {"figure3": (scaling, "figure3"), "figure5": (convergence, "error_against_time"),
         "figure6": (convergence, "error_against_time_large"), "race": (times, "seconds_to_error")}


def draw_all(stored, folder, names=DRAWN):
    """Draws those of which there are results; yields the paths."""
    for name in names:
        draw, picture = DRAWN[name]
        rows, comments = results.read(stored, name)
        if rows:
            yield saved(draw(rows, comments), folder / f"{picture}.png")


if __name__ == "__main__":
    for path in draw_all(*map(pathlib.Path, sys.argv[1:3]), sys.argv[3:]):
        print(path)

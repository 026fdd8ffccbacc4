# SPDX-License-Identifier: BSD-3-Clause
"""Figures 3, 5 and 6: curves. And the bars of the race."""

import math

import matplotlib.ticker

import results
from tables import after_setup

SMALLEST_ERROR = 1e-10  # below, a curve would show the references' own error
MARKED_ERROR = 1e-5     # a line across: the error of the race
# Bars of the race, as in the table of README.md: method, label, color.
BARS = [("paper", "2019 gradient ADMM, as published", "#c4c4c4"),
        ("lbc2014-tuned", "2014 splitting, penalty tuned by us", "#6e6e6e"),
        ("value", "libflbc, default method", "#1b9e4b")]


def draw_all(plt, out):
    """Draws every figure whose CSV there is; returns the paths."""
    paths = []
    for name, draw, picture in (("figure3", scaling, "figure3"), ("figure5", convergence, "figure5"),
                                ("figure6", convergence, "figure6"), ("race", bars, "seconds_to_error")):
        rows, comments = results.read(out, name)
        if rows:
            paths.append(draw(plt, rows, comments, out / f"{picture}.png"))
    return paths


def style(plt):
    plt.rcParams.update({
        "figure.dpi": 130, "savefig.dpi": 130, "font.size": 10, "axes.titlesize": 11,
        "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True,
        "grid.color": "#e4e4e4", "grid.linewidth": 0.7, "axes.axisbelow": True,
        "lines.linewidth": 1.6, "lines.markersize": 5, "legend.frameon": False,
        "legend.fontsize": 8.5})


def footer(figure, comments):
    """The machine, without the line that only explains columns."""
    figure.supxlabel("\n".join(comments[1:]), fontsize=7.5, color="#666666")


def scaling(plt, rows, comments, path):
    models = results.in_order(row["model"] for row in rows)
    figure, axes = plt.subplots(2, len(models), squeeze=False, layout="constrained",
                                figsize=(5.6 * len(models), 8.4))
    for column, model in enumerate(models):
        top, bottom = axes[0, column], axes[1, column]
        for name, label, color, marker in results.METHODS:
            curve = [r for r in rows if r["model"] == model and r["method"] == name]
            if not curve:
                continue
            vertices = [results.value(r, "vertices") for r in curve]
            plot_power(top, vertices, [results.value(r, "total_seconds") for r in curve], label,
                       color=color, marker=marker)
            plot_power(bottom, vertices, [results.value(r, "solve_mebibytes") for r in curve],
                       label + ", solve alone", color=color, marker=marker)
            plot_power(bottom, vertices, [results.value(r, "peak_mebibytes") for r in curve],
                       label + ", whole process", color=color, marker=marker, linestyle=":",
                       markerfacecolor="white")
        top.set_title(f"{model}, {curve_size(rows, model)} control points")
        top.set_ylabel("time with set-up [s]")
        bottom.set_ylabel("peak memory [MiB]")
        for axis in (top, bottom):
            axis.set_xlabel("vertices V of the mesh")
            set_vertex_ticks(axis, [results.value(r, "vertices") for r in rows
                                    if r["model"] == model])
            plain_ticks(axis.yaxis)
            axis.legend(loc="upper left")
        leave_room_above(top, 0.2)
        leave_room_above(bottom, 0.4)
    footer(figure, comments)
    figure.savefig(path)
    plt.close(figure)
    return path


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


def curve_size(rows, model):
    return next(row["control_points"] for row in rows if row["model"] == model)


def meaningful(curve):
    """The points up to the first below SMALLEST_ERROR."""
    for k, row in enumerate(curve):
        if results.value(row, "error") < SMALLEST_ERROR:
            return curve[:k + 1]
    return curve


def least_times(curve):
    """The least time of all runs with at least as many iterations: every point is a run of its own,
    and one that went further in less time shows how soon the others could have been there."""
    times = [after_setup(row) for row in curve]
    for k in range(len(times) - 2, -1, -1):
        times[k] = min(times[k], times[k + 1])
    return times


# Names at the ends of curves, which need no knowledge of options.
CURVE_NAMES = {"lbc2014": "LBC 2014", "lbc2014-tuned": "LBC 2014,\ntuned", "paper": "FLBC 2019",
               "gradient": "gradient\nADMM", "value": "libflbc"}
MODEL_NAMES = {"woody": "2D figure", "horse": "3D horse"}


def convergence(plt, rows, comments, path):
    models = results.in_order(row["model"] for row in rows)
    figure, axes = plt.subplots(1, len(models), squeeze=False, layout="constrained",
                                figsize=(5.9 * len(models), 4.7))
    for model, axis in zip(models, axes[0]):
        mine = [row for row in rows if row["model"] == model]
        reached, ends = {}, []
        for name, _, color, marker in results.METHODS:
            curve = meaningful([row for row in mine if row["method"] == name])
            if not curve or name not in CURVE_NAMES:
                continue
            times, errors = least_times(curve), [results.value(row, "error") for row in curve]
            axis.loglog(times, errors, color=color, marker=marker, markersize=4)
            reached[name] = time_of(times, errors, MARKED_ERROR)
            ends.append((times, errors, name, color))
        low = max(axis.get_ylim()[0], SMALLEST_ERROR)
        axis.set_ylim(bottom=low)
        for times, errors, name, color in ends:
            name_end(axis, times, errors, low, factor_of(name, reached), color)
        axis.axhline(MARKED_ERROR, color="#888888", linestyle="--", linewidth=0.9)
        axis.set_title(f"{MODEL_NAMES.get(model, model)}: {mine[0]['control_points']} control points, "
                       f"{results.thousands(mine[0]['vertices'])} vertices")
        axis.set_xlim(right=axis.get_xlim()[1] * 2.2)
        plain_ticks(axis.xaxis)
        axis.set_xlabel("seconds of solve and recovery")
        axis.set_ylabel("mean squared error")
    footer(figure, ["", "\u00d7: time to an error of 1e-5 (dashed), relative to libflbc"]
           + comments[1:])
    figure.savefig(path)
    plt.close(figure)
    return path


def time_of(times, errors, error):
    """When a curve first reaches the error, interpolated; None if it does not."""
    for k in range(1, len(errors)):
        if errors[k] <= error < errors[k - 1]:
            part = math.log(errors[k - 1] / error) / math.log(errors[k - 1] / errors[k])
            return times[k - 1] * (times[k] / times[k - 1]) ** part
    return None


def factor_of(name, reached):
    """The name, with how many times as long as libflbc the method takes to the marked error."""
    if name == "value" or not reached[name]:
        return CURVE_NAMES[name]
    factor = reached[name] / reached["value"]
    return f"{CURVE_NAMES[name]} ({factor:.{0 if factor >= 10 else 1}f}\u00d7)"


def name_end(axis, times, errors, low, label, color):
    """The label to the right of where a curve ends, or, where it leaves the axis, to its better side."""
    end = time_of(times, errors, low)
    place, offset, sides = (times[-1], errors[-1]), (8, 0), ("left", "center")
    if end:
        place, offset, sides = (end, low), (6, 14), ("left", "bottom")
    if label == CURVE_NAMES["value"]:
        offset, sides = (-28, 14), ("right", "bottom")
    axis.annotate(label, place, xytext=offset, textcoords="offset points", color=color, fontsize=9.5,
                  fontweight="bold", ha=sides[0], va=sides[1])


def bars(plt, rows, comments, path):
    """Seconds to the error of the race, 900 x 400 pixels; no bar where a method did not reach it."""
    models = results.in_order(row["model"] for row in rows)
    figure, axis = plt.subplots(figsize=(9, 4), dpi=100, layout="constrained")
    width = 0.8 / len(BARS)
    for k, (method, label, color) in enumerate(BARS):
        for place, model in enumerate(models):
            row = next((r for r in rows if (r["method"], r["model"]) == (method, model)), None)
            if not row or row["converged"] != "1":
                continue
            seconds = results.value(row, "total_seconds")
            bar = axis.bar(place + (k - (len(BARS) - 1) / 2) * width, seconds, width, color=color,
                           label=label if place == 0 else None)
            axis.bar_label(bar, [f"{seconds:.2f}"], fontsize=8, padding=1, color="#333333")
    axis.set_yscale("log")
    leave_room_above(axis, 0.18)
    plain_ticks(axis.yaxis)
    axis.grid(axis="x", visible=False)
    axis.set_xticks(range(len(models)), [f"{model}\nn = {curve_size(rows, model)}" for model in models])
    axis.set_ylabel("seconds (logarithmic)")
    axis.set_title("Seconds to a true mean squared error of 1e-5, setup included")
    axis.legend(loc="upper center", ncol=len(BARS))
    machine = comments[1].split("; compiler")[0] if len(comments) > 1 else ""
    figure.supxlabel(f"n: control points. Both gray methods are our implementations. {machine}.",
                     fontsize=8, color="#666666")
    figure.savefig(path, dpi=100)
    plt.close(figure)
    return path

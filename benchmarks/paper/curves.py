# SPDX-License-Identifier: BSD-3-Clause
"""Figures 3, 5 and 6: curves."""

import matplotlib.ticker

import results
from tables import after_setup

SMALLEST_ERROR = 1e-10  # below, a curve would show the references' own error


def draw_all(plt, out):
    """Draws every figure whose CSV there is; returns the paths."""
    paths = []
    for name, draw in (("figure3", scaling), ("figure5", convergence), ("figure6", convergence)):
        rows, comments = results.read(out, name)
        if rows:
            paths.append(draw(plt, rows, comments, out / f"{name}.png"))
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
        for name, label, colour, marker in results.METHODS:
            curve = [r for r in rows if r["model"] == model and r["method"] == name]
            if not curve:
                continue
            vertices = [results.value(r, "vertices") for r in curve]
            plot_power(top, vertices, [results.value(r, "total_seconds") for r in curve], label,
                       color=colour, marker=marker)
            plot_power(bottom, vertices, [results.value(r, "solve_mebibytes") for r in curve],
                       label + ", solve alone", color=colour, marker=marker)
            plot_power(bottom, vertices, [results.value(r, "peak_mebibytes") for r in curve],
                       label + ", whole process", color=colour, marker=marker, linestyle=":",
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


def convergence(plt, rows, comments, path):
    models = results.in_order(row["model"] for row in rows)
    # The legend below all curves: there is no corner that none of them passes.
    figure, axes = plt.subplot_mosaic([models, ["legend"] * len(models)], layout="constrained",
                                      figsize=(5.6 * len(models), 4.6),
                                      gridspec_kw={"height_ratios": [1, 0.06]})
    for model in models:
        axis = axes[model]
        mine = [row for row in rows if row["model"] == model]
        for name, label, colour, marker in results.METHODS:
            curve = meaningful([row for row in mine if row["method"] == name])
            if curve:
                axis.loglog(least_times(curve),
                            [results.value(r, "error") for r in curve],
                            label=label, color=colour, marker=marker)
        axis.set_ylim(bottom=max(axis.get_ylim()[0], SMALLEST_ERROR))
        axis.set_title(f"{model}, {results.thousands(mine[0]['vertices'])} vertices, "
                       f"{mine[0]['control_points']} control points")
        plain_ticks(axis.xaxis)
        axis.set_xlabel("time of solve and recovery [s]")
        axis.set_ylabel("mean squared error of the weights [1]")
    axes["legend"].axis("off")
    axes["legend"].legend(*axes[models[0]].get_legend_handles_labels(), loc="center",
                          ncol=len(results.METHODS))
    footer(figure, comments)
    figure.savefig(path)
    plt.close(figure)
    return path

#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes tables.md and the chart of the race from the CSV files of flbc_bench_paper.

    plots.py OUT_FOLDER
"""

import hashlib
import math
import pathlib
import sys

import results
import tables
from results import value

# Methods of the race.
RACE = ("paper", "lbc2014-tuned", "weights")


def write_tables(out):
    """All tables of the pages of which there are results."""
    found = [name for name in tables.TABLES if (out / f"{tables.source_of(name)}.csv").exists()]
    path = out / "tables.md"
    path.write_text("\n".join(f"## {name}\n\n{tables.markdown(out, name)}" for name in found))
    return path


def axes_of(rows, columns, size):
    """A figure and its axes."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({
        "font.family": ["Lato", "DejaVu Sans"], "font.size": 10, "axes.titlesize": 11, "axes.grid": True,
        "axes.spines.top": False, "axes.spines.right": False, "grid.color": "#e4e4e4", "grid.linewidth": 0.7,
        "axes.axisbelow": True, "legend.frameon": False, "legend.fontsize": 8.5})
    return plt.subplots(rows, columns, figsize=size, dpi=100, layout="constrained")


def save(figure, path, stored, *names):
    """Saves a chart with the check sums of its results, which tests compare."""
    sums = " ".join(hashlib.sha256((stored / f"{name}.csv").read_bytes()).hexdigest() for name in names)
    figure.savefig(path, dpi=figure.dpi, metadata={"Source": sums})
    return path


def draw_errors(stored, folder):
    """Error against time of figures 5 and 6."""
    figure, axes = axes_of(2, 2, (9, 7))
    cases = [case for name in ("figure5", "figure6") for case in results.by(results.read(stored, name)[0], "model")]
    for axis, rows in zip(axes.flat, cases):
        for method, label, color, marker in results.METHODS:
            mine = [row for row in rows if row["method"] == method]
            axis.loglog([value(row, "total_seconds") for row in mine], [value(row, "error") for row in mine], color=color,
                        marker=marker, markersize=4, linewidth=1.2, label=label if mine and axis is axes[1, 0] else None)
        axis.axhline(1e-5, color="#999999", linestyle="--", linewidth=0.8)
        axis.set_title(f"{rows[0]['model']}: {rows[0]['control_points']} control points, {int(rows[0]['vertices']):,} vertices")
    axes[1, 0].legend(loc="lower left")
    figure.supxlabel("seconds of setup, solve, and recovery")
    figure.supylabel("mean squared error")
    return save(figure, folder / "error_against_time.png", stored, "figure5", "figure6")


def draw_race(stored, folder):
    """Seconds to the error of the race, 900 x 400 pixels; no mark where a method did not reach it.
    Marks and not bars, because a logarithmic axis has no zero."""
    from matplotlib import ticker
    rows, comments = results.read(stored, "race")
    if not rows:
        return "no results of the race"
    models = results.by(rows, "model")
    figure, axis = axes_of(1, 1, (9, 4))
    reached = {(row["model"], row["method"]): value(row, "total_seconds") for row in rows if row["converged"] == "1"}
    for method, _, color, marker in results.METHODS:
        for place, model in enumerate(mine[0]["model"] for mine in models):
            if method not in RACE or (model, method) not in reached:
                continue
            seconds = reached[model, method]
            axis.plot(place, seconds, marker, color=color, markersize=8, label=results.LABELS[method] if place == 0 else None)
            ratio = seconds / reached.get((model, "weights"), math.nan)
            text = f"{seconds:.2f} s" if method == "weights" else f"{ratio:.{0 if ratio >= 10 else 1}f}\u00d7"
            left = method == "lbc2014-tuned"  # on the other side, because the two are close
            axis.annotate(text, (place, seconds), xytext=(-8 if left else 8, 0), textcoords="offset points",
                          color=color, fontsize=9, ha="right" if left else "left", va="center")
    axis.set_yscale("log")
    low, high = axis.get_ylim()
    axis.set_ylim(low, high * (high / low) ** 0.18)  # space for the legend
    axis.yaxis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if high < 300 * low else (1,)))
    axis.yaxis.set_major_formatter(ticker.FuncFormatter(lambda x, _: f"{x:g}"))
    axis.yaxis.set_minor_locator(ticker.NullLocator())
    axis.grid(axis="x", visible=False)
    axis.set_xlim(-0.4, len(models) - 0.3)
    axis.set_xticks(range(len(models)), [f"{mine[0]['model']}\nn = {mine[0]['control_points']}" for mine in models])
    axis.set_ylabel("seconds (logarithmic)")
    axis.set_title("Seconds to a true mean squared error of 1e-5, setup included")
    axis.legend(loc="upper center", ncol=len(RACE))
    machine = comments[1].split("; compiler")[0] if len(comments) > 1 else ""
    figure.supxlabel("n: control points. \u00d7: time relative to the default method. We implemented the 2014 and 2019 methods. "
                     f"{machine}.", fontsize=8, color="#666666")
    return save(figure, folder / "seconds_to_error.png", stored, "race")


def main(out):
    print(write_tables(out))
    try:
        print(draw_race(out, out))
    except ImportError:
        sys.exit("plots.py: no picture without matplotlib: install the Debian package python3-matplotlib "
                 f"and run again; the numbers are in {out}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())
    main(pathlib.Path(sys.argv[1]).resolve())

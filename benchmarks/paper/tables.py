# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the pages as header and body, from rows of the CSV files."""

import math

import results
from results import by, cells, ratio, text, thousands, value

# Tables that are made of another result than that of their own name.
SOURCES = {"harmonic": "models", "solvers": "race", "growth": "speed"}


def source_of(name):
    """The result, a file in docs/results without .csv, that a table is made of."""
    return SOURCES.get(name, name)


def markdown(folder, name):
    """A table of a stored result, with the commit that made it."""
    rows, comments = results.read(folder, source_of(name))
    header, body = TABLES[name](rows)
    lines = ["| " + " | ".join(row) + " |" for row in [header, *body]]
    lines.insert(1, "|---" * len(header) + "|")
    commit = next((c for c in comments if c.startswith("commit ")), "commit unknown").split(";")[0]
    if any(c.startswith("busy machine") for c in comments):
        commit += "; seconds are too long: other programs ran on the machine"
    return "\n".join(lines) + f"\n\n(docs/results/{source_of(name)}.csv, {commit})\n"


def lines(*columns):
    """The function that makes a table with a line per row. Columns: a header and what results.cell takes."""
    def make(rows):
        return [header for header, _ in columns], [cells(row, *(kind for _, kind in columns)) for row in rows]
    return make


def grouped(title, *columns):
    """The same with a first column that has the title of rows in a sequence with the same one only once."""
    def make(rows):
        header, body = lines(("model", title), *columns)(rows)
        titles = [row[0] for row in body]
        for before, row, mine in zip(titles, body[1:], titles[1:]):
            row[0] = "" if mine == before else mine
        return header, body
    return make


def iterations(row):
    """Those on the given mesh, whether they are the limit, and on how many coarser meshes before."""
    parts = [thousands(row["iterations"])]
    if row.get("coarse_levels", "0") not in ("", "0"):
        parts.append(f"+ {row['coarse_levels']} level" + "s" * (row["coarse_levels"] != "1"))
    if row.get("converged") == "0":
        parts.append("(limit)")
    return " ".join(parts)


def sized(row):
    return f"{row['model']}, n = {row['control_points']}, {thousands(row['vertices'])} V"


def powers(rows, *columns):
    """How the columns grow with the number of vertices, at the last row of each curve."""
    vertices = [value(r, "vertices") for r in rows]
    found = [results.exponent(vertices, [value(r, c) for r in rows]) for c in columns]
    return ", ".join("-" if power is None else f"{power:.2f}" for power in found)


SIZE = [("model", "model"), ("n", "control_points"), ("V", "vertices:,.0f")]
HARMONIC = [("Model", lambda row: row["model"] + (" (2D)" if row["model"] in ("logo", "woody", "cactus", "figure", "letter", "ring") else "")),
            ("Control points", "control_points"), ("Mesh vertices", "vertices:,.0f"),
            ("Influences: local", lambda row: f"**{value(row, 'mean_influences'):.1f}**"),
            ("Influences: harmonic", "harmonic_influences:.1f"),
            ("Time: local, s", "total_seconds:.2f"), ("Time: harmonic, s", "harmonic_seconds:.2f")]
MODELS = [*SIZE, ("cells", "cells:,.0f"), ("iterations", iterations), ("mesh, s", "mesh_seconds:.2f"),
          ("setup, s", "setup_seconds:.2f"), ("solve, s", "solve_seconds:.2f"),
          ("harmonic, s", "harmonic_seconds:.2f"), ("MiB", "peak_mebibytes:,.0f"),
          ("influences", "mean_influences:.1f"), ("harmonic influences", "harmonic_influences:.1f"),
          ("smallest weight", "min_weight:.1e"), ("reproduction error", "reproduction_error:.1e")]
TABLE1 = [*SIZE, ("squared distance", "squared_distance:.1e"), ("(paper)", "paper_squared_distance:.1e"),
          ("largest difference", "largest_difference:.1e"), ("min w without", "min_weight_without:.1e"),
          ("gap with", "relative_gap_with:.1e"), ("gap without, made non-negative", "relative_gap_without:.1e")]
CAGES = [("model", lambda row: row["model"] + (", 2D" if row["dim"] == "2" else "")), ("vertices", "vertices:,.0f"),
         ("control points", "control_points"), ("outside, crossing", lambda row: f"{row['outside']}, {row['crossings']}"),
         ("distance", "distance:.1%"), ("symmetric across", "symmetric_across"), ("s", "processor_seconds:.2f"),
         ("`flbc check`", "check"),
         ("iterations of the solve", lambda row: iterations(row) if row["solve"] == "converged" else row["solve"]),
         ("smallest weight", "min_weight:.1e"), ("reproduction error", "reproduction_error:.1e")]


def with_published(row):
    published = cells(row, "paper_lbc_error:.1e", "paper_flbc_error:.1e")
    return sized(row) + (f" ({' / '.join(published)})" if row["paper_lbc_error"] else "")


def method(row):
    label = results.LABELS[row["method"]]
    return f"**{label}**" if row["method"] == "weights" else label


TABLE2 = [("method", method), ("iterations", iterations), ("total, s", "total_seconds:.2f"),
          ("true error", "error:.1e"), ("gap", "relative_gap:.1e"), ("smallest weight", "min_weight:.1e"),
          ("influences", "mean_influences:.1f")]


def creases(row):
    return f"{value(row, 'crease_mean'):.2f}, {value(row, 'crease_high'):.1f}" if row["crease_mean"] else ""


SMOOTHNESS = [("smoothness", "smoothness"), ("influences", "mean_influences:.2f"),
              ("jump of gradients", "gradient_jump:.2f"), ("creases: mean, 99%", creases),
              ("iterations", lambda row: iterations(row) if row["iterations"] else ""),
              ("true error / tolerance", "error:.2f"), ("default solve, s", "default_seconds:.2f")]


def parts(row, form):
    """Seconds of setup, and of all after it."""
    setup, total = value(row, "setup_seconds"), value(row, "total_seconds")
    return f"{setup:{form}} + {total - setup:{form}}"


SAMPLES = [*HARMONIC, *((f"To 1e-5: {label}, s", f"to_1e-5_{name}:.2f") for name, label in (
    ("weights", "local"), ("lbc2014-tuned", "2014, tuned penalty"), ("paper", "2019")))]
COMPARE = [("model", "model"), ("coordinates", "coordinates"), ("influences", "influences:.1f"),
           ("maximum", "max_influences"), ("reach", "reach:.1%"), ("smallest weight", "min_weight:.1e"),
           ("total variation", "total_variation:.2f"), ("distortion", "distortion:.3f"),
           ("volume change", "volume_change:.3f"), ("flipped", "flipped:.2%"), ("setup, s", "setup_seconds:.2f"),
           ("solve, s", "solve_seconds:.2f")]
DISTORTION = [("model", "model"), ("coordinates", "method"), ("distortion", "distortion:.2f"),
              ("bend", "bend:.2f"), ("stretch", "stretch:.2f"), ("twist", "twist:.2f"),
              ("model vertices that move", "moved_share:.0%")]
SPEED = [*SIZE, ("iterations", iterations),
         ("setup + solve = total, s", lambda row: f"{parts(row, '.3f')} = {value(row, 'total_seconds'):.3f}"),
         ("true error", "error:.1e"), ("harmonic, s", "harmonic_seconds:.3f"),
         ("ratio", lambda row: text(ratio(row, "total_seconds", "harmonic_seconds"), ".1f"))]
GROWTH = [*SIZE, ("cells", "cells:,.0f"), ("levels", lambda row: str(int(row["coarse_levels"]) + 1)),
          ("iterations", "iterations"), ("setup + solve, s", lambda row: parts(row, ".2f")),
          ("peak MiB", "peak_mebibytes:,.0f"),
          ("bytes per cell", lambda row: text(2**20 * ratio(row, "peak_mebibytes", "cells"), ",.0f"))]
FIGURE3 = [("model", "model"), ("method", lambda row: results.LABELS[row["method"]]), ("V", "vertices:,.0f"),
           ("iterations", iterations), ("solve, s", "solve_seconds:.3f"), ("recover, s", "recover_seconds:.3f"),
           ("recovery in iterations", lambda row: text(
               ratio(row, "recover_seconds", "solve_seconds") * max(1, int(row["iterations"])), ".1f")),
           ("total, s", "total_seconds:.3f"), ("MiB beyond the problem", "solve_mebibytes:,.0f")]


def curves(columns, *grow):
    """A table of curves, a line per row; the last line of each curve has the powers with which columns grow."""
    def make(rows):
        header, body = lines(*columns)(rows)
        keys = [(row["model"], row.get("method")) for row in rows]
        for k, row in enumerate(body):
            mine = [r for r, key in zip(rows, keys) if key == keys[k]]
            row.append(powers(mine, *grow) if rows[k] is mine[-1] and len(mine) > 1 else "")
        return header + ["time, memory grow as V to the power"], body
    return make


def growth(rows):
    """The curves of the models that were measured on several meshes."""
    several = [mine for mine in by(rows, "model") if len(mine) > 1]
    return curves(GROWTH, "total_seconds", "peak_mebibytes")([row for mine in several for row in mine])


def race(rows):
    """Seconds to the error, in parentheses iterations; a line per model."""
    names = [name for name in results.LABELS if any(r["method"] == name for r in rows)]

    def shown(row):
        counted = iterations(dict(row, converged="1"))
        return (f"{value(row, 'total_seconds'):.2f} "
                f"({'not within ' * (row['converged'] != '1')}{counted})")
    body = []
    for mine in by(rows, "model"):
        run = {row["method"]: row for row in mine}
        body.append(cells(mine[0], *(kind for _, kind in SIZE)) +
                    [shown(run[name]) if name in run else "-" for name in names])
    return [header for header, _ in SIZE] + [f"{results.LABELS[name]}, s" for name in names], body


SOLVERS = {"weights": "**libflbc**, default method", "lbc2014-tuned": "2014 splitting, penalty tuned by us",
           "paper": "2019 gradient ADMM, as published"}


AUTHORS2014 = [*SIZE, ("authors' program: penalty", "lbc_penalty"), ("iterations", "lbc_iterations"),
               ("s", "lbc_seconds:.2f"), ("libflbc: iterations", "flbc_iterations"), ("s", "flbc_seconds:.2f"),
               ("ratio", "lbc_over_flbc:.0f")]


def solvers(rows):
    """Seconds to the error, from the same rows as race: a line per method, the best of each model bold."""
    models = results.in_order(row["model"] for row in rows)
    seconds = {(row["method"], row["model"]): f"{value(row, 'total_seconds'):.2f}"
               for row in rows if row["converged"] == "1"}
    best = {model: min((seconds[method, model] for method in SOLVERS if (method, model) in seconds),
                       key=float, default=None) for model in models}

    def shown(method, model):
        time = seconds.get((method, model), "not reached")
        return f"**{time}**" if time == best[model] else time
    return (["Seconds to 1e-5"] + models,
            [[name] + [shown(method, model) for model in models] for method, name in SOLVERS.items()])


def tolerance(rows):
    """Iterations, in parentheses the true error relative to the tolerance; a line per mesh."""
    wanted = results.in_order(row["tolerance"] for row in rows)
    body = []
    for model, vertices in results.in_order((r["model"], r["vertices"]) for r in rows):
        runs = {r["tolerance"]: r for r in rows if (r["model"], r["vertices"]) == (model, vertices)}
        body.append([model, thousands(vertices)] +
                    [f"{iterations(runs[t])} ({value(runs[t], 'error'):.2f})" if t in runs else "-"
                     for t in wanted])
    worst = [max(value(r, "error") for r in rows if r["tolerance"] == t) for t in wanted]
    return (["model", "V"] + [f"{float(t):.0e}".replace("e-0", "e-") for t in wanted],
            body + [["worst", ""] + [f"({error:.2f})" for error in worst]])


def many_run(prefix):
    """The cell of a run on the active set, or with a prefix on all pairs."""
    return lambda row: ", ".join(cells(row, f"{prefix}iterations:,.0f", f"{prefix}seconds:.2f",
                                       f"{prefix}mebibytes:,.0f")) if row[prefix + "iterations"] else "-"


MANY = [("cage", "cage"), ("n", "control_points"), ("V", "vertices:,.0f"), ("tolerance", "tolerance:.0e"),
        ("all pairs: iterations, s, MiB", many_run("all_")), ("active set: iterations, s, MiB", many_run("")),
        ("pairs", "density:.1%"), ("speedup", lambda row: text(ratio(row, "all_seconds", "seconds"), ".1f")),
        ("difference", "difference:.1e")]


def percent(row, column):
    number = 100 * value(row, column)
    return f"{number:,.0f}" if number >= 100 else f"{number:.3g}"


def error(column):
    """In percent, root mean square (largest)."""
    return lambda row: f"{percent(row, column)} ({percent(row, column + '_max')})"


def animated(row):
    kinds = ("edges_animation", "positions_animation")
    return ", ".join(percent(row, kind) for kind in kinds) if row["edges_animation"] else ""

PIPELINE = [("model", "model"), ("cage of", "cage_of"), ("total, s", "total:.1f"), ("cage", "cage:.1f"),
            ("mesh", "mesh:.1f"), ("solve", "solve:.1f"), ("reduce to 8", "sparsify:.1f"), ("export", "export:.1f"),
            ("at the same time: check", "check:.1f"), ("pictures", "pictures:.1f")]


MESH_DEFORM = [("model", "model"),
               *((title, lambda row, name=name: f"{row[name + '_least']}% to {row[name + '_largest']}%")
                 for title, name in (("add-on", "addon"), ("Mesh Deform", "mesh_deform")))]


def sparsified(row):
    return (f"{row['weights']}, {thousands(row['points'])} points, n = {row['control_points']}, "
            f"{value(row, 'influences_before'):.0f} influences before")


SPARSIFY = [("K", "k"), ("method", "method"), ("edges, independent", error("edges_independent")),
            ("edges, smooth", error("edges_smooth")), ("positions, independent", error("positions_independent")),
            ("positions, smooth", error("positions_smooth")), ("edges, positions, animation", animated),
            ("s", "seconds:.3f")]


def time_to_error(rows):
    """Iterations and seconds of solve and recovery to an error; a line per curve."""
    thresholds = (1e-4, 1e-5, 1e-6)

    def shown(curve, threshold):
        found = [results.reach([(x(row), value(row, "error")) for row in curve], threshold)
                 for x in (lambda row: value(row, "iterations"), results.after_setup)]
        return "-" if math.isnan(found[0]) else f"{found[0]:.0f}, {found[1]:.2g}"
    body = [cells(curve[0], "model", "vertices:,.0f", lambda row: results.LABELS[row["method"]]) +
            [shown(curve, threshold) for threshold in thresholds]
            for mine in by(rows, "model") for curve in by(mine, "method")]
    return ["model", "V", "method"] + [f"to {t:.0e}: iterations, s" for t in thresholds], body


TABLES = {"models": lines(*MODELS), "harmonic": lines(*HARMONIC), "race": race, "solvers": solvers,
          "authors2014": lines(*AUTHORS2014), "speed": lines(*SPEED), "growth": growth,
          "mesh_deform": lines(*MESH_DEFORM), "many": lines(*MANY), "tolerance": tolerance, "smoothness": grouped(sized, *SMOOTHNESS),
          "cages": lines(*CAGES), "compare": lines(*COMPARE),
          "distortion": lines(*DISTORTION), "pipeline": lines(*PIPELINE), "samples": lines(*SAMPLES),
          "sparsify": grouped(sparsified, *SPARSIFY),
          "table1": lines(*TABLE1),
          "table2": grouped(with_published, *TABLE2),
          "figure3": curves(FIGURE3, "total_seconds", "solve_mebibytes"), "figure5": time_to_error,
          "figure6": time_to_error}

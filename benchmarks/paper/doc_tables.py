# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the pages as header and body, from rows of the CSV files."""

import results
import tables
import use_tables
from cells import brief, formatted

# Tables that are made of another result than that of their own name.
SOURCES = {"harmonic": "models", "solvers": "race"}


def source_of(name):
    """The result, a file in docs/results without .csv, that a table is made of."""
    return SOURCES.get(name, name)


def race(rows):
    """Seconds to the error, in parentheses iterations; a line per model."""
    names = [name for name in results.LABELS if any(r["method"] == name for r in rows)]
    body = []
    for model in results.in_order(r["model"] for r in rows):
        mine = {r["method"]: r for r in rows if r["model"] == model}
        first = next(iter(mine.values()))
        cells = [model, first["control_points"], results.thousands(first["vertices"])]
        for name in names:
            if name not in mine:
                cells.append("-")
                continue
            row = mine[name]
            counted = tables.iterations(dict(row, converged="1"))
            if row["converged"] != "1":
                counted = "not within " + counted
            cells.append(f"{results.value(row, 'total_seconds'):.2f} ({counted})")
        body.append(cells)
    return ["model", "n", "V"] + [f"{results.LABELS[name]}, s" for name in names], body


def table2(rows):
    header = ["model", "method", "iterations", "total, s", "true error", "gap", "smallest weight", "influences"]
    body = []
    last_model = None
    for row in rows:
        title = f"{row['model']}, n = {row['control_points']}, {results.thousands(row['vertices'])} V"
        if row["paper_lbc_error"]:
            title += (f" ({results.value(row, 'paper_lbc_error'):.1e} / "
                      f"{results.value(row, 'paper_flbc_error'):.1e})")
        first = row["model"] != last_model
        last_model = row["model"]
        method = results.LABELS[row["method"]]
        body.append([title if first else "", f"**{method}**" if row["method"] == "value" else method,
                     tables.iterations(row)] +
                    formatted(row, [("total_seconds", ".2f"), ("error", ".1e"),
                                    ("relative_gap", ".1e"), ("min_weight", ".1e"),
                                    ("mean_influences", ".1f")]))
    return header, body


def speed(rows):
    header = ["model", "n", "V", "iterations", "setup + solve = total, s", "true error",
              "harmonic, s", "ratio", "in iterations of the gradient ADMM",
              "in iterations of LBC 2014"]
    body = []
    for row in rows:
        counted = tables.iterations(row)
        if row["iterations_to_wanted"]:
            counted += f" ({row['iterations_to_wanted']})"
        parts = formatted(row, [(c, ".3f") for c in
                                ("setup_seconds", "solve_seconds", "total_seconds")])
        body.append([row["model"], row["control_points"], results.thousands(row["vertices"]),
                     counted, "{} + {} = {}".format(*parts)] +
                    formatted(row, [("error", ".1e"), ("harmonic_seconds", ".3f"),
                                    ("over_harmonic", ".1f"),
                                    ("total_over_gradient_iteration", ".0f"),
                                    ("total_over_lbc2014_iteration", ".0f")]))
    return header, body


def growth(rows):
    header = ["model", "n", "V", "cells", "levels", "iterations", "setup + solve, s", "peak MiB",
              "bytes per cell", "time, memory grow as V to the power"]
    body = []
    for model in results.in_order(row["model"] for row in rows):
        curve = [row for row in rows if row["model"] == model]
        for row in curve:
            parts = formatted(row, [("setup_seconds", ".2f"), ("solve_seconds", ".2f")])
            last = row is curve[-1] and len(curve) > 1
            body.append([model, row["control_points"], results.thousands(row["vertices"]),
                         results.thousands(row["cells"]), str(int(row["coarse_levels"]) + 1),
                         row["iterations"], " + ".join(parts)] +
                        formatted(row, [("peak_mebibytes", ",.0f"), ("bytes_per_cell", ",.0f")]) +
                        [tables.powers(curve, ("total_seconds", "peak_mebibytes")) if last else ""])
    return header, body


def many(rows):
    header = ["cage", "n", "V", "tolerance", "all pairs: iterations, s, MiB",
              "active set: iterations, s, MiB", "pairs", "speedup", "difference"]
    body = []
    for row in rows:
        def run(prefix):
            if not row[prefix + "iterations"]:
                return "-"
            parts = formatted(row, [(prefix + "seconds", ".2f"), (prefix + "mebibytes", ",.0f")])
            return ", ".join([results.thousands(row[prefix + "iterations"])] + parts)
        body.append([row["cage"], row["control_points"], results.thousands(row["vertices"]),
                     f"{results.value(row, 'tolerance'):.0e}", run("all_"), run("")] +
                    formatted(row, [("density", ".1%"), ("times", ".1f"), ("difference", ".1e")]))
    return header, body


def smoothness(rows):
    """A line per model and value; creases only where there is a 3D model."""
    header = ["model", "smoothness", "influences", "jump of gradients", "creases: mean, 99%", "iterations",
              "true error / tolerance", "default solve, s"]
    body = []
    last_model = None
    for row in rows:
        title = f"{row['model']}, n = {row['control_points']}, {results.thousands(row['vertices'])} V"
        first = row["model"] != last_model
        last_model = row["model"]
        creases = (f"{results.value(row, 'crease_mean'):.2f}, {results.value(row, 'crease_high'):.1f}"
                   if row["crease_mean"] else "")
        body.append([title if first else "", row["smoothness"]] +
                    formatted(row, [("mean_influences", ".2f"), ("gradient_jump", ".2f")]) +
                    [creases, tables.iterations(row) if row["iterations"] else ""] +
                    formatted(row, [("error", ".2f"), ("default_seconds", ".2f")]))
    return header, body


def plain(rows):
    """Every column of the file, numbers in three digits."""
    columns = [c for c in rows[0] if any(r[c] for r in rows)]
    return [c.replace("_", " ") for c in columns], [[brief(r[c]) for c in columns] for r in rows]


TABLES = {"race": race, "smoothness": smoothness, "table2": table2, "table1": tables.table1_rows,
          "figure3": tables.growth_rows, "speed": speed,
          "growth": growth, "many": many,
          "figure5": tables.time_to_error_rows, "figure6": tables.time_to_error_rows,
          **use_tables.TABLES}

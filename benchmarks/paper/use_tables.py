# SPDX-License-Identifier: BSD-3-Clause
"""Tables of what a user gets, beyond the paper: header and body, as in doc_tables.py."""

import results
import tables
from cells import brief, formatted


def models(rows):
    header = ["model", "n", "V", "cells", "iterations", "mesh, s", "setup, s", "solve, s",
              "harmonic, s", "MiB", "influences", "harmonic influences",
              "smallest weight", "reproduction error"]
    body = []
    for row in rows:
        body.append([row["model"], row["control_points"], results.thousands(row["vertices"]),
                     results.thousands(row["cells"]), tables.iterations(row)] +
                    formatted(row, [("mesh_seconds", ".2f"), ("setup_seconds", ".2f"),
                                    ("solve_seconds", ".2f"), ("harmonic_seconds", ".2f"),
                                    ("mebibytes", ",.0f"), ("mean_influences", ".1f"),
                                    ("harmonic_influences", ".1f"), ("min_weight", ".1e"),
                                    ("reproduction_error", ".1e")]))
    return header, body


def harmonic(rows):
    """Influences and seconds of local and of harmonic coordinates, from the same rows as models."""
    header = ["Model", "Control points", "Mesh vertices", "Influences: local", "Influences: harmonic",
              "Time: local, s", "Time: harmonic, s"]
    body = []
    for row in rows:
        model = row["model"] + (" (2D)" if row["model"] in results.TWO_DIMENSIONAL else "")
        influences = formatted(row, [("mean_influences", ".1f"), ("harmonic_influences", ".1f")])
        body.append([model, row["control_points"], results.thousands(row["vertices"]),
                     f"**{influences[0]}**", influences[1]] +
                    formatted(row, [("total_seconds", ".2f"), ("harmonic_seconds", ".2f")]))
    return header, body


SOLVERS = {"value": "**libflbc**, default method", "lbc2014-tuned": "2014 splitting, penalty tuned by us",
           "paper": "2019 gradient ADMM, as published"}


def solvers(rows):
    """Seconds to the error, from the same rows as race: a line per method, the best of each model bold."""
    models_shown = results.in_order(row["model"] for row in rows)
    seconds = {(row["method"], row["model"]): f"{results.value(row, 'total_seconds'):.2f}"
               for row in rows if row["converged"] == "1"}
    body = []
    for method, name in SOLVERS.items():
        line = [name]
        for model in models_shown:
            cell = seconds.get((method, model), "not reached")
            best = min((seconds[other, model] for other in SOLVERS if (other, model) in seconds),
                       key=float, default=None)
            line.append(f"**{cell}**" if cell == best else cell)
        body.append(line)
    return ["Seconds to 1e-5"] + models_shown, body


def tolerance(rows):
    """Iterations, in parentheses the true error relative to the tolerance; a line per mesh."""
    wanted = results.in_order(row["tolerance"] for row in rows)
    header = ["model", "V"] + [f"{float(t):.0e}".replace("e-0", "e-") for t in wanted]
    body = []
    for model, vertices in results.in_order((r["model"], r["vertices"]) for r in rows):
        runs = {r["tolerance"]: r for r in rows if (r["model"], r["vertices"]) == (model, vertices)}
        cells = [f"{tables.iterations(runs[t])} ({results.value(runs[t], 'error'):.2f})"
                 if t in runs else "-" for t in wanted]
        body.append([model, results.thousands(vertices)] + cells)
    worst = {t: max(results.value(r, "error") for r in rows if r["tolerance"] == t) for t in wanted}
    return header, body + [["worst", ""] + [f"({worst[t]:.2f})" for t in wanted]]


def cages(rows):
    header = ["model", "vertices", "control points", "outside, crossing", "distance",
              "symmetric across", "s", "`flbc check`", "iterations of the solve", "smallest weight",
              "reproduction error"]
    body = []
    for row in rows:
        solved = (tables.iterations(row) if row["solve"] == "converged" else row["solve"])
        body.append([row["model"] + (", 2D" if row["dim"] == "2" else ""),
                     results.thousands(row["vertices"]), row["control_points"],
                     f"{row['outside']}, {row['crossings']}"] +
                    formatted(row, [("distance", ".1%")]) + [row["symmetric_across"]] +
                    formatted(row, [("processor_seconds", ".2f")]) + [row["check"], solved] +
                    formatted(row, [("min_weight", ".1e"), ("reproduction_error", ".1e")]))
    return header, body


def sparsify(rows):
    """Errors in percent, root mean square (largest); a line per number of influences and method."""
    header = ["weights", "K", "method", "edges, independent", "edges, smooth",
              "positions, independent", "positions, smooth", "edges, positions, animation", "s"]
    body = []
    last = None
    for row in rows:
        title = (f"{row['weights']}, {results.thousands(row['points'])} points, "
                 f"n = {row['control_points']}, {results.value(row, 'influences_before'):.0f} influences before")
        cells = [percent(row, column) + f" ({percent(row, column + '_max')})" for column in
                 ("edges_independent", "edges_smooth", "positions_independent", "positions_smooth")]
        animated = ""
        if row.get("edges_animation"):
            animated = f"{percent(row, 'edges_animation')}, {percent(row, 'positions_animation')}"
        body.append([title if title != last else "", row["k"], row["method"]] + cells + [animated] +
                    formatted(row, [("seconds", ".3f")]))
        last = title
    return header, body


def percent(row, column):
    number = 100 * results.value(row, column)
    return f"{number:,.0f}" if number >= 100 else f"{number:.3g}"


TABLES = {"models": models, "harmonic": harmonic, "solvers": solvers, "tolerance": tolerance, "cages": cages,
          "sparsify": sparsify}

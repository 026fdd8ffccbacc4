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


def editing(rows):
    """A line per move, models side by side."""
    models_shown = results.in_order((row["model"], row["vertices"]) for row in rows)
    header = ["move"]
    for model, vertices in models_shown:
        header += [f"{model}, {results.thousands(vertices)} V: iterations", "s", "error"]
    body = []
    for move in results.in_order(row["move"] for row in rows):
        line = [move.replace(" %", "%")]
        for model, _ in models_shown:
            row = next(r for r in rows if (r["model"], r["move"]) == (model, move))
            if not row["iterations"]:
                line += ["a cell would turn over", "", ""]
                continue
            seconds = formatted(row, [("seconds", ".3f"), ("cold_seconds", ".3f")])
            if row["longest_seconds"]:
                seconds[0] += f" (at most {results.value(row, 'longest_seconds'):.3f})"
            line += [f"{brief(row['iterations'])} / {row['cold_iterations']}", " / ".join(seconds),
                     " / ".join(formatted(row, [("error", ".1e"), ("cold_error", ".1e")]))]
        body.append(line)
    return header, body


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


def repairs(rows):
    header = ["cage", "first defect", "repair", "control points after", "solve"]
    body = []
    for row in rows:
        solve = row["solve"]
        if row["iterations"]:
            solve += f" after {tables.iterations(row)} iterations"
        body.append([row["cage"], row["defect"] or "none", row["repair"] or "none",
                     row["control_points"], solve])
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


def optima(rows):
    header = ["model", "V", "method", "`w >= 0`", "iterations", "objective above",
              "mean squared (largest) difference", "bound below"]
    body = []
    for row in rows:
        squared, largest = formatted(row, [("squared_difference", ".1e"),
                                           ("largest_difference", ".1e")])
        above, below = formatted(row, [("objective_above", ".1e"), ("bound_below", ".1e")])
        body.append([row["model"], results.thousands(row["vertices"]),
                     results.LABELS.get(row["method"], row["method"]), row["non_negative"], tables.iterations(row), above, f"{squared} ({largest})",
                     below])
    return header, body


def openmesh_iterations(rows):
    header = ["mesh", "method", "vertices", "iterations", "arrays, s", "properties, s", "ratio"]
    return header, [[row["mesh"], results.LABELS.get(row["method"], row["method"]), results.thousands(row["vertices"]), row["iterations"]] +
                    formatted(row, [("arrays_seconds", ".3f"), ("properties_seconds", ".3f"),
                                    ("ratio", ".2f")]) for row in rows]


def openmesh_frames(rows):
    """Points of doubles and of floats side by side."""
    header = ["model", "vertices", "user's side", "arrays, ms", "property, ms", "ratio",
              "with points of floats", "cores spinning: mean frame, doubles / floats"]
    body = []
    for model, side in results.in_order((row["model"], row["users_side"]) for row in rows):
        doubles, floats = (next(r for r in rows if (r["model"], r["users_side"], r["points_of"]) ==
                                (model, side, kind)) for kind in ("doubles", "floats"))
        busy = [formatted(row, [("busy_over_quiet", ".1f")])[0] for row in (doubles, floats)]
        body.append([model, results.thousands(doubles["vertices"]), side] +
                    formatted(doubles, [("arrays_ms", ".3f"), ("property_ms", ".3f"),
                                        ("ratio", ".2f")]) +
                    formatted(floats, [("ratio", ".2f")]) + [" / ".join(busy)])
    return header, body


def openmesh_topology(rows):
    header = ["cells", "faces", "TetMesh (faces, edges, all incidences), s", "with validation, s",
              "facets of the solver alone, s", "from the TetMesh, s"]
    return header, [[results.thousands(row["cells"]), results.thousands(row["faces"])] +
                    formatted(row, [("tet_mesh_seconds", ".3f"), ("checked_seconds", ".3f"),
                                    ("facets_seconds", ".3f"), ("domain_seconds", ".3f")])
                    for row in rows]


def percent(row, column):
    number = 100 * results.value(row, column)
    return f"{number:,.0f}" if number >= 100 else f"{number:.3g}"


TABLES = {"models": models, "harmonic": harmonic, "solvers": solvers, "tolerance": tolerance, "editing": editing, "cages": cages,
          "repairs": repairs, "sparsify": sparsify, "optima": optima,
          "openmesh_iterations": openmesh_iterations, "openmesh_frames": openmesh_frames,
          "openmesh_topology": openmesh_topology}

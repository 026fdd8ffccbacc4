# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables as OUT/tables.md, in the shape in which the paper prints them."""

import math

import results

THRESHOLDS = (1e-4, 1e-5, 1e-6)


def write(out):
    """Makes OUT/tables.md of what there is; returns its path, or None if there is no table."""
    parts = [part for part in (table1(out), table2(out), growth(out),
                             time_to_error(out)) if part]
    if not parts:
        return None
    path = out / "tables.md"
    path.write_text("\n".join(parts))
    return path


def text(number, form):
    if number == 0:
        return "0"
    return "-" if math.isnan(number) else format(number, form)


def markdown(title, comments, header, rows):
    lines = [f"## {title}", ""]
    lines += [comment + "  " for comment in comments] + [""]
    lines += ["| " + " | ".join(header) + " |", "|---" * len(header) + "|"]
    lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def table1(out):
    rows, comments = results.read(out, "table1")
    if not rows:
        return None
    return markdown("Table 1: with and without non-negativity", comments, *table1_rows(rows))


def table1_rows(rows):
    """Header and body."""
    header = ["model", "n", "V", "with, s", "without, s", "squared distance", "(paper)",
              "largest difference", "min w without", "gap with", "gap without, made non-negative"]
    form = {"seconds_with": ".2f", "seconds_without": ".2f"}
    columns = ["seconds_with", "seconds_without", "squared_distance", "paper_squared_distance",
               "largest_difference", "min_weight_without", "relative_gap_with",
               "relative_gap_without"]
    body = [[row["model"], row["control_points"], results.thousands(row["vertices"])] +
            [text(results.value(row, c), form.get(c, ".1e")) for c in columns] for row in rows]
    return header, body


def table2(out):
    rows, comments = results.read(out, "table2")
    if not rows:
        return None
    names = {name: label for name, label, _, _ in results.METHODS}
    header = ["model", "n", "V", "method", "iterations", "setup, s", "solve, s", "recover, s",
              "total, s", "error", "paper's error, s", "min w", "gap", "reference's gap"]
    body = []
    for row in rows:
        seconds = [results.value(row, c) for c in
                   ("setup_seconds", "solve_seconds", "recover_seconds", "total_seconds")]
        limit = "" if row["converged"] == "1" else " (limit)"
        body.append([row["model"], row["control_points"], results.thousands(row["vertices"]),
                     names[row["method"]], row["iterations"] + limit] +
                    [text(s, ".3f") for s in seconds] +
                    [text(results.value(row, "error"), ".1e"), papers_numbers(row)] +
                    [text(results.value(row, c), ".1e") for c in
                     ("min_weight", "relative_gap", "reference_gap")])
    return markdown("Table 2: methods at the paper's sizes", comments, header, body)


def growth(out):
    """Figure 3 in numbers: seconds against V, and recovery in iterations."""
    rows, comments = results.read(out, "figure3")
    if not rows:
        return None
    return markdown("Figure 3 in numbers", comments, *growth_rows(rows))


def growth_rows(rows):
    """Header and body."""
    header = ["model", "method", "V", "iterations", "solve, s", "recover, s",
              "recovery in iterations", "total, s", "MiB beyond the problem",
              "time, memory grow as V to the power"]
    body = []
    for model in results.in_order(row["model"] for row in rows):
        for name, label, _, _ in results.METHODS:
            curve = [r for r in rows if r["model"] == model and r["method"] == name]
            for row in curve:
                solve, recover, total, memory = (
                    results.value(row, c) for c in ("solve_seconds", "recover_seconds",
                                                    "total_seconds", "solve_mebibytes"))
                per_iteration = solve / max(1, int(row["iterations"]))
                last = row is curve[-1] and len(curve) > 1
                body.append([model, label, results.thousands(row["vertices"]), iterations(row),
                             text(solve, ".3f"), text(recover, ".3f"),
                             text(recover / per_iteration, ".1f"), text(total, ".3f"),
                             text(memory, ",.0f"),
                             powers(curve, ("total_seconds", "solve_mebibytes")) if last else ""])
    return header, body


def iterations(row):
    """Those on the given mesh, whether they are the limit, and on how many coarser meshes before."""
    parts = [results.thousands(row["iterations"])]
    if row.get("coarse_levels", "0") not in ("", "0"):
        parts.append(f"+ {row['coarse_levels']} level" + "s" * (row["coarse_levels"] != "1"))
    if row.get("converged") == "0":
        parts.append("(limit)")
    return " ".join(parts)


def powers(curve, columns):
    """How the columns grow with the number of vertices."""
    vertices = [results.value(r, "vertices") for r in curve]
    found = [results.exponent(vertices, [results.value(r, c) for r in curve]) for c in columns]
    return ", ".join("-" if power is None else f"{power:.2f}" for power in found)


def papers_numbers(row):
    """What the paper reports for the same method, on its machine; only where it has the method."""
    kind = {"lbc2014": "lbc", "paper": "flbc"}.get(row["method"])
    if kind is None or not row["paper_lbc_error"]:
        return ""
    error, seconds = (results.value(row, f"paper_{kind}_{what}") for what in ("error", "seconds"))
    return f"{error:.1e}, {seconds:.1f}"


def reach(rows, threshold, column):
    """Where the error first falls to the threshold, between the measured points by logarithms."""
    previous = None
    for row in rows:
        error, x = results.value(row, "error"), results.value(row, column)
        if error <= threshold:
            if previous is None:
                return x
            t = math.log(previous[0] / threshold) / math.log(previous[0] / error)
            return previous[1] * (x / previous[1]) ** t
        previous = (error, x)
    return math.nan


def time_to_error(out):
    body, comments = [], []
    for figure in ("figure5", "figure6"):
        rows, notes = results.read(out, figure)
        if not rows:
            continue
        comments = notes[1:]
        header, lines = time_to_error_rows(rows)
        body += [[figure[-1]] + line for line in lines]
    if not body:
        return None
    comments = ["From the curves of figures 5 and 6, interpolated between their points; seconds of "
                "solve and recovery."] + comments
    return markdown("Iterations and seconds to an error", comments, ["figure"] + header, body)


def time_to_error_rows(rows):
    """Header and body, of one figure."""
    header = ["model", "V", "method"]
    header += [f"to {threshold:.0e}: iterations, s" for threshold in THRESHOLDS]
    body = []
    for model in results.in_order(row["model"] for row in rows):
        for name, label, _, _ in results.METHODS:
            curve = [dict(r, time=str(after_setup(r))) for r in rows
                     if r["model"] == model and r["method"] == name]
            if not curve:
                continue
            cells = []
            for threshold in THRESHOLDS:
                iterations = reach(curve, threshold, "iterations")
                seconds = reach(curve, threshold, "time")
                cells.append("-" if math.isnan(iterations) else
                             f"{iterations:.0f}, {seconds:.2g}")
            body.append([model, results.thousands(curve[0]["vertices"]), label] + cells)
    return header, body


def after_setup(row):
    """Seconds of solve and recovery: the setup before is the same for all methods."""
    return results.value(row, "solve_seconds") + results.value(row, "recover_seconds")

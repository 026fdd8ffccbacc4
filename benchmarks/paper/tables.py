# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the pages as header and body, from rows of the CSV files."""

import results
from results import by, cells, thousands, value

# Tables that are made of another result than that of their own name.
SOURCES = {"harmonic": "models"}


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


SIZE = [("model", "model"), ("n", "control_points"), ("V", "vertices:,.0f")]
IN_2D = ("logo", "woody", "cactus", "figure", "letter", "ring")
HARMONIC = [("Model", lambda row: row["model"] + " (2D)" * (row["model"] in IN_2D)),
            ("Control points", "control_points"), ("Mesh vertices", "vertices:,.0f"),
            ("Local, s", "total_seconds:.2f"), ("Harmonic, s", "harmonic_seconds:.2f")]
MODELS = [*SIZE, ("cells", "cells:,.0f"), ("mesh, s", "mesh_seconds:.2f"),
          ("setup, s", "setup_seconds:.2f"), ("solve, s", "solve_seconds:.2f"),
          ("harmonic, s", "harmonic_seconds:.2f"), ("MiB", "peak_mebibytes:,.0f"),
          ("reproduction error", "reproduction_error:.1e")]
TABLE1 = [*SIZE, ("squared distance", "squared_distance:.1e"), ("(paper)", "paper_squared_distance:.1e"),
          ("largest difference", "largest_difference:.1e"), ("smallest weight without", "min_weight_without:.1e")]
def with_published(row):
    published = cells(row, "paper_lbc_error:.1e", "paper_flbc_error:.1e")
    return sized(row) + (f" ({' / '.join(published)})" if row["paper_lbc_error"] else "")


def method(row):
    label = results.LABELS[row["method"]]
    return f"**{label}**" if row["method"] == "weights" else label


TABLE2 = [("method", method), ("iterations", iterations), ("total, s", "total_seconds:.2f"),
          ("true error", "error:.1e"), ("smallest weight", "min_weight:.1e")]


def table2(rows):
    """The models and methods of the paper, and the default method."""
    compared = ("lbc2014", "paper", "weights")
    return grouped(with_published, *TABLE2)(
        [row for row in rows if row["method"] in compared and row["paper_flbc_error"]])


SAMPLES = [*HARMONIC[:4], *((f"To 1e-5: {label}, s", f"to_1e-5_{name}:.2f") for name, label in (
    ("weights", "local"), ("lbc2014-tuned", "2014, tuned penalty"), ("paper", "2019")))]
SPEED = [*SIZE, ("cells", "cells:,.0f"), ("time, s", "total_seconds:.2f"),
         ("true error", "error:.1e"), ("harmonic, s", "harmonic_seconds:.2f"), ("MiB", "peak_mebibytes:,.0f")]


def race(rows):
    """Seconds to the error; a line per model."""
    names = [name for name in results.LABELS if any(r["method"] == name for r in rows)]

    def shown(row):
        return f"{value(row, 'total_seconds'):.2f}" + " (not reached)" * (row["converged"] != "1")
    body = []
    for mine in by(rows, "model"):
        run = {row["method"]: row for row in mine}
        body.append(cells(mine[0], *(kind for _, kind in SIZE)) +
                    [shown(run[name]) if name in run else "-" for name in names])
    return [header for header, _ in SIZE] + [f"{results.LABELS[name]}, s" for name in names], body


INFLUENCES = [("Model", lambda row: row["model"] + " (2D)" * (row["model"] in IN_2D)), ("Control points", "control_points"),
              ("Model vertices", "points:,.0f"), ("Local", "local:.1f"), ("largest", "local_max"),
              ("Local, reduced to 8", "reduced:.1f"), ("Harmonic", "harmonic:.1f"), ("largest", "harmonic_max")]


def gaps(rows):
    """Percent proven at each tolerance; a line per model."""
    tolerances = results.in_order(row["tolerance"] for row in rows)
    body = [[mine[0]["model"], *(f"{value(row, 'gap'):.2g}%" for row in mine)] for mine in by(rows, "model")]
    return ["model", *tolerances], body


COMPARE = [("coordinates", "coordinates"), ("influences", "influences:.1f"), ("reach", "reach:.1%"), ("smallest weight", "min_weight:.1e"),
           ("distortion", "distortion:.3f"), ("time, s", lambda row: f"{value(row, 'setup_seconds') + value(row, 'solve_seconds'):.2f}")]


def compare(rows):
    """The kinds of coordinates on the horse."""
    return lines(*COMPARE)([row for row in rows if row["model"] == "horse"])


TABLES = {"compare": compare, "influences": lines(*INFLUENCES), "gaps": gaps, "models": lines(*MODELS), "harmonic": lines(*HARMONIC), "race": race, "speed": lines(*SPEED),
          "samples": lines(*SAMPLES), "table1": lines(*TABLE1), "table2": table2}

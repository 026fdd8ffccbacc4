# SPDX-License-Identifier: BSD-3-Clause
"""The tables of the pages as header and body, from rows of the CSV files."""

import math

import results
from results import by, cells, ratio, text, thousands, value

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
            ("Influences: local", lambda row: f"**{value(row, 'mean_influences'):.1f}**"),
            ("Influences: harmonic", "harmonic_influences:.1f"),
            ("Time: local, s", "total_seconds:.2f"), ("Time: harmonic, s", "harmonic_seconds:.2f")]
MODELS = [*SIZE, ("cells", "cells:,.0f"), ("mesh, s", "mesh_seconds:.2f"),
          ("setup, s", "setup_seconds:.2f"), ("solve, s", "solve_seconds:.2f"),
          ("harmonic, s", "harmonic_seconds:.2f"), ("MiB", "peak_mebibytes:,.0f"),
          ("reproduction error", "reproduction_error:.1e")]
TABLE1 = [*SIZE, ("squared distance", "squared_distance:.1e"), ("(paper)", "paper_squared_distance:.1e"),
          ("largest difference", "largest_difference:.1e"), ("smallest weight without", "min_weight_without:.1e")]
CAGES = [("model", lambda row: row["model"] + (", 2D" if row["dim"] == "2" else "")), ("vertices", "vertices:,.0f"),
         ("control points", "control_points"),
         ("distance", "distance:.1%"), ("symmetric across", "symmetric_across"), ("s", "processor_seconds:.2f")]


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


def creases(row):
    return f"{value(row, 'crease_mean'):.2f}, {value(row, 'crease_high'):.1f}" if row["crease_mean"] else ""


SMOOTHNESS = [("smoothness", "smoothness"), ("influences", "mean_influences:.2f"),
              ("jump of gradients", "gradient_jump:.2f"), ("creases: mean, 99%", creases),
              ("iterations", lambda row: iterations(row) if row["iterations"] else "")]


def smoothness(rows):
    """One model in 2D, and two in 3D of few and many control points."""
    kept = ("0", "0.003", "harmonic")
    return grouped(sized, *SMOOTHNESS)([row for row in rows if row["model"] in ("woody", "horse", "armadillo")
                                        and row["smoothness"] in kept])


SAMPLES = [*HARMONIC[:4], HARMONIC[5], *((f"To 1e-5: {label}, s", f"to_1e-5_{name}:.2f") for name, label in (
    ("weights", "local"), ("lbc2014-tuned", "2014, tuned penalty"), ("paper", "2019")))]
COMPARE = [("coordinates", "coordinates"), ("influences", "influences:.1f"),
           ("reach", "reach:.1%"), ("smallest weight", "min_weight:.1e"), ("distortion", "distortion:.3f"),
           ("time, s", lambda row: text(value(row, "setup_seconds") + value(row, "solve_seconds"), ".2f"))]
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


AUTHORS2014 = [SIZE[0], ("authors' program, s", "lbc_seconds:.2f"), ("libflbc, s", "flbc_seconds:.2f"),
               ("ratio", "lbc_over_flbc:.0f")]


def tolerance(rows):
    """The largest true error relative to the tolerance; a line per model."""
    wanted = results.in_order(row["tolerance"] for row in rows)

    def line(title, mine):
        worst = [[value(r, "error") for r in mine if r["tolerance"] == t] for t in wanted]
        return [title] + [f"{max(errors):.2f}" if errors else "-" for errors in worst]
    return (["model"] + [f"{float(t):.0e}".replace("e-0", "e-") for t in wanted],
            [line(mine[0]["model"], mine) for mine in by(rows, "model")] + [line("**worst**", rows)])


def many_run(prefix):
    """The cell of a run on the active set, or with a prefix on all pairs."""
    return lambda row: ", ".join(cells(row, f"{prefix}iterations:,.0f", f"{prefix}seconds:.2f",
                                       f"{prefix}mebibytes:,.0f")) if row[prefix + "iterations"] else "-"


MANY = [("cage", "cage"), ("n", "control_points"), ("V", "vertices:,.0f"), ("tolerance", "tolerance:.0e"),
        ("all pairs: iterations, s, MiB", many_run("all_")), ("active set: iterations, s, MiB", many_run("")),
        ("speedup", lambda row: text(ratio(row, "all_seconds", "seconds"), ".1f"))]


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


SPARSIFY = [("K", "k"), ("method", "method"), ("edges", error("edges_smooth")),
            ("positions", error("positions_smooth")), ("animation: edges, positions", animated),
            ("s", "seconds:.3f")]


def sparsify(rows):
    """4 and 8 influences, without the weights of another scheme."""
    return grouped(sparsified, *SPARSIFY)([row for row in rows if row["k"] != "6" and "another" not in row["weights"]])


MESH_ERROR = [("model", "model"),
              *((f"mesh of {thousands(number)}", f"mesh_{number}") for number in (5000, 10000, 20000)),
              *((f"iteration, tolerance {t}", f"iteration_{t}") for t in ("1e-5", "1e-6", "1e-7"))]
BLENDER = [("deformer", "deformer"), ("bind, s", "bind_seconds"), ("frame, ms", "frame_milliseconds"),
           ("error of an affine map", "affine_error")]
POINTS = [("step, one core", "step"), ("million points per second", "million_per_second")]


def compare(rows):
    """One model. Local coordinates have the default smoothness."""
    rows = [row for row in rows if row["model"] == rows[0]["model"]]
    names = {row["coordinates"] for row in rows}
    kept = [row for row in rows if row["coordinates"] != "local" or "local_smooth" not in names]
    return lines(*COMPARE)([dict(row, coordinates=row["coordinates"].removesuffix("_smooth")) for row in kept])


TABLES = {"models": lines(*MODELS), "harmonic": lines(*HARMONIC), "race": race,
          "authors2014": lines(*AUTHORS2014), "speed": lines(*SPEED), "mesh_deform": lines(*MESH_DEFORM),
          "many": lines(*MANY), "tolerance": tolerance, "smoothness": smoothness, "cages": lines(*CAGES),
          "compare": compare, "sparsify": sparsify,
          "pipeline": lines(*PIPELINE),
          "samples": lines(*SAMPLES), "mesh_error": lines(*MESH_ERROR), "blender": lines(*BLENDER),
          "points": lines(*POINTS), "table1": lines(*TABLE1), "table2": table2}

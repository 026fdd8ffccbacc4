# SPDX-License-Identifier: BSD-3-Clause
"""Measurements and comparisons in the sentences of the pages, computed from the CSV files. A name begins with its file."""

import math

import results
from results import ratio, thousands, value
from tables import IN_2D


def short(number):
    """Two digits, three from 100 on."""
    digits = 2 if abs(number) < 100 else 3
    return f"{float(f'{number:.{digits}g}'):,g}"


def factor(number):
    return f"{number:.1f}" if number < 10 else f"{number:.0f}"


def span(numbers, form=short):
    known = [number for number in numbers if not math.isnan(number)]
    return f"{form(min(known))} to {form(max(known))}"


def of_method(rows, name):
    return {row["model"]: row for row in rows if row["method"] == name}


def against_default(name):
    """Time of a method relative to that of the default one, where both reach the error."""
    def measure(rows):
        mine, default = of_method(rows, name), of_method(rows, "weights")
        return span((value(mine[model], "total_seconds") / value(default[model], "total_seconds")
                     for model in mine if mine[model]["converged"] == "1"), factor)
    return measure


def powers(column):
    """With which powers of the vertices a column grows, for the models on several meshes."""
    def measure(rows):
        curves = [mine for mine in results.by(rows, "model") if len(mine) > 1]
        found = [results.exponent([value(r, "vertices") for r in mine], [value(r, column) for r in mine])
                 for mine in curves]
        return " to ".join(dict.fromkeys(f"{power:.2f}" for power in (min(found), max(found))))
    return measure


def listed(names):
    """"a, b, and c"."""
    names = list(names)
    return ", ".join(names[:-1]) + "," * (len(names) > 2) + " and " * (len(names) > 1) + names[-1]


def with_mesh(row):
    """Time of the default method relative to harmonic coordinates, both with the mesh."""
    mesh = value(row, "mesh_seconds")
    return (value(row, "total_seconds") + mesh) / (value(row, "harmonic_seconds") + mesh)


def slower(pairs):
    """The models, and the largest ratio, where the second time of a pair is longer than the first."""
    found = {model: mine / other for model, other, mine in pairs if mine > other}
    return f"{listed(found)} (by up to {100 * (max(found.values()) - 1):.0f}%)"


def race_slower(rows):
    tuned, default = of_method(rows, "lbc2014-tuned"), of_method(rows, "weights")
    return slower((model, value(tuned[model], "total_seconds"), value(default[model], "total_seconds"))
                  for model in tuned)


def samples_slower(rows):
    return slower((row["model"], value(row, "to_1e-5_lbc2014-tuned"), value(row, "to_1e-5_weights")) for row in rows)


def in_space(rows):
    return [row for row in rows if row["model"] not in IN_2D]


def negative(rows):
    """On how many of the models in 3D the optimum without the constraint is negative."""
    mine = in_space(rows)
    return f"{sum(value(row, 'min_weight_without') < -1e-4 for row in mine)} of {len(mine)}"


def reproduced(rows):
    """The models on which FLBC 2019 stops within a factor of 2 of the published error."""
    mine = {model: ratio(row, "error", "paper_flbc_error") for model, row in of_method(rows, "paper").items()}
    return listed(model for model, times in mine.items() if 0.5 <= times <= 2)


def more_accurate(rows):
    """The models of the paper on which FLBC 2019 stops at a smaller error than LBC 2014."""
    flbc, lbc = of_method(rows, "paper"), of_method(rows, "lbc2014")
    return listed(model for model in flbc if flbc[model]["paper_flbc_error"]
                  and value(flbc[model], "error") < value(lbc[model], "error"))


FALSE = "no longer true: "


def claim(text, holds):
    """A statement that compares, which is on a page while it holds."""
    return lambda rows: text if holds(rows) else FALSE + text


def named(rows, group, key, column):
    """A cell of the rows of each group, by another cell."""
    return [{row[key]: value(row, column) for row in mine} for mine in results.by(rows, group)]


def tighter(rows):
    """Whether every gap is smaller than that at the tolerance before."""
    gaps = [[value(row, "gap") for row in mine] for mine in results.by(rows, "model")]
    return all(before > after for mine in gaps for before, after in zip(mine, mine[1:]))


def few(rows, column, method="poisson"):
    """A column of reductions to 8 influences."""
    return {row["weights"]: value(row, column) for row in rows
            if row["k"] == "8" and row["method"] == method and "another" not in row["weights"]}


def seconds_to(error, rows, method):
    """The first time at which a method is below an error; infinite without one."""
    return min((value(row, "total_seconds") for row in rows
                if row["method"] == method and value(row, "error") <= error), default=math.inf)


def later(rows):
    """Whether FLBC 2019 reaches every error of 1e-3 or less that LBC 2014 has reached later, on each model."""
    return all(seconds_to(error, mine, "paper") > seconds_to(error, mine, "lbc2014")
               for mine in results.by(rows, "model")
               for error in [1e-3, *(value(r, "error") for r in mine if r["method"] == "lbc2014" and value(r, "error") < 1e-3)])


def published_penalty(rows):
    """Time of LBC 2014 to 1e-5 relative to that of the default method on woody."""
    mine = [row for row in rows if row["model"] == "woody"]
    return f"{seconds_to(1e-5, mine, 'lbc2014') / seconds_to(1e-5, mine, 'weights'):.0f}"


def unreached(rows):
    """The runs of the default method that end by the limit of iterations."""
    return listed(f"{row['model']} with {thousands(round(value(row, 'vertices'), -3))} vertices" for row in rows
                  if row["method"] == "weights" and row["converged"] != "1")


def of_flbc(measure):
    return lambda rows: measure([row for row in rows if row["method"] == "paper"])


def large(rows):
    return max(rows, key=lambda row: value(row, "vertices"))


def less_creased(rows):
    """Whether both measures of creases beyond those of harmonic coordinates shrink from smoothness 0 to 0.003."""
    return all(abs(mine["0.003"] - mine["harmonic"]) < mine["0"] - mine["harmonic"]
               for column in ("crease_mean", "crease_high") for mine in named(rows, "model", "smoothness", column)
               if not math.isnan(mine["0"]))


def million(rows):
    """The run on the mesh of about a million tetrahedra."""
    return min((row for row in rows if row["model"] == "horse"), key=lambda row: abs(value(row, "cells") - 1e6))


def smallest(rows, model):
    return min((row for row in rows if row["model"] == model), key=lambda row: value(row, "vertices"))


CLAIMS = {
    "influences.fewer": claim("fewer influences", lambda rows: all(
        value(r, column) < value(r, "harmonic") for r in rows for column in ("local", "reduced"))),
    "table1.reproduced": claim("reproduced on woody and cactus", lambda rows: all(
        value(r, "squared_distance") <= value(r, "paper_squared_distance") for r in rows if r["model"] in ("woody", "cactus"))),
    "gaps.tighter": claim("tightens with each smaller tolerance", tighter),
    "sparsify.edges": claim("makes errors of edges smaller than `quadratic`", lambda rows: all(
        few(rows, column)[name] < other for column in ("edges_smooth", "edges_independent")
        for name, other in few(rows, column, "quadratic").items())),
    "smoothness.creases": claim("exceed those of harmonic coordinates less at 0.003 than at 0", less_creased),
    "compare.distortion": claim("distort posed models no more than harmonic ones", lambda rows: all(
        mine["local"] <= mine["harmonic"] for mine in named(rows, "model", "coordinates", "distortion"))),
    "compare.bbw.reach": claim("the reach of bbw is even smaller", lambda rows: all(
        mine["bbw"] < mine["local"] for mine in named(rows, "model", "coordinates", "reach"))),
    "compare.bbw.distortion": claim("distort posed models more than local coordinates", lambda rows: all(
        mine["bbw"] > mine["local"] for mine in named(rows, "model", "coordinates", "distortion"))),
    "figure5.later": claim("not to errors of 1e-3 or less", later),
    "figure6.later": claim("not on larger meshes", later),
}
NUMBERS = {
    **CLAIMS,
    "race.seconds.weights": lambda rows: span(
        (value(r, "total_seconds") for r in rows if r["method"] == "weights"), lambda seconds: f"{seconds:.2f}"),
    **{f"race.ratio.{name}": against_default(name) for name in ("lbc2014-tuned", "gradient", "paper")},
    "race.slower": race_slower,
    "samples.slower": samples_slower,
    "race.gap": lambda rows: f"{max(value(r, 'reference_gap') for r in rows):.1e}",
    "influences.local": lambda rows: span((value(r, "local") for r in rows), factor),
    "influences.harmonic": lambda rows: span((value(r, "harmonic") for r in rows), factor),
    "influences.share": lambda rows: span((100 * ratio(r, "local", "harmonic") for r in rows), factor),
    "gaps.default": lambda rows: short(max(value(r, "gap") for r in rows if r["tolerance"] == "1e-8")),
    "models.horse.vertices": lambda rows: thousands(smallest(rows, "horse")["vertices"]),
    "models.horse.seconds": lambda rows: short(value(smallest(rows, "horse"), "total_seconds")),
    "models.ratio.bind": lambda rows: span(map(with_mesh, rows), factor),
    "models.ratio": lambda rows: span((ratio(r, "total_seconds", "harmonic_seconds") for r in rows), factor),
    "speed.million.vertices": lambda rows: thousands(million(rows)["vertices"]),
    "speed.million.mebibytes": lambda rows: f"{value(million(rows), 'peak_mebibytes'):,.0f}",
    "speed.ratio": lambda rows: span((ratio(r, "total_seconds", "harmonic_seconds") for r in rows), factor),
    "speed.power.seconds": powers("total_seconds"),
    "speed.power.mebibytes": powers("peak_mebibytes"),
    "table1.plane": lambda rows: f"{max(value(r, 'squared_distance') for r in rows if r['model'] in IN_2D):.1e}",
    "table1.gaps": lambda rows: f"{max(value(r, column) for r in rows for column in ('relative_gap_with', 'relative_gap_without')):.1e}",
    "table1.negative": negative,
    "table2.reproduced": reproduced,
    "table2.more_accurate": more_accurate,
    "tolerance.most": lambda rows: f"{max(value(r, 'error') for r in rows if value(r, 'tolerance') > 5e-8):.2f}",
    "tolerance.worst": lambda rows: f"{max(value(r, 'error') for r in rows):.2f}",
    "many.large.vertices": lambda rows: thousands(large(rows)["vertices"]),
    "many.large.seconds": lambda rows: short(value(large(rows), "seconds")),
    "many.speedup": lambda rows: short(max(ratio(r, "all_seconds", "seconds") for r in rows if r["all_seconds"])),
    "pipeline.seconds": lambda rows: span((value(r, "total") for r in rows), factor),
    "pipeline.bind": lambda rows: factor(sum(value(rows[0], step) for step in ("mesh", "solve", "sparsify"))),
    "sparsify.8": lambda rows: short(100 * max(few(rows, "positions_smooth").values())),
    "sparsify.positions": lambda rows: factor(100 * max(
        few(rows, column)[name] / other - 1 for column in ("positions_smooth", "positions_independent")
        for name, other in few(rows, column, "quadratic").items())),
    "cages.defects": lambda rows: str(sum(int(r["outside"]) + int(r["crossings"]) + (r["check"] != "sound") +
                                         (r["solve"] != "converged") for r in rows)),
    "cages.distance": lambda rows: span((100 * value(r, "distance") for r in rows), factor),
    "cages.seconds": lambda rows: span((value(r, "processor_seconds") for r in rows), "{:.2f}".format),
    "smoothness.influences": lambda rows: span(
        (100 * (mine["0.003"] / mine["0"] - 1) for mine in named(rows, "model", "smoothness", "mean_influences")),
        "{:.0f}".format),
    "smoothness.iterations": lambda rows: span(
        (mine["0"] / mine["0.003"] for mine in named(rows, "model", "smoothness", "iterations")), factor),
    "compare.harmonic.min": lambda rows: f"{min(value(r, 'min_weight') for r in rows if r['coordinates'] == 'harmonic'):.1e}",
    "figure3.power.seconds": of_flbc(powers("total_seconds")),
    "figure3.power.mebibytes": of_flbc(powers("solve_mebibytes")),
    "figure3.limit": unreached,
    "figure5.woody.published": published_penalty,
}


def source_of(name):
    """The result, a file in docs/results without .csv, that a measurement is made of."""
    return name.partition(".")[0]


def text(folder, name):
    """The measurement as the pages print it."""
    rows, _ = results.read(folder, source_of(name))
    return NUMBERS[name](rows)

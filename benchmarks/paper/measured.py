# SPDX-License-Identifier: BSD-3-Clause
"""Measurements in the sentences of the pages, computed from the CSV files. A name begins with its file."""

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


def million(rows):
    """The run on the mesh of about a million tetrahedra."""
    return min((row for row in rows if row["model"] == "horse"), key=lambda row: abs(value(row, "cells") - 1e6))


def smallest(rows, model):
    return min((row for row in rows if row["model"] == model), key=lambda row: value(row, "vertices"))


def published(model):
    """The error of FLBC 2019 relative to that of the paper."""
    return lambda rows: short(ratio(of_method(rows, "paper")[model], "error", "paper_flbc_error"))


NUMBERS = {
    "race.seconds.weights": lambda rows: span(
        (value(r, "total_seconds") for r in rows if r["method"] == "weights"), lambda seconds: f"{seconds:.2f}"),
    **{f"race.ratio.{name}": against_default(name) for name in ("lbc2014-tuned", "gradient", "paper")},
    "race.slower": race_slower,
    "samples.slower": samples_slower,
    "race.gap": lambda rows: f"{max(value(r, 'reference_gap') for r in rows):.1e}",
    "influences.local": lambda rows: span((value(r, "local") for r in rows), factor),
    "influences.harmonic": lambda rows: span((value(r, "harmonic") for r in rows), factor),
    "influences.share": lambda rows: span((100 * ratio(r, "local", "harmonic") for r in rows), factor),
    "influences.max": lambda rows: span((value(r, "local_max") for r in rows), factor),
    "gaps.default": lambda rows: span((value(r, "gap") for r in rows if r["tolerance"] == "1e-6"), factor),
    "models.horse.vertices": lambda rows: thousands(smallest(rows, "horse")["vertices"]),
    "models.horse.seconds": lambda rows: short(value(smallest(rows, "horse"), "total_seconds")),
    "models.influences": lambda rows: span((value(r, "mean_influences") for r in rows), factor),
    "models.influences.harmonic": lambda rows: span((value(r, "harmonic_influences") for r in rows), factor),
    "models.ratio.bind": lambda rows: span(map(with_mesh, rows), factor),
    "models.ratio": lambda rows: span((ratio(r, "total_seconds", "harmonic_seconds") for r in rows), factor),
    "speed.million.vertices": lambda rows: thousands(million(rows)["vertices"]),
    "speed.million.mebibytes": lambda rows: f"{value(million(rows), 'peak_mebibytes'):,.0f}",
    "speed.ratio": lambda rows: span((ratio(r, "total_seconds", "harmonic_seconds") for r in rows), factor),
    "speed.power.seconds": powers("total_seconds"),
    "speed.power.mebibytes": powers("peak_mebibytes"),
    "table1.plane": lambda rows: f"{max(value(r, 'squared_distance') for r in rows if r['model'] in IN_2D):.1e}",
    "table1.negative": negative,
    "table2.reproduced": reproduced,
    "table2.more_accurate": more_accurate,
    **{f"table1.min.{model}": lambda rows, model=model: f"{value(smallest(rows, model), 'min_weight_without'):.1e}"
       for model in ("horse", "armadillo", "shark", "beast")},
    **{f"table2.published.{model}": published(model) for model in ("logo", "woody", "cactus", "horse", "armadillo")},
}


def source_of(name):
    """The result, a file in docs/results without .csv, that a measurement is made of."""
    return name.partition(".")[0]


def text(folder, name):
    """The measurement as the pages print it."""
    rows, _ = results.read(folder, source_of(name))
    return NUMBERS[name](rows)

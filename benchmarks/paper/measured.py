# SPDX-License-Identifier: BSD-3-Clause
"""Measurements in the sentences of the pages, computed from the CSV files. A name begins with its file."""

import math

import results
from results import ratio, thousands, value


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
        return span((results.exponent([value(r, "vertices") for r in mine], [value(r, column) for r in mine])
                     for mine in curves), lambda power: f"{power:.2f}")
    return measure


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
    "race.gap": lambda rows: f"{max(value(r, 'reference_gap') for r in rows):.1e}",
    "models.horse.vertices": lambda rows: thousands(smallest(rows, "horse")["vertices"]),
    "models.horse.seconds": lambda rows: short(value(smallest(rows, "horse"), "total_seconds")),
    "models.influences": lambda rows: span((value(r, "mean_influences") for r in rows), factor),
    "models.influences.harmonic": lambda rows: span((value(r, "harmonic_influences") for r in rows), factor),
    "models.ratio": lambda rows: span((ratio(r, "total_seconds", "harmonic_seconds") for r in rows), factor),
    "speed.million.vertices": lambda rows: thousands(million(rows)["vertices"]),
    "speed.million.mebibytes": lambda rows: f"{value(million(rows), 'peak_mebibytes'):,.0f}",
    "speed.ratio": lambda rows: span((ratio(r, "total_seconds", "harmonic_seconds") for r in rows), factor),
    "speed.power.seconds": powers("total_seconds"),
    "speed.power.mebibytes": powers("peak_mebibytes"),
    "table1.plane": lambda rows: f"{max(value(r, 'squared_distance') for r in rows if value(r, 'vertices') > 7e3):.1e}",
    **{f"table1.min.{model}": lambda rows, model=model: f"{value(smallest(rows, model), 'min_weight_without'):.1e}"
       for model in ("shark", "armadillo", "beast")},
    **{f"table2.published.{model}": published(model) for model in ("logo", "woody", "cactus", "horse", "armadillo")},
}


def source_of(name):
    """The result, a file in docs/results without .csv, that a measurement is made of."""
    return name.partition(".")[0]


def text(folder, name):
    """The measurement as the pages print it."""
    rows, _ = results.read(folder, source_of(name))
    return NUMBERS[name](rows)

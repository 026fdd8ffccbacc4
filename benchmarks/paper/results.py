# SPDX-License-Identifier: BSD-3-Clause
"""Reading the CSV files that flbc_bench_paper writes."""

import csv
import math

# Methods in the order of the tables: name in the files, name for readers, colour, marker.
METHODS = [
    ("lbc2014", "LBC 2014, penalty 10", "#9a9a9a", "s"),
    ("lbc2014-tuned", "LBC 2014, tuned penalty", "#3b3b3b", "D"),
    ("paper", "FLBC 2019", "#e08214", "^"),
    ("gradient", "gradient ADMM", "#2c7fb8", "v"),
    ("gradient-local", "gradient ADMM, no linear system", "#8856a7", "P"),
    ("value", "default", "#1b9e4b", "o"),
]


LABELS = {name: label for name, label, _, _ in METHODS}
TWO_DIMENSIONAL = ("logo", "woody", "cactus")


def read(out, name):
    """Rows of OUT/name.csv as dictionaries, and its comments; (None, []) if it is not there."""
    path = out / f"{name}.csv"
    if not path.exists():
        return None, []
    with path.open(newline="") as file:
        lines = file.read().splitlines()
    comments = [line[1:].strip() for line in lines if line.startswith("#")]
    return list(csv.DictReader(line for line in lines if not line.startswith("#"))), comments


def value(row, column):
    """A cell as a number; not-a-number if it is empty."""
    return float(row[column]) if row[column] else math.nan


def in_order(names):
    """Without repetition, in order of first appearance."""
    return list(dict.fromkeys(names))


def thousands(number):
    return f"{int(number):,}"


def exponent(x, y):
    """Slope of the least-squares line through the logarithms; None for fewer than two points."""
    points = [(math.log(a), math.log(b)) for a, b in zip(x, y) if a > 0 and b > 0]
    if len(points) < 2:
        return None
    mean_x, mean_y = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    return (sum((a - mean_x) * (b - mean_y) for a, b in points) /
            sum((a - mean_x) ** 2 for a, _ in points))

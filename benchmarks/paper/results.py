# SPDX-License-Identifier: BSD-3-Clause
"""Reading the CSV files that flbc_bench_paper writes, and formatting their cells."""

import csv
import math

# Methods in the order of the tables: name in the files, name for readers, colour, marker.
METHODS = [
    ("lbc2014", "LBC 2014, penalty 10", "#9a9a9a", "s"),
    ("lbc2014-tuned", "LBC 2014, tuned penalty", "#3b3b3b", "D"),
    ("paper", "FLBC 2019", "#e08214", "^"),
    ("gradient", "gradient ADMM", "#2c7fb8", "v"),
    ("gradient-local", "gradient ADMM, no linear system", "#8856a7", "P"),
    ("weights", "default", "#1b9e4b", "o"),
]
LABELS = {name: label for name, label, _, _ in METHODS}


def read(out, name):
    """Rows of OUT/name.csv as dictionaries, and its comments; (None, []) if it is not there."""
    path = out / f"{name}.csv"
    if not path.exists():
        return None, []
    with path.open(newline="") as file:
        lines = file.read().splitlines()
    comments = [line[1:].strip() for line in lines if line.startswith("#")]
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    return [renamed(row) for row in rows], comments


def renamed(row):
    """A row with the names of today: the method weights was called value in 0.1."""
    row = {column.replace("to_1e-5_value", "to_1e-5_weights"): cell for column, cell in row.items()}
    if row.get("method") == "value":
        row["method"] = "weights"
    return row


def value(row, column):
    """A cell as a number; not-a-number if it is empty or not there."""
    return float(row.get(column) or math.nan)


def ratio(row, column, other):
    return value(row, column) / value(row, other)


def text(number, form):
    if number == 0:
        return "0"
    return "-" if math.isnan(number) else format(number, form)


def cell(row, kind):
    """Kind: a column, a column with a format as in 'error:.1e', or a function of the row."""
    if callable(kind):
        return kind(row)
    column, _, form = kind.partition(":")
    return text(value(row, column), form) if form else row[column]


def cells(row, *kinds):
    return [cell(row, kind) for kind in kinds]


def thousands(number):
    return f"{int(number):,}"


def in_order(names):
    """Without repetition, in order of first appearance."""
    return list(dict.fromkeys(names))


def by(rows, column):
    """Lists of the rows that have the same cell."""
    return [[row for row in rows if row[column] == name] for name in in_order(row[column] for row in rows)]


def exponent(x, y):
    """Slope of the least-squares line through the logarithms; None for fewer than two points."""
    points = [(math.log(a), math.log(b)) for a, b in zip(x, y) if a > 0 and b > 0]
    if len(points) < 2:
        return None
    mean_x, mean_y = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    return (sum((a - mean_x) * (b - mean_y) for a, b in points) /
            sum((a - mean_x) ** 2 for a, _ in points))

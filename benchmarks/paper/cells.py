# SPDX-License-Identifier: BSD-3-Clause
"""Cells of the tables of the pages."""

import results
import tables


def formatted(row, columns):
    """Cells of the given columns, each with its format."""
    return [tables.text(results.value(row, column), form) for column, form in columns]


def brief(cell):
    try:
        number = float(cell)
    except ValueError:
        return cell
    return f"{int(number):,}" if number == int(number) and abs(number) < 1e9 else f"{number:.3g}"

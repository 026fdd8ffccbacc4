# SPDX-License-Identifier: BSD-3-Clause
"""The text format of the reference optima; tests/data/references/README.md describes it."""

import numpy as np


def write_reference(path, name, domain, phi, optima):
    """optima: variant -> Optimum."""
    lines = [
        "# A problem of local barycentric coordinates and its optima; see README.md beside this.",
        f"name {name}",
        f"dimension {domain.dim}",
        *matrix("cage_points", domain.cage_points),
        *matrix("cage_facets", domain.cage_facets),
        *matrix("points", domain.points),
        *matrix("cells", domain.cells),
        *matrix("phi", phi),
    ]
    for variant, optimum in optima.items():
        lines += [
            f"{variant}_objective {text(optimum.objective)}",
            f"{variant}_gap {text(optimum.gap)}",
            *matrix(f"{variant}_weights", optimum.weights),
        ]
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("\n".join(lines) + "\n")


def matrix(key, rows):
    yield f"{key} {rows.shape[0]} {rows.shape[1]}"
    for row in rows:
        yield " ".join(text(value) for value in row)


def text(value):
    """The shortest text that reads as exactly the same number."""
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    value = float(value)
    return str(int(value)) if value in (0, 1) else repr(value)

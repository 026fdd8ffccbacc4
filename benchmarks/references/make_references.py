#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the reference optima that the tests compare the solvers with.

usage: make_references.py [OUTDIR [NAME ...]]   (default: all, to tests/data/references; minutes)

Small problems of local barycentric coordinates, made here from scratch and solved to many digits by
second-order cone programming, with and without non-negativity. Nothing of the library is used.
Needs the Debian packages python3-numpy and python3-cvxopt. Problems come out the same everywhere;
the last digits of the optima depend on the versions of these.

A problem is written only if a lower bound certifies both optima and if they are unique: slightly
different phi must not move any weight visibly.
"""

import pathlib
import sys
from dataclasses import dataclass

import numpy as np

import shapes
from domains import make_domain
from optimum import distance_weights, minimise
from reference_file import write_reference

LARGEST_GAP = 1e-8  # relative
LARGEST_SHIFT = 2e-5  # of any weight ..
CHANGES = 1e-6  # .. when phi changes by this relative amount
TRIALS = 2


@dataclass
class Case:
    shape: shapes.Shape
    parts: int  # each coarse edge becomes so many edges
    jitter: float  # relative to the room of a vertex


def cases():
    cube = shapes.box((0, 1), (0, 1), (0, 1))
    refined = shapes.box((0, 1, 1.8), (0, 0.6, 1.5), (0, 1))  # 10 more control points
    return {
        "star": Case(shapes.star(), 5, 0.5),
        "corner": Case(shapes.corner(), 6, 0.5),
        "annulus": Case(shapes.annulus(), 5, 0.6),
        "bolt": Case(shapes.bolt(), 5, 0.6),
        "cube": Case(cube, 5, 0.4),
        "slanted_cube": Case(shapes.slanted(cube), 4, 0.5),
        "notched_prism": Case(shapes.notched_prism(), 4, 0.4),
        "slanted_box": Case(shapes.slanted(refined), 3, 0.4),
        "slanted_spindle": Case(shapes.slanted(shapes.spindle()), 3, 0.5),
    }


def certified_optimum(domain, phi, non_negative):
    """The optimum and how far it moves when phi changes. Raises ArithmeticError if it is not
    certified or not unique."""
    optimum = minimise(domain, phi, non_negative)
    if not abs(optimum.gap) < LARGEST_GAP:
        raise ArithmeticError(f"the relative gap is {optimum.gap:.1e}, not below {LARGEST_GAP}")
    random = np.random.RandomState(1)
    shift = 0.0
    for _ in range(TRIALS):
        changed = phi * (1 + CHANGES * random.uniform(-1, 1, phi.shape))
        other = minimise(domain, changed, non_negative)
        shift = max(shift, np.abs(other.weights - optimum.weights).max())
    if not shift < LARGEST_SHIFT:
        raise ArithmeticError(f"the optimum is hardly unique: other phi shift it by {shift:.1e}")
    return optimum, shift


def make_reference(folder, name, case):
    domain = make_domain(case.shape, case.parts, case.jitter, seed=1)
    phi = distance_weights(domain)
    optima = {}
    print(f"{name}: {len(domain.points)} vertices ({len(domain.interior())} interior), "
          f"{len(domain.cells)} cells, {len(domain.cage_points)} control points")
    for variant in ("unconstrained", "non_negative"):
        optimum, shift = certified_optimum(domain, phi, variant == "non_negative")
        optima[variant] = optimum
        print(f"  {variant}: objective {optimum.objective:.12g}, relative gap {optimum.gap:.1e}, "
              f"least weight {optimum.weights.min():.1e}, moves by {shift:.1e}", flush=True)
    write_reference(folder / f"{name}.txt", name, domain, phi, optima)


def main(arguments):
    root = pathlib.Path(__file__).resolve().parents[2]
    folder = pathlib.Path(arguments[0]) if arguments else root / "tests" / "data" / "references"
    folder.mkdir(parents=True, exist_ok=True)
    every = cases()
    for name in arguments[1:] or every:
        if name not in every:
            sys.exit(f"there is no case '{name}'; there are: {', '.join(every)}")
        make_reference(folder, name, every[name])


if __name__ == "__main__":
    main(sys.argv[1:])

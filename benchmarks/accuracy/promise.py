#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether "converged" means converged: the true error of weights relative to the tolerance.

    promise.py [--cages NAME ...] [--files CAGE ...] [--sizes N ...] [--references FOLDER] > out.csv

Meshes awkward cages (pockets, thin fingers, spikes, spirals, spheres; tests/awkward has the
shapes), each with several numbers of vertices, and solves with every tolerance, with the active set
and without. The reference has tolerance 1e-11 in double precision. Run it with the Python module on
PYTHONPATH. References are kept in a folder, because they take most of the time.
"""
import argparse
import csv
import pathlib
import sys
import time
import warnings

import numpy as np

import flbc

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "awkward"))
import shapes_2d as plane  # noqa: E402
import shapes_3d as space  # noqa: E402

TOLERANCES = (1e-5, 1e-6, 1e-7)


def slit(width, count):
    """A square with a narrow pocket, its outline cut into about `count` edges."""
    corners = np.array([(0, 0), (2, 0), (2, 1.5), (1 + width, 1.5), (1 + width / 2, 0.2),
                        (1 - width / 2, 0.2), (1 - width, 1.5), (0, 1.5)])
    sides = np.roll(corners, -1, 0) - corners
    lengths = np.linalg.norm(sides, axis=1)
    parts = np.maximum(1, np.round(lengths / lengths.sum() * count)).astype(int)
    return plane.loop([tuple(p + side * k / n) for p, side, n in zip(corners, sides, parts)
                       for k in range(n)])


CAGES = {"square": plane.loop(plane.rectangle(1, 1)), "comb 5": plane.comb(5, 1),
         "comb 12 slits": plane.comb(12, 0.1), "star 12": plane.star(6, 0.3), "star 48": plane.star(24, 0.3),
         "spiral 120": plane.spiral(120, 2, 0.3), "slit 8": slit(0.02, 8), "slit 77": slit(0.02, 77),
         "slit 77 narrow": slit(0.004, 77), "circle 20": plane.loop(plane.ring(20)),
         "circle 100": plane.loop(plane.ring(100)), "rough 60": plane.rough(60, 1),
         "box 8": space.box(1, 1, 1), "twisted": space.twisted(0.4), "sphere 26": space.sphere(4, 6),
         "sphere 102": space.sphere(10, 10),
         "disk 102": space.moved(space.sphere(10, 10), stretch=(1, 1, 0.1)),
         "torus 96": space.torus(16, 6, 0.3), "sphere 202": space.sphere(10, 20),
         "sphere 1002": space.sphere(25, 40)}


def cage_of(points, facets):
    if len(points[0]) == 2:
        facets = [(a, b) for line in facets for a, b in zip(line, line[1:] + line[:1])]
    return flbc.Cage(np.array(points), facets)


def reference(cage, mesh, smoothness, file):
    """Weights as exact as the iteration can make them, and whether they converged."""
    if file and file.exists():
        kept = np.load(file)
        return kept["weights"], bool(kept["converged"])
    solution = flbc.solve(cage, mesh, tolerance=1e-11, precision="double", smoothness=smoothness,
                          max_iterations=100000)
    if file:
        file.parent.mkdir(parents=True, exist_ok=True)
        np.savez(file, weights=solution.weights, converged=solution.converged)
    return solution.weights, solution.converged


def is_interior(mesh):
    """Whether each vertex is in no facet of a single cell."""
    corners = np.sort(mesh.cells, axis=1)
    facets = np.vstack([np.delete(corners, k, axis=1) for k in range(corners.shape[1])])
    facets, counts = np.unique(facets, axis=0, return_counts=True)
    return ~np.isin(np.arange(len(mesh.points)), facets[counts == 1])


def rows_of(name, cage, size, options):
    mesh = flbc.mesh(cage, vertices=size)
    if len(mesh.points) > 1.1 * size:
        return
    inner = is_interior(mesh)
    stem = f"{name} {size} {options.smoothness}".replace(" ", "_")
    file = options.references and options.references / f"{stem}.npz"
    exact, converged = reference(cage, mesh, options.smoothness, file)
    for active in ("off", "on"):
        for tolerance in (None, *TOLERANCES):
            start = time.perf_counter()
            solution = flbc.solve(cage, mesh, tolerance=tolerance, active_set=active,
                                  smoothness=options.smoothness, certify=active == "off")
            seconds = time.perf_counter() - start
            difference = np.abs(solution.weights - exact)[inner]
            squared = float((difference**2).mean()) if inner.any() else 0.0
            yield {"cage": name, "dim": cage.dim, "control_points": len(cage.points),
                   "vertices": len(mesh.points), "active": active,
                   "tolerance": tolerance or "default", "status": solution.report["status"],
                   "criterion": solution.report.get("criterion", ""),
                   "iterations": solution.report["iterations"],
                   "ratio": round(squared / (tolerance or 1e-6), 3),
                   "largest": round(float(difference.max(initial=0)), 4),
                   "gap": solution.certificate.relative_gap if solution.certificate else "",
                   "reference": "converged" if converged else "not converged",
                   "seconds": round(seconds, 3)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cages", nargs="*", default=list(CAGES), help="some of the cages made here")
    parser.add_argument("--files", nargs="*", default=[], help="cages in files, in addition")
    parser.add_argument("--sizes", nargs="*", type=int, default=[1000, 3000, 6000])
    parser.add_argument("--smoothness", type=float, default=0.003)
    parser.add_argument("--references", type=pathlib.Path, help="folder that keeps references")
    options = parser.parse_args()
    warnings.simplefilter("ignore", flbc.NotConverged)
    cages = [(name, cage_of(*CAGES[name])) for name in options.cages]
    cages += [(pathlib.Path(file).stem, flbc.read_cage(file)) for file in options.files]
    table = None
    for name, cage in cages:
        for size in options.sizes:
            for row in rows_of(name, cage, size, options):
                if table is None:
                    table = csv.DictWriter(sys.stdout, list(row))
                    table.writeheader()
                table.writerow(row)
                sys.stdout.flush()


if __name__ == "__main__":
    main()

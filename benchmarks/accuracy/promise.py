#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whether "converged" means converged: the true error of weights relative to the tolerance.

    promise.py [--cages NAME ...] [--files CAGE ...] [--sizes N ...] [--references FOLDER] > out.csv

Makes awkward cages (pockets, thin fingers, spikes, spirals, bumpy spheres, 4 to 1,000 control
points), meshes each with several numbers of vertices, and solves with every tolerance, with the
active set and without. The reference has tolerance 1e-11 in double precision. Run it with the Python
module on PYTHONPATH. References are kept in a folder, because they take most of the time.
"""
import argparse
import csv
import math
import pathlib
import sys
import time
import warnings

import numpy as np

import flbc

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "awkward"))
import shapes_3d  # noqa: E402

TOLERANCES = (1e-5, 1e-6, 1e-7)


# ---- cages ---------------------------------------------------------------------------------------
def comb(fingers, width, gap, height, base=0.3):
    """A base with upright fingers."""
    x = fingers * width + (fingers - 1) * gap
    points = [(0, 0), (x, 0)]
    for finger in range(fingers):
        points += [(x, base + height), (x - width, base + height)]
        x -= width
        if finger < fingers - 1:
            points += [(x, base), (x - gap, base)]
            x -= gap
    return np.array(points, float)


def star(spikes, inner):
    angles = np.linspace(0, 2 * np.pi, 2 * spikes, endpoint=False)
    radii = np.where(np.arange(2 * spikes) % 2 == 0, 1, inner)
    return np.stack([radii * np.cos(angles), radii * np.sin(angles)], 1)


def spiral(count, width):
    turn = np.linspace(0, 4 * np.pi, count // 2)
    radius = 0.2 + 0.8 * turn / turn[-1]
    outer = np.stack([radius * np.cos(turn), radius * np.sin(turn)], 1)
    return np.vstack([outer, (outer * ((radius - width) / radius)[:, None])[::-1]])


def circle(count):
    angles = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.stack([np.cos(angles), np.sin(angles)], 1)


def bumpy(count, bumps=7, height=0.15):
    points = circle(count)
    angles = np.arctan2(points[:, 1], points[:, 0])
    return points * (1 + height * np.sin(bumps * angles))[:, None]


def pocket(width):
    """A square with a narrow slit."""
    return np.array([(0, 0), (2, 0), (2, 1.5), (1 + width, 1.5), (1 + width / 2, 0.2),
                     (1 - width / 2, 0.2), (1 - width, 1.5), (0, 1.5)], float)


def dense(points, count):
    """The same polygon with about `count` vertices."""
    following = np.roll(points, -1, 0)
    lengths = np.linalg.norm(following - points, axis=1)
    result = []
    for p, q, length in zip(points, following, lengths):
        parts = max(1, round(length / lengths.sum() * count))
        result += [p + (q - p) * k / parts for k in range(parts)]
    return np.array(result)


def polygon(points):
    count = len(points)
    return flbc.Cage(points, [(k, (k + 1) % count) for k in range(count)])


def triangulated(points):
    """Triangles of a simple polygon, counterclockwise."""
    def area(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    left, triangles = list(range(len(points))), []
    while len(left) > 3:
        for j, b in enumerate(left):
            a, c = left[j - 1], left[(j + 1) % len(left)]
            ear = points[a], points[b], points[c]
            if area(*ear) <= 1e-12:
                continue
            if any(min(area(ear[0], ear[1], points[q]), area(ear[1], ear[2], points[q]),
                       area(ear[2], ear[0], points[q])) >= -1e-12
                   for q in left if q not in (a, b, c)):
                continue
            triangles.append((a, b, c))
            left.pop(j)
            break
        else:
            raise ValueError("not a simple polygon")
    return triangles + [tuple(left)]


def extruded(points, height, layers=1):
    count = len(points)
    floors = [np.c_[points, np.full(count, height * k / layers)] for k in range(layers + 1)]
    top = layers * count
    faces = []
    for a, b, c in triangulated(points):
        faces += [(a, c, b), (a + top, b + top, c + top)]
    for low in range(0, top, count):
        for i in range(count):
            j = (i + 1) % count
            faces += [(i + low, j + low, j + low + count), (i + low, j + low + count, i + low + count)]
    return flbc.Cage(np.vstack(floors), faces)


def sphere(rings, sectors, bumps=0, height=0.0, squash=1.0):
    """A sphere of rings x sectors + 2 control points."""
    def radius(ring, sector):
        turn, polar = 2 * math.pi * sector / sectors, math.pi * (ring + 1) / (rings + 1)
        return 1 + height * math.sin(bumps * turn) * math.sin(bumps * polar)
    points, faces = shapes_3d.sphere(rings, sectors, radius)
    return flbc.Cage(np.array(points) * (1, 1, squash), faces)


CAGES = {
    "square": lambda: polygon(np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)),
    "comb 5": lambda: polygon(comb(5, 0.1, 0.1, 1)),
    "comb 5 dense": lambda: polygon(dense(comb(5, 0.1, 0.1, 1), 100)),
    "comb 9 thin": lambda: polygon(comb(9, 0.03, 0.05, 1)),
    "comb 12 slits": lambda: polygon(comb(12, 0.1, 0.01, 0.6)),
    "star 12": lambda: polygon(star(6, 0.3)),
    "star 24": lambda: polygon(star(12, 0.25)),
    "star 48": lambda: polygon(star(24, 0.3)),
    "star 80": lambda: polygon(star(40, 0.4)),
    "spiral 60": lambda: polygon(spiral(60, 0.08)),
    "spiral 120": lambda: polygon(spiral(120, 0.08)),
    "slit 8": lambda: polygon(pocket(0.02)),
    "slit 77": lambda: polygon(dense(pocket(0.02), 77)),
    "slit 77 narrow": lambda: polygon(dense(pocket(0.004), 77)),
    "circle 20": lambda: polygon(circle(20)),
    "circle 100": lambda: polygon(circle(100)),
    "bumpy 100": lambda: polygon(bumpy(100)),
    "bumpy 300": lambda: polygon(bumpy(300, 19)),
    "bumpy 1000": lambda: polygon(bumpy(1000, 31, 0.1)),
    "tetrahedron": lambda: flbc.Cage(np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.2, 0.3, 1)], float),
                                     [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]),
    "box 8": lambda: extruded(np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float), 1),
    "comb 4 extruded": lambda: extruded(comb(4, 0.15, 0.1, 0.8), 0.3),
    "comb 5 plate": lambda: extruded(comb(5, 0.06, 0.08, 0.8), 0.08),
    "slit extruded": lambda: extruded(pocket(0.02), 0.5),
    "slit 40 extruded": lambda: extruded(dense(pocket(0.02), 20), 0.5),
    "star 32 extruded": lambda: extruded(star(8, 0.3), 0.4),
    "star 48 plate": lambda: extruded(star(12, 0.3), 0.1),
    "spiral extruded": lambda: extruded(spiral(40, 0.1), 0.2),
    "sphere 26": lambda: sphere(4, 6),
    "sphere 102": lambda: sphere(10, 10),
    "disk 102": lambda: sphere(10, 10, squash=0.1),
    "bumpy sphere 202": lambda: sphere(10, 20, 5, 0.15),
    "bumpy sphere 642": lambda: sphere(20, 32, 5, 0.15),
    "bumpy sphere 1002": lambda: sphere(25, 40, 7, 0.1),
}


# ---- measurements --------------------------------------------------------------------------------
def reference(cage, mesh, smoothness, file):
    """Weights as exact as the iteration can make them, and whether they converged."""
    if file and file.exists():
        kept = np.load(file)
        return kept["weights"], bool(kept["converged"])
    solution = flbc.solve(cage, mesh, tolerance=1e-11, gap=0, precision="double",
                          smoothness=smoothness, max_iterations=100000)
    if file:
        file.parent.mkdir(parents=True, exist_ok=True)
        np.savez(file, weights=solution.weights, converged=solution.converged)
    return solution.weights, solution.converged


def is_interior(mesh):
    """Whether each vertex is in no facet of a single cell."""
    dim = mesh.points.shape[1]
    corners = np.sort(mesh.cells, axis=1)
    facets = np.vstack([np.delete(corners, k, axis=1) for k in range(dim + 1)])
    facets, counts = np.unique(facets, axis=0, return_counts=True)
    return ~np.isin(np.arange(len(mesh.points)), facets[counts == 1])


def rows_of(name, cage, size, options):
    mesh = flbc.mesh(cage, vertices=size)
    inner = is_interior(mesh)
    stem = f"{name} {size} {options.smoothness}".replace(" ", "_").replace("/", "_")
    file = options.references and options.references / f"{stem}.npz"
    exact, converged = reference(cage, mesh, options.smoothness, file)
    for active in ("off", "on"):
        for tolerance in (None, *TOLERANCES):
            start = time.perf_counter()
            solution = flbc.solve(cage, mesh, tolerance=tolerance, active_set=active,
                                  smoothness=options.smoothness, certify=True,
                                  **({} if tolerance is None else {"gap": 0}))
            seconds = time.perf_counter() - start
            difference = np.abs(solution.weights - exact)[inner]
            squared = float((difference**2).mean()) if inner.any() else 0.0
            yield {"cage": name, "dim": cage.dim, "control_points": len(cage.points),
                   "vertices": len(mesh.points), "active": active,
                   "tolerance": tolerance or "default", "status": solution.report["status"],
                   "criterion": solution.report.get("criterion", ""),
                   "iterations": solution.report["iterations"],
                   "ratio": round(squared / (tolerance or 1e-7), 3),
                   "largest": round(float(difference.max(initial=0)), 4),
                   "gap": solution.certificate.relative_gap,
                   "reference": "converged" if converged else "not converged",
                   "seconds": round(seconds, 3)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cages", nargs="*", default=list(CAGES), help="some of the cages made here")
    parser.add_argument("--files", nargs="*", default=[], help="cages in files, in addition")
    parser.add_argument("--sizes", nargs="*", type=int, default=[1000, 3000, 6000])
    parser.add_argument("--smoothness", type=float, default=0)
    parser.add_argument("--references", type=pathlib.Path, help="folder that keeps references")
    options = parser.parse_args()
    warnings.simplefilter("ignore", flbc.NotConverged)
    cages = {name: CAGES[name] for name in options.cages}
    cages |= {pathlib.Path(file).stem: lambda file=file: flbc.read_cage(file) for file in options.files}
    table = None
    for name, make in cages.items():
        cage = make()
        for size in options.sizes:
            for row in rows_of(name, cage, size, options):
                if table is None:
                    table = csv.DictWriter(sys.stdout, list(row))
                    table.writeheader()
                table.writerow(row)
                sys.stdout.flush()


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the reference optimum of a model of real size, in compact form.

usage: model_references.py NAME CAGE.obj DOMAIN OUT.txt [unconstrained|non_negative ...]

CAGE and DOMAIN (.obj in 2D, MEDIT .mesh in 3D) as `flbc mesh CAGE --vertices N -o DOMAIN` leaves them.
The problem is that of make_references.py with phi from Euclidean distances, solved in the same way, by
second-order cone programming and without the library. What is written neither holds the cage nor the
mesh: objectives, the gaps that certify them, and the weights of some interior vertices. Needs
the Debian packages python3-numpy and python3-cvxopt, gigabytes and from minutes to hours.
"""

import pathlib
import sys

import numpy as np

import optimum as method
from domains import Domain, boundary_facets, oriented
from reference_file import text

SAMPLES = 100  # vertices whose weights are kept, about
NEAR = 1e-9  # of the cage's size, in which a mesh vertex lies on a facet


def read_obj(path):
    """Points and elements (l or f), counted from 0."""
    points, elements = [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(x) for x in words[1:4]])
        elif words[0] in "lf":
            elements.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return np.array(points), elements


def read_medit(path):
    words = path.read_text().split()
    at = words.index("Vertices")
    count = int(words[at + 1])
    points = np.array(words[at + 2:at + 2 + 4 * count], float).reshape(count, 4)[:, :3]
    at = words.index("Tetrahedra")
    count = int(words[at + 1])
    cells = np.array(words[at + 2:at + 2 + 5 * count], int).reshape(count, 5)[:, :4] - 1
    return points, cells.tolist()


def on_facet(point, corners, near):
    """Barycentric coordinates of a point in a segment or triangle, or None if it is not on it."""
    edges = (corners[1:] - corners[0]).T
    inner = np.linalg.lstsq(edges, point - corners[0], rcond=None)[0]
    row = np.append(1 - inner.sum(), inner)
    if row.min() < -1e-7 or np.linalg.norm(row @ corners - point) > near:
        return None
    row = np.maximum(row, 0)
    return row / row.sum()


def load(cage_path, domain_path):
    cage, elements = read_obj(cage_path)
    is_3d = domain_path.suffix == ".mesh"
    points, cells = read_medit(domain_path) if is_3d else read_obj(domain_path)
    dim = 3 if is_3d else 2
    cage, points = cage[:, :dim], points[:, :dim]
    if is_3d:
        facets = [tuple(e) for e in elements]
    else:
        lines = [tuple(pair) for e in elements for pair in zip(e[:-1], e[1:])]
        facets = lines or [(k, (k + 1) % len(cage)) for k in range(len(cage))]
    cells = [oriented(points, cell) for cell in cells]
    near = NEAR * np.linalg.norm(np.ptp(cage, axis=0))
    weights = {}
    for v in {v for facet in boundary_facets(points, cells) for v in facet}:
        for facet in facets:
            row = on_facet(points[v], cage[list(facet)], near)
            if row is not None:
                weights[v] = np.zeros(len(cage))
                weights[v][list(facet)] = row
                break
        else:
            raise ValueError(f"vertex {v} of the mesh's boundary is not on the cage")
    return Domain(cage, np.array(facets), points, np.array(cells), weights)


def lines_of(variant, optimum, chosen):
    yield f"{variant}_objective {text(optimum.objective)}"
    yield f"{variant}_gap {text(optimum.gap)}"
    for v in chosen:
        row = optimum.weights[v]
        kept = np.flatnonzero(np.abs(row) > 1e-9)
        yield " ".join([str(v), str(len(kept))] + [f"{i} {row[i]:.9g}" for i in kept])


def main(arguments):
    if len(arguments) < 4:
        sys.exit(__doc__.strip())
    name, cage, mesh, out = arguments[0], *map(pathlib.Path, arguments[1:4])
    domain = load(cage, mesh)
    phi = method.distance_weights(domain)
    interior = domain.interior()
    chosen = interior[::max(1, len(interior) // SAMPLES)]
    lines = ["# The optimum of a model; see README.md beside this.", f"name {name}",
             f"dimension {domain.dim}", f"control_points {len(domain.cage_points)}",
             f"vertices {len(domain.points)}", f"cells {len(domain.cells)}",
             f"samples {len(chosen)}"]
    lines += [" ".join([str(v)] + [text(x) for x in domain.points[v]]) for v in chosen]
    print(f"{name}: {len(domain.points)} vertices ({len(interior)} interior), "
          f"{len(domain.cells)} cells, {len(domain.cage_points)} control points", flush=True)
    for variant in arguments[4:] or ("unconstrained", "non_negative"):
        optimum = method.minimise(domain, phi, variant == "non_negative")
        print(f"  {variant}: objective {optimum.objective:.12g}, relative gap {optimum.gap:.1e}, "
              f"least weight {optimum.weights.min():.1e}", flush=True)
        lines += lines_of(variant, optimum, chosen)
        out.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])

#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: check_certificate.py FILE.npz

Proves, without flbc, by how much the objective of weights can exceed its minimum, for a file from
`flbc solve CAGE -o WEIGHTS --certificate FILE.npz`. Exit status 1 if it is not proved.

The objective of weights w is the sum over cells s and control points i of
A_s (phi_s^i |grad w_i| + epsilon / 2 |grad w_i|^2), A_s the measure of the cell. It is minimized
over all weights that are at least 0, sum to 1, reproduce each vertex, have the given values on the
boundary, and are 0 for the masked pairs of vertices and control points. For any vectors q_s^i, the objective of all such weights is at least

    sum_v sum_i w_i(v) D_i(v) - C,  D_i(v) = sum of A_s q_s^i . grad(hat function of v),
    C = sum of A_s max(|q_s^i| - phi_s^i, 0)^2 / (2 epsilon); if epsilon = 0, q is cut to phi.

At an interior vertex x, the sum over i is at least min_i D_i - y . (c_i - x) for any y, where the
minimum leaves masked control points out.

Rounding: geometry is computed in extended precision. A sum counts as wrong by (terms + 20) 2^-52
times the sum of absolute values, more than all its operations can be.
"""
import sys

import numpy as np

TOLERANCE = 1e-9  # of sums and reproduction, relative to the size of the cage
CLAIM = 1e-6  # what single precision of the vectors may cost, relative to the objective


def require(condition, message):
    if not condition:
        raise ValueError(message)


def margin(terms, magnitude):
    return (terms + 20) * 2.0**-52 * magnitude


def read(path):
    with np.load(path, allow_pickle=False) as file:
        data = {name: file[name] for name in file.files}
    data.setdefault("masked", np.zeros((0, 2), int))  # files of earlier versions
    n, d = data["control_points"].shape
    vertices, cells = len(data["points"]), len(data["cells"])
    shapes = {"control_points": (n, d), "points": (vertices, d), "cells": (cells, d + 1),
              "weights": (vertices, n), "phi": (cells, n), "flux": (cells, d, n),
              "multipliers": (vertices, d), "smoothness": (), "claimed": (2,),
              "masked": (len(data["masked"]), 2)}
    require(d in (2, 3) and data["facets"].shape[1:] == (d,), "no cage in 2D or 3D")
    for name, shape in shapes.items():
        require(data[name].shape == shape and np.isfinite(data[name]).all(),
                f"{name} is not a finite array of shape {shape}")
    for name, end in (("facets", n), ("cells", vertices)):
        require(0 <= data[name].min() <= data[name].max() < end, f"{name} is out of range")
    require((data["masked"] >= 0).all() and (data["masked"] < (vertices, n)).all(),
            "masked is out of range")
    require(data["phi"].min() >= 0 and data["smoothness"] >= 0, "phi or smoothness is negative")
    return data


def geometry(points, cells):
    """Measures, (F), and gradients of the hat functions, (F, d + 1, d)."""
    x = points.astype(np.longdouble)[cells]
    e = x[:, 1:] - x[:, :1]
    if e.shape[2] == 2:
        normals = e[:, ::-1, ::-1] * np.array([[1, -1], [-1, 1]])
    else:
        normals = np.stack([np.cross(e[:, (k + 1) % 3], e[:, (k + 2) % 3]) for k in range(3)], 1)
    determinant = (e[:, 0] * normals[:, 0]).sum(1)
    require((determinant > 0).all(), "a cell is inverted or has no volume")
    gradients = normals / determinant[:, None, None]
    gradients = np.concatenate([-gradients.sum(1, keepdims=True), gradients], 1)
    return (determinant / (2 if e.shape[2] == 2 else 6)).astype(float), gradients.astype(float)


def boundary_vertices(cells):
    faces = np.sort(np.concatenate([np.delete(cells, k, 1) for k in range(cells.shape[1])]), 1)
    faces, counts = np.unique(faces, axis=0, return_counts=True)
    require(counts.max() <= 2, "more than two cells share a face")
    return np.unique(faces[counts == 1])


def check_weights(data, is_boundary):
    """They are feasible; those on the boundary are barycentric coordinates of a facet."""
    weights, control_points = data["weights"], data["control_points"]
    require(weights.min() >= 0, "a weight is negative")
    require(abs(weights.sum(1) - 1).max() < TOLERANCE, "weights do not sum to 1")
    require((weights[tuple(data["masked"].T)] == 0).all(), "a masked weight is not 0")
    error = abs(weights @ control_points - data["points"]).max()
    require(error < TOLERANCE * np.ptp(control_points, 0).max(), "weights do not reproduce a vertex")
    facets = [set(facet) for facet in data["facets"].tolist()]
    for vertex in np.flatnonzero(is_boundary):
        support = set(np.flatnonzero(weights[vertex]).tolist())
        require(any(support <= facet for facet in facets), f"vertex {vertex} is on no facet")


def objective(data, measures, gradients):
    corners = data["weights"][data["cells"]]
    slopes = np.sqrt((np.einsum("skd,ski->sdi", gradients, corners) ** 2).sum(1))
    slopes += margin(4, np.einsum("skd,ski->si", abs(gradients), corners))
    total = measures @ (data["phi"] * slopes + data["smoothness"] / 2 * slopes**2).sum(1)
    return total + margin(slopes.size, total)


def lower_bound(data, measures, gradients, is_boundary):
    cells, phi, epsilon = data["cells"], data["phi"], float(data["smoothness"])
    q = data["flux"].astype(float)
    excess = np.sqrt((q**2).sum(1)) * (1 + 2.0**-48) - phi
    if epsilon > 0:
        conjugate = measures @ (np.maximum(excess, 0) ** 2).sum(1) / (2 * epsilon)
        conjugate += margin(phi.size, conjugate)
    else:  # a little shorter than phi
        conjugate = 0
        q *= np.where(excess > 0, phi / (excess + phi + 1e-300), 1)[:, None] * (1 - 2.0**-48)
    costs, magnitude = np.zeros((2, *data["weights"].shape))
    for k in range(cells.shape[1]):
        terms = measures[:, None, None] * gradients[:, k, :, None] * q
        np.add.at(costs, cells[:, k], terms.sum(1))
        np.add.at(magnitude, cells[:, k], abs(terms).sum(1))
    slack = margin(np.bincount(cells.ravel()).max() * cells.shape[1], magnitude)
    known = (data["weights"] * (costs - slack))[is_boundary]
    costs, slack, y = (a[~is_boundary] for a in (costs, slack, data["multipliers"]))
    products = y[:, None] * (data["control_points"] - data["points"][~is_boundary][:, None])
    rounding = margin(8, abs(products).sum(2) + abs(costs))
    is_masked = np.zeros(data["weights"].shape, bool)
    is_masked[tuple(data["masked"].T)] = True
    values = np.where(is_masked[~is_boundary], np.inf, costs - slack - products.sum(2) - rounding)
    terms = np.append(known, values.min(1))
    return terms.sum() - margin(terms.size, abs(terms).sum()) - conjugate


def main(path):
    data = read(path)
    measures, gradients = geometry(data["points"], data["cells"])
    is_boundary = np.isin(np.arange(len(data["points"])), boundary_vertices(data["cells"]))
    check_weights(data, is_boundary)
    value = objective(data, measures, gradients)
    bound = lower_bound(data, measures, gradients, is_boundary)
    claimed = data["claimed"]
    require(value <= claimed[0] * (1 + CLAIM), f"the objective is {value}, not {claimed[0]}")
    require(bound >= claimed[1] - CLAIM * value, f"the bound is {bound}, not {claimed[1]}")
    gap = max(value - bound, 0)
    print(f"objective {value:.9g}, lower bound {bound:.9g}")
    if len(data["masked"]) > 0:
        print(f"{len(data['masked'])} weights at {len(set(data['masked'][:, 0]))} vertices are masked")
    print(f"objective at most {100 * gap / value:.3g}% above the optimum: proved")
    if data["smoothness"] > 0:
        slope = 2 * gap / float(data["smoothness"]) / measures.sum() / data["weights"].shape[1]
        # The least eigenvalue of the Laplacian in a box is at most that of a domain inside it.
        least = (np.pi**2 / np.ptp(data["points"], axis=0) ** 2).sum()
        print(f"mean squared error of the weights at most {slope / least:.3g}, of their gradients "
              f"{slope:.3g}: proved")


if __name__ == "__main__":
    if sys.argv[1:] in (["-h"], ["--help"]):
        print(__doc__)
        sys.exit()
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        main(sys.argv[1])
    except (KeyError, ValueError, OSError) as problem:
        sys.exit(f"{sys.argv[1]}: not proved: {problem}")

# SPDX-License-Identifier: BSD-3-Clause
"""Gives the edges of a 2D cage two handles each, which make them cubic Bezier curves.

curved_edges.py CAGE MODEL OUTPUT   bulges all edges, and writes the deformed model to OUTPUT
"""
import sys

import flbc
import numpy as np

PIECES = 8  # straight edges instead of each


def with_handles(cage):
    """Control points and handles, a cage of PIECES edges for each, and weights of its control points.

    The handles n + 2e and n + 2e + 1 divide edge e into thirds. The weights are Bernstein polynomials.
    """
    starts, ends = cage.facets.T
    a, b = cage.points[starts], cage.points[ends]
    handles = np.hstack([2 * a + b, a + 2 * b]).reshape(-1, 2) / 3
    controls = np.vstack([cage.points, handles])
    t = np.arange(PIECES) / PIECES
    bernstein = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    weights = np.zeros((len(starts), PIECES, len(controls)))
    edges = np.arange(len(starts))
    first = len(cage) + 2 * edges
    for corner, values in zip((starts, first, first + 1, ends), bernstein):
        weights[edges, :, corner] = values
    weights = weights.reshape(-1, len(controls))
    numbers = np.arange(len(weights)).reshape(-1, PIECES)
    number_of = dict(zip(starts, numbers[:, 0]))
    following = np.column_stack([numbers[:, 1:], [number_of[end] for end in ends]])
    facets = np.column_stack([numbers.ravel(), following.ravel()])
    return controls, flbc.Cage(weights @ controls, facets), weights


if __name__ == "__main__":
    cage, model = flbc.read_cage(sys.argv[1]), flbc.read_model(sys.argv[2])
    controls, fine, of_fine = with_handles(cage)
    binding = flbc.bind(*model, fine).composed(of_fine, controls)
    along = np.diff(cage.points[cage.facets], axis=1)[:, 0]
    bulge = 0.2 * np.column_stack([along[:, 1], -along[:, 0]])  # outward for a counterclockwise cage
    posed = controls + np.vstack([np.zeros_like(cage.points), np.repeat(bulge, 2, axis=0)])
    flbc.write_model(sys.argv[3], binding.deform(posed), source=sys.argv[2])

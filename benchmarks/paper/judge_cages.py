# SPDX-License-Identifier: BSD-3-Clause
"""Cages and models judged from their files alone, without the library."""

import numpy as np

SAMPLES = 3000  # points on a cage whose distances are averaged
BLOCK = 2_000_000  # numbers of a temporary


def read_obj(path):
    """Vertices and facets: triangles, or the edges of a plane figure."""
    points, facets, lines = [], [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        numbers = [int(word.split("/")[0]) - 1 for word in words[1:] if words[0] in "fl"]
        if words[0] == "v":
            points.append([float(word) for word in words[1:4]])
        elif words[0] == "f":
            facets += [[numbers[0], a, b] for a, b in zip(numbers[1:], numbers[2:])]
        elif words[0] == "l":
            lines += list(zip(numbers, numbers[1:]))
    points = np.array(points)
    if np.ptp(points[:, 2]) > 0:
        return points, np.array(facets)
    edges = lines or [(t[k], t[(k + 1) % 3]) for t in facets for k in range(3)]
    return points[:, :2], np.array(edges)


def in_blocks(function, rows, width):
    """The function of blocks of rows, so that temporaries of so many numbers a row stay small."""
    step = max(1, BLOCK // width)
    return np.concatenate([function(rows[k:k + step]) for k in range(0, len(rows), step)])


def winding_numbers(points, cage, facets):
    """How often the cage goes round each point."""
    def around(block):
        corners = [cage[facets[:, k]][None] - block[:, None] for k in range(facets.shape[1])]
        if len(corners) == 2:
            a, b = corners
            cross = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
            return np.arctan2(cross, (a * b).sum(-1)).sum(1) / (2 * np.pi)
        a, b, c = corners
        u, v, w = (np.linalg.norm(x, axis=-1) for x in corners)
        determinant = (a * np.cross(b, c)).sum(-1)
        cosine = u * v * w + (a * b).sum(-1) * w + (b * c).sum(-1) * u + (c * a).sum(-1) * v
        return np.arctan2(determinant, cosine).sum(1) / (2 * np.pi)
    return in_blocks(around, points, 12 * len(facets))


def edges_of(facets):
    if facets.shape[1] == 2:
        return facets
    pairs = np.concatenate([facets[:, [0, 1]], facets[:, [1, 2]], facets[:, [2, 0]]])
    return np.unique(np.sort(pairs, 1), axis=0)


def count_crossings(points, edges, others, facets):
    """Edges of one shape that pass through facets of another."""
    corners = [others[facets[:, k]][None] for k in range(facets.shape[1])]

    def crossed(block):
        p, q = points[block[:, 0]][:, None], points[block[:, 1]][:, None]
        if len(corners) == 2:
            def side(a, b, x):
                return np.sign((b - a)[..., 0] * (x - a)[..., 1] - (b - a)[..., 1] * (x - a)[..., 0])
            a, b = corners
            meets = (side(a, b, p) * side(a, b, q) <= 0) & (side(p, q, a) * side(p, q, b) <= 0)
            return meets.any(1)
        a, b, c = corners

        def volume(w, x, y, z):
            return np.sign((np.cross(x - w, y - w) * (z - w)).sum(-1))
        beside = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)]
        same = ((beside[0] == beside[1]) & (beside[1] == beside[2]))
        return (same & (volume(a, b, c, p) != volume(a, b, c, q))).any(1)
    return int(in_blocks(crossed, edges, 40 * len(facets)).sum())


def mean_distance(cage, cage_facets, model, model_facets):
    """Of points spread evenly over the cage to the nearest of vertices and middles of the model."""
    rng = np.random.default_rng(1)
    corners = cage[cage_facets]
    sides = corners[:, 1:] - corners[:, :1]
    sizes = np.sqrt(np.maximum(np.linalg.det(sides @ sides.transpose(0, 2, 1)), 0))
    chosen = rng.choice(len(sizes), SAMPLES, p=sizes / sizes.sum())
    weights = rng.dirichlet(np.ones(corners.shape[1]), SAMPLES)
    samples = (weights[:, :, None] * corners[chosen]).sum(1)
    targets = np.concatenate([model, model[model_facets].mean(1)])
    squares = (targets**2).sum(1)

    def nearest(block):
        distances = (block**2).sum(1)[:, None] - 2 * block @ targets.T + squares
        return np.sqrt(np.maximum(distances.min(1), 0))
    return in_blocks(nearest, samples, len(targets)).mean()


def size_of(points):
    return np.linalg.norm(np.ptp(points, axis=0))

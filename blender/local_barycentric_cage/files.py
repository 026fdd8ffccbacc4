# SPDX-License-Identifier: BSD-3-Clause
"""Files that the add-on and the program exchange. Arrays of NumPy only."""
import numpy as np


def write_ply(path, points, corners, starts, counts):
    """Writes a polygon mesh as a binary PLY file in double precision.

    points: (V, 3). corners: vertex numbers of all faces, one face after another. starts, counts: of
    each face, the place of its first corner and the number of its corners.
    """
    header = ('ply\nformat binary_little_endian 1.0\n'
              f'element vertex {len(points)}\n'
              'property double x\nproperty double y\nproperty double z\n'
              f'element face {len(starts)}\n'
              'property list int int vertex_indices\nend_header\n')
    with open(path, 'wb') as file:
        file.write(header.encode())
        file.write(np.ascontiguousarray(points, '<f8').tobytes())
        file.write(np.insert(corners, starts, counts).astype('<i4').tobytes())


def read_obj(path):
    """Returns points (V, 3) and a list of faces, each a list of vertex numbers from 0."""
    points, faces = [], []
    with open(path) as file:
        for line in file:
            kind, *words = line.split() or ['']
            if kind == 'v':
                points.append([float(word) for word in words[:3]])
            elif kind == 'f':
                faces.append([int(word.split('/')[0]) - 1 for word in words])
    return np.array(points), faces


_ROWS = 1 << 16  # at a time, so that a large file is never in memory as a whole


def _slices(count):
    return (slice(begin, min(begin + _ROWS, count)) for begin in range(0, count, _ROWS))


def largest_weights(path, k):
    """Reads a weight matrix (.npy) and keeps the k largest weights of each row, with sum 1.

    Returns columns (V, k), int32, and weights (V, k), float32. Unused places have weight 0.
    """
    matrix = np.load(path, mmap_mode='r')
    k_there = min(k, matrix.shape[1])
    columns = np.zeros((len(matrix), k), np.int32)
    weights = np.zeros((len(matrix), k), np.float32)
    for rows in _slices(len(matrix)):
        part = matrix[rows]
        places = np.argpartition(part, -k_there, axis=1)[:, -k_there:]
        kept = np.take_along_axis(part, places, axis=1)
        columns[rows, :k_there] = np.where(kept > 0, places, 0)
        weights[rows, :k_there] = kept / kept.sum(1, keepdims=True)
    return columns, weights


def weighted_sums(path, points):
    """Returns the sums of points (n, 3) with the rows of a weight matrix (.npy) as weights: (V, 3)."""
    matrix = np.load(path, mmap_mode='r')
    return np.concatenate([matrix[rows] @ points for rows in _slices(len(matrix))])

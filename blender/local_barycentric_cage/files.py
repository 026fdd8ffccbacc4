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


def largest_weights(path, k):
    """Reads a binding (.npz) and keeps the k largest weights of each vertex, with sum 1.

    Returns columns (V, k), int32, and weights (V, k), float32. Unused places have weight 0.
    """
    with np.load(path) as file:
        starts, columns, values = file['indptr'], file['indices'], file['data']
    vertices = np.repeat(np.arange(len(starts) - 1), np.diff(starts))
    order = np.lexsort((-values, vertices))
    places = np.arange(len(values)) - starts[vertices]
    kept = (places < k) & (values[order] > 0)
    found = vertices[kept], places[kept]
    indices = np.zeros((len(starts) - 1, k), np.int32)
    weights = np.zeros((len(starts) - 1, k))
    indices[found], weights[found] = columns[order][kept], values[order][kept]
    return indices, (weights / weights.sum(1, keepdims=True)).astype(np.float32)


def vertices_outside(path):
    """Returns the numbers of the vertices of a binding (.npz) that are outside the cage."""
    with np.load(path) as file:
        return file['outside']

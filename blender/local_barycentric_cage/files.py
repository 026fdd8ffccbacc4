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


def read_mtx(path):
    """Reads a sparse matrix in Matrix Market format.

    Returns its shape, and the row, column, and value of each entry.
    """
    with open(path, 'rb') as file:
        line = file.readline()
        while line.startswith(b'%'):
            line = file.readline()
        rows, columns, _ = map(int, line.split())
        entries = np.fromfile(file, sep=' ').reshape(-1, 3)
    return ((rows, columns), entries[:, 0].astype(np.int64) - 1, entries[:, 1].astype(np.int64) - 1,
            entries[:, 2])


def largest(shape, row, column, value, k):
    """Keeps the k largest entries of each row, scaled so that they sum to 1.

    Returns columns (rows, k), int32, and values (rows, k), float32. Unused places are 0 in both.
    """
    order = np.lexsort((-value, row))
    row, column, value = row[order], column[order], value[order]
    place = np.arange(len(row)) - np.searchsorted(row, row)
    kept = place < k
    columns = np.zeros((shape[0], k), np.int32)
    values = np.zeros((shape[0], k))
    columns[row[kept], place[kept]] = column[kept]
    values[row[kept], place[kept]] = value[kept]
    return columns, (values / values.sum(1, keepdims=True)).astype(np.float32)

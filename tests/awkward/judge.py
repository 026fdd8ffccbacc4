# SPDX-License-Identifier: BSD-3-Clause
"""Judges weights by what coordinates are: finite, not negative, of sum 1, reproducing points."""

import array
import ast
import math
import pathlib
import sys
import tempfile

MOST_ERROR = 1e-9


def read_npy(path):
    """Rows of a two-dimensional array of doubles."""
    data = path.read_bytes()
    if data[:6] != b"\x93NUMPY":
        raise ValueError("no .npy file")
    size = int.from_bytes(data[8:10], "little")
    header = ast.literal_eval(data[10:10 + size].decode())
    rows, columns = header["shape"]
    values = array.array("d", data[10 + size:])
    if header["descr"] != "<f8" or sys.byteorder != "little" or len(values) != rows * columns:
        raise ValueError(f"not the doubles that the header tells of: {header}")
    if header["fortran_order"]:
        return [values[i::rows] for i in range(rows)]
    return [values[i * columns:(i + 1) * columns] for i in range(rows)]


def read_points(path, dim):
    """Vertices of an .obj or a .mesh file."""
    lines = [line.split() for line in path.read_text().splitlines()]
    if path.suffix == ".obj":
        return [[float(x) for x in words[1:1 + dim]] for words in lines if words and words[0] == "v"]
    begin = lines.index(["Vertices"]) + 1
    count = int(lines[begin][0])
    return [[float(x) for x in words[:dim]] for words in lines[begin + 1:begin + 1 + count]]


def faults(rows, places, points):
    """Faults of rows of weights at places; errors are relative to the cage's size."""
    if len(rows) != len(places) or any(len(row) != len(points) for row in rows):
        yield f"{len(rows)} rows of weights for {len(places)} vertices"
        return
    if not all(math.isfinite(w) for row in rows for w in row):
        yield "weights that are no finite numbers"
        return
    least = min(min(row) for row in rows)
    if least < 0:
        yield f"a weight of {least}"
    sums = max(abs(math.fsum(row) - 1) for row in rows)
    if sums > MOST_ERROR:
        yield f"a sum that is off by {sums}"
    # Relative to the first control point, because products of distant points would lose the
    # required digits.
    size = max(math.dist(p, points[0]) for p in points)
    error = 0.0
    for axis in range(len(points[0])):
        along = [(p[axis] - points[0][axis]) / size for p in points]
        error = max(error, max(
            abs(math.fsum(w * a for w, a in zip(row, along)) - (place[axis] - points[0][axis]) / size)
            for row, place in zip(rows, places)))
    # The rounding of the places themselves.
    rounding = 4 * sys.float_info.epsilon * max(abs(x) for p in points for x in p) / size
    if error > MOST_ERROR + rounding:
        yield f"vertices are reproduced to {error} of the size only"


def weight_faults(weights, domain, dim, points):
    try:
        rows, places = read_npy(weights), read_points(domain, dim)
    except (ValueError, IndexError) as error:
        yield f"files that cannot be read: {error}"
        return
    yield from faults(rows, places, points)


def test_itself():
    """Good weights pass, and each kind of wrong ones is reported."""
    points, places = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)], [(0.25, 0.5), (1.0, 0.0)]
    good = [[0.25, 0.25, 0.5], [0.0, 1.0, 0.0]]
    assert not list(faults(good, places, points))
    for row in ([0.25, 0.25, math.nan], [-1e-12, 1.0, 1e-12], [0.0, 1.0, 1e-8],
                [1e-8, 1.0 - 1e-8, 0.0]):
        assert list(faults([good[0], row], places, points)), row
    assert list(faults(good[:1], places, points))
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "weights.npy"
        header = b"{'descr': '<f8', 'fortran_order': True, 'shape': (2, 3), }\n"
        path.write_bytes(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header
                         + array.array("d", [1, 2, 3, 4, 5, 6]).tobytes())
        assert [list(row) for row in read_npy(path)] == [[1, 3, 5], [2, 4, 6]]
        path.write_bytes(path.read_bytes()[:-8])
        try:
            read_npy(path)
        except ValueError:
            return
        raise AssertionError("a file cut off passes")

# SPDX-License-Identifier: BSD-3-Clause
"""A bump in the wall of a duct of hexahedra: five amplitudes, quality of the cells, SU2 meshes.

duct.py OUT   writes duct.su2, duct_1.su2 to duct_5.su2, and duct.svg into this folder
"""
import itertools
import pathlib
import sys

import flbc
import numpy as np

CELLS = (48, 16, 16)
SIZE = np.array([3.0, 1.0, 1.0])
SIDES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]


def grid(counts):
    """Points of a unit grid, and a function that numbers them."""
    axes = [np.linspace(0, 1, n + 1) for n in counts]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, 3)
    return points, lambda *ijk: np.ravel_multi_index(ijk, [n + 1 for n in counts])


def duct():
    """Points, hexahedra, and sides in the wall z = 0, where layers are thinner."""
    points, number = grid(CELLS)
    points[:, 2] **= 1.5
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [[number(i + a, j + b, k + c) for a, b, c in corners]
             for i, j, k in itertools.product(*map(range, CELLS))]
    cells = np.array(cells)
    return SIZE * points, cells, cells[:: CELLS[2]][:, SIDES[0]]


def box(low, high, counts):
    """A cage: the surface of a box with a grid of control points on it."""
    points, number = grid(counts)
    faces = []
    for axis, side in itertools.product(range(3), (0, 1)):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for i, j in itertools.product(range(counts[u]), range(counts[v])):
            face = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))[:: 2 * side - 1]:
                corner = [0, 0, 0]
                corner[axis], corner[u], corner[v] = side * counts[axis], i + a, j + b
                face.append(number(*corner))
            faces.append(face)
    used, faces = np.unique(faces, return_inverse=True)
    return flbc.Cage(np.array(low) + (np.array(high) - low) * points[used], faces.reshape(-1, 4))


def moves_of(cage):
    """Control points behind the wall, not those at the edge of the box, move into the duct."""
    x, y, z = cage.points.T
    moves = np.zeros_like(cage.points)
    moves[(z == z.min()) & (x > x.min()) & (x < x.max()) & (y > y.min()) & (y < y.max()), 2] = 1
    return moves


def write_su2(path, points, cells, wall):
    rows = [f"12 {' '.join(map(str, cell))} {k}" for k, cell in enumerate(cells)]
    places = [f"{x!r} {y!r} {z!r} {k}" for k, (x, y, z) in enumerate(points.tolist())]
    sides = [f"9 {' '.join(map(str, side))}" for side in wall]
    path.write_text("\n".join(["NDIME= 3", f"NELEM= {len(cells)}", *rows, f"NPOIN= {len(points)}", *places,
                               "NMARK= 1", "MARKER_TAG= wall", f"MARKER_ELEMS= {len(wall)}", *sides, ""]))


def draw(path, shapes):
    """The middle plane of the duct, at rest and moved."""
    _, number = grid(CELLS)
    lines = []
    for n, points in enumerate(shapes):
        plane = points.reshape(*(c + 1 for c in CELLS), 3)[:, CELLS[1] // 2][..., [0, 2]]
        plane = 300 * (plane * [1, -1] + [0.05, 1.05 + 1.15 * n])
        for line in [*plane, *plane.swapaxes(0, 1)]:
            lines.append(f'<polyline points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in line)}"/>')
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 930 {345 * len(shapes)}" '
                    f'fill="none" stroke="#456">{"".join(lines)}</svg>')


def main(out):
    points, cells, wall = duct()
    # The cage goes through the duct above the wall, and continues behind the wall and the sides.
    cage = box([0.75, -0.2, -0.3], [2.25, 1.2, 0.7], (6, 4, 3))
    binding = flbc.bind(points, cells[:, SIDES].reshape(-1, 4), cage, outside="keep").joined("smooth")
    moves = moves_of(cage)
    out.mkdir(exist_ok=True)
    write_su2(out / "duct.su2", points, cells, wall)
    shapes = [points]
    print("amplitude  inverted cells  least Jacobian ratio  least orthogonality")
    for k in range(1, 6):
        moved = binding.deform(cage.points + 0.15 * k * moves)
        quality = flbc.cell_quality(points, cells, moved)
        print(f"{0.15 * k:9.2f}  {(quality['jacobian'] <= 0).sum():14d}  "
              f"{quality['jacobian'].min():20.3f}  {quality['orthogonality'].min():19.3f}")
        write_su2(out / f"duct_{k}.su2", moved, cells, wall)
        shapes.append(moved)
    step = binding.largest_step(cage.points + moves, cells)
    print(f"every cell keeps a tenth of its size up to an amplitude of {step:.2f}")
    draw(out / "duct.svg", [shapes[0], shapes[3], shapes[5]])


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))

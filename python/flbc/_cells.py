# SPDX-License-Identifier: BSD-3-Clause
"""Quality of the cells of a user's own mesh after a deformation."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Dict, List, Tuple

import numpy as np

from ._errors import InputError
from ._shapes import as_array, as_indices, as_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._shapes import Floats, Ints

# By dimension and number of corners, in the order of VTK: corners with the ends of d edges that span
# the cell there, positively oriented for positively oriented cells.
_SPANS: Dict[Tuple[int, int], List[List[int]]] = {
    (2, 3): [[0, 1, 2], [1, 2, 0], [2, 0, 1]],
    (2, 4): [[0, 1, 3], [1, 2, 0], [2, 3, 1], [3, 0, 2]],
    (3, 4): [[0, 1, 2, 3], [1, 2, 0, 3], [2, 0, 1, 3], [3, 1, 0, 2]],
    (3, 5): [[0, 1, 3, 4], [1, 2, 0, 4], [2, 3, 1, 4], [3, 0, 2, 4]],
    (3, 6): [[0, 1, 2, 3], [1, 2, 0, 4], [2, 0, 1, 5], [3, 5, 4, 0], [4, 3, 5, 1], [5, 4, 3, 2]],
    (3, 8): [[0, 1, 3, 4], [1, 2, 0, 5], [2, 3, 1, 6], [3, 0, 2, 7],
             [4, 7, 5, 0], [5, 4, 6, 1], [6, 5, 7, 2], [7, 6, 4, 3]],
}


def _volumes(points: Floats, cells: Ints) -> Tuple[Floats, Floats]:
    """Signed volumes that the edges at each corner span, (C, corners), and the products of the
    lengths of these edges."""
    spans = np.array(_SPANS[points.shape[1], cells.shape[1]])
    edges = points[cells[:, spans[:, 1:]]] - points[cells[:, spans[:, :1]]]
    return np.linalg.det(edges), np.linalg.norm(edges, axis=3).prod(axis=2)


def cell_quality(points: ArrayLike, cells: ArrayLike, moved: ArrayLike) -> Dict[str, NDArray[Any]]:
    """How a deformation changes the cells of a mesh.

    Parameters
    ----------
    points : array_like, shape (P, d)
        At rest.
    cells : array_like of int, shape (C, k)
        Triangles or quads for d = 2; tetrahedra, pyramids, wedges, or hexahedra for d = 3, with
        corners in the order of VTK. Their orientation does not matter.
    moved : array_like, shape (P, d)

    Returns
    -------
    dict of ndarray, shape (C,)
        ``jacobian``: the least ratio, over the corners of a cell, of the volume that the edges span
        there to that at rest; 0 or less: the cell is inverted. ``orthogonality``: the least ratio of
        this volume to the product of the lengths of the edges, 1 for right angles.

    Raises
    ------
    InputError
        If shapes do not match, or a cell has no volume at rest.
    """
    rest = as_points(points, "points")
    to = as_points(moved, "moved", rest.shape[1], len(rest))
    corners = as_cells(cells, rest)
    return _quality(_volumes(rest, corners)[0], corners, to)


def as_cells(cells: Any, points: Floats) -> Ints:
    corners = as_indices(as_array(cells, "cells"), "cells", len(points))
    if corners.ndim != 2 or (points.shape[1], corners.shape[1]) not in _SPANS:
        known = [k for d, k in _SPANS if d == points.shape[1]]
        raise InputError(f"cells has shape {corners.shape}, but needs (C, k), with k one of {known}")
    flat = (_volumes(points, corners)[0] == 0).any(axis=1)
    if flat.any():
        raise InputError(f"cells: cell {np.argmax(flat)} has no volume at rest")
    return corners


def _quality(at_rest: Floats, cells: Ints, moved: Floats) -> Dict[str, NDArray[Any]]:
    volumes, lengths = _volumes(moved, cells)
    with np.errstate(divide="ignore", invalid="ignore"):
        angles = np.where(lengths > 0, volumes * np.sign(at_rest) / lengths, 0)
    return {"jacobian": (volumes / at_rest).min(axis=1), "orthogonality": angles.min(axis=1)}


def largest_step(
    move: Callable[[float], Floats], points: Floats, cells: Any, at_least: float
) -> float:
    """The largest t in [0, 1] up to which all cells have Jacobian ratios of at least `at_least`."""
    corners = as_cells(cells, points)
    at_rest = _volumes(points, corners)[0]

    def is_sound(t: float) -> bool:
        return bool(_quality(at_rest, corners, move(t))["jacobian"].min(initial=1) >= at_least)

    steps = np.linspace(0, 1, 33)
    broken = next((k for k, t in enumerate(steps) if not is_sound(float(t))), None)
    if broken is None:
        return 1.0
    low, high = float(steps[max(broken - 1, 0)]), float(steps[broken])
    for _ in range(20):
        middle = (low + high) / 2
        low, high = (middle, high) if is_sound(middle) else (low, middle)
    return low

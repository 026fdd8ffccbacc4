# SPDX-License-Identifier: BSD-3-Clause
"""Weights as arguments and results, and measures of them."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Union

import numpy as np

from . import _core
from ._errors import InputError
from ._shapes import Cage, DomainMesh, as_array, as_cage, as_floats, as_points

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._shapes import CageLike, Floats

    # An array, or a sparse matrix of SciPy.
    Weights = Any


def is_sparse(weights: Any) -> bool:
    return hasattr(weights, "tocsr")


def as_matrix(weights: Any, name: str) -> Any:
    """Weights as an array or a sparse matrix."""
    if hasattr(weights, "weights"):
        raise InputError(
            f"{name} is a {type(weights).__name__}; use its methods, which keep masks and offsets "
            "(deform, reduced, transferred, composed, export, view), or pass its weights"
        )
    array = weights if is_sparse(weights) else as_array(weights, name)
    if len(array.shape) != 2:
        raise InputError(f"{name} has shape {array.shape}, but needs (P, n): a row per point")
    return array


def as_weights(weights: Any, name: str, num_points: int, num_control_points: int) -> Any:
    """Weights as _core takes them: an array, or the parts of a sparse matrix."""
    array = as_matrix(weights, name)
    if array.shape != (num_points, num_control_points):
        raise InputError(
            f"{name} has shape {array.shape}, but needs ({num_points}, {num_control_points}): "
            f"{num_points} points and {num_control_points} control points"
        )
    if not is_sparse(weights):
        return as_floats(array, name)
    matrix = weights.tocsr()
    if not matrix.has_canonical_format:
        matrix = matrix.copy()
        matrix.sum_duplicates()
    return (
        as_floats(matrix.data, name),
        matrix.indices.astype(np.int32, copy=False),
        matrix.indptr.astype(np.int64, copy=False),
        num_control_points,
    )


def from_core(found: Any) -> Weights:
    """Weights as users get them: an array, or a sparse matrix."""
    if not isinstance(found, tuple):
        return found
    from scipy.sparse import csr_matrix  # not needed for dense weights

    values, columns, starts, count = found
    return csr_matrix((values, columns, starts), shape=(len(starts) - 1, count))


def dense_of(found: Any) -> Floats:
    """The array of the parts of a sparse matrix."""
    values, columns, starts, count = found
    dense = np.zeros((len(starts) - 1, count))
    dense[np.repeat(np.arange(len(dense)), np.diff(starts)), columns] = values
    return dense


def joined(blocks: Any) -> Any:
    """The parts of a sparse matrix from those of its blocks of rows."""
    values, columns, starts, counts = zip(*blocks)
    ends = np.cumsum([0, *map(len, values)])
    rows = [s[1:] + end for s, end in zip(starts, ends)]
    return np.concatenate(values), np.concatenate(columns), np.concatenate([[0], *rows]), counts[0]


def cage_after(weights: Any, cage: CageLike) -> Cage:
    if isinstance(weights, Cage):
        raise InputError("the first argument is weights, and the second is the cage")
    return as_cage(cage)


def mean_value(cage: CageLike, points: ArrayLike) -> Floats:
    """Mean value coordinates, in closed form, for comparison.

    Parameters
    ----------
    cage : Cage, or what `Cage` accepts
    points : array_like, shape (P, d)
        Anywhere, inside the cage or outside.

    Returns
    -------
    ndarray, shape (P, n)
        Rows sum to 1. Weights can be negative.

    Raises
    ------
    InputError
        If the cage is defective, or the points have the wrong shape.
    """
    cage = as_cage(cage)
    return _core.mean_value(cage.points, cage.facets, as_points(points, "points", cage.dim))


def measure(
    weights: Weights, cage: CageLike, points: Union[ArrayLike, DomainMesh]
) -> Dict[str, Any]:
    """Measures weights from any source, as ``flbc check``.

    Parameters
    ----------
    weights : array_like or sparse matrix, shape (P, n)
    cage : Cage, or what `Cage` accepts
    points : array_like, shape (P, d), or DomainMesh
        The points of the weights. A mesh adds local extrema and variation.

    Returns
    -------
    dict
        Extreme values, each with its point and control point, and a list of ``violations`` of
        what coordinates must satisfy.

    Raises
    ------
    InputError
        If the cage is defective, or the shapes of weights and points do not match.
    """
    cage = cage_after(weights, cage)
    cells = points.cells if isinstance(points, DomainMesh) else None
    places = as_points(
        points.points if isinstance(points, DomainMesh) else points, "points", cage.dim
    )
    given = as_weights(weights, "weights", len(places), len(cage))
    return _core.measure(cage.points, cage.facets, places, cells, given)

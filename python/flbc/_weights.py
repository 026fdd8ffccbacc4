# SPDX-License-Identifier: BSD-3-Clause
"""Using weights: few influences, deformed points, other models, measures."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Optional, Sequence, Union

import numpy as np

from . import _core
from ._errors import InputError
from ._shapes import (
    Cage,
    DomainMesh,
    as_array,
    as_cage,
    as_floats,
    as_points,
    as_polygons,
    check_scalars,
    posed_points,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._shapes import CageLike, Faces, Floats

    # An array, or a sparse matrix of SciPy.
    Weights = Any


def is_sparse(weights: Any) -> bool:
    return hasattr(weights, "tocsr")


def as_weights(weights: Any, name: str, num_points: int, num_control_points: int) -> Any:
    """Weights as _core takes them: an array, or the parts of a sparse matrix."""
    array = weights if is_sparse(weights) else as_array(weights, name)
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


def cage_after(weights: Any, cage: CageLike) -> Cage:
    if isinstance(weights, Cage):
        raise InputError("the first argument is weights, and the second is the cage")
    return as_cage(cage)


def sparsify(
    weights: Weights,
    cage: CageLike,
    points: ArrayLike,
    k: Optional[int] = 8,
    *,
    threshold: float = 0,
    faces: Optional[Faces] = None,
    poses: Sequence[ArrayLike] = (),
) -> Weights:
    """Reduces weights to at most k influences per point.

    The result is non-negative, sums to 1, and reproduces every point, even if the given weights do
    not.

    Parameters
    ----------
    weights : array_like or sparse matrix, shape (P, n)
    cage : Cage, or what `Cage` accepts
    points : array_like, shape (P, d)
        Inside the convex hull of the control points.
    k : int or None, default 8
        Maximum influences per point, at least d + 1; None for no limit, which only makes
        weights non-negative.
    threshold : float, default 0
        In [0, 1). Smaller weights are dropped first, where the others can reproduce the point.
    faces : array_like of int, optional
        Faces of the model. If given, influences are reduced for all points together, so that
        no seams appear between neighbors.
    poses : sequence of array_like, shape (n, d)
        Moved control points for which the error is minimized; with `faces` only.

    Returns
    -------
    scipy.sparse.csr_matrix, shape (P, n)

    Raises
    ------
    InputError
        If shapes do not match, or a point is outside the convex hull.
    OptionError
        If `k` or `threshold` is out of range.
    """
    check_scalars(k=(k, "an integer"), threshold=(threshold, "a number"))
    cage = cage_after(weights, cage)
    places = as_points(points, "points", cage.dim)
    given = as_weights(weights, "weights", len(places), len(cage))
    polygons = None if faces is None else as_polygons(faces, "faces", len(places))
    most = np.iinfo(np.int32).max if k is None else k
    return from_core(
        _core.sparsify(
            cage.points, places, given, most, threshold, polygons, as_poses(poses, "poses", cage)
        )
    )


def as_poses(poses: Any, name: str, cage: Any) -> Any:
    return [
        as_points(pose, f"{name}[{k}]", cage.dim, len(cage)) for k, pose in enumerate(poses)
    ]


def deform(weights: Weights, control_points: CageLike) -> Floats:
    """Moves points with the control points.

    Parameters
    ----------
    weights : array_like or sparse matrix, shape (P, n)
    control_points : array_like, shape (n, d) or (T, n, d); or Cage
        In any unit of length.

    Returns
    -------
    ndarray, shape (P, d) or (T, P, d)

    Raises
    ------
    InputError
        If the numbers of control points differ.
    """
    array = weights if is_sparse(weights) else as_array(weights, "weights")
    if len(array.shape) != 2:
        raise InputError(f"weights has shape {array.shape}, but needs (P, n)")
    posed = posed_points(control_points)
    if posed.ndim == 3:
        return np.array([deform(weights, pose) for pose in posed])
    moved = as_points(posed, "control_points", count=array.shape[1])
    return np.asarray(array @ moved)


def compose(weights: Weights, map: Weights) -> Weights:
    """Multiplies weights by a map, if the n control points themselves follow m others.

    Parameters
    ----------
    weights : array_like or sparse matrix, shape (P, n)
    map : array_like or sparse matrix, shape (n, m)
        Weights of the n control points, at least 0; rows sum to 1.

    Returns
    -------
    scipy.sparse.csr_matrix, shape (P, m)
        Limit its influences by `sparsify`.

    Raises
    ------
    InputError
        If shapes do not match, or the map is no such matrix.
    """
    first = weights if is_sparse(weights) else as_array(weights, "weights")
    second = map if is_sparse(map) else as_array(map, "map")
    if first.ndim != 2 or second.ndim != 2:
        raise InputError("weights and map must be matrices, a row per point")
    given, shares = as_weights(first, "weights", *first.shape), as_weights(second, "map", *second.shape)
    return from_core(_core.compose(given, shares))


def transfer(
    weights: Weights,
    cage: CageLike,
    points: ArrayLike,
    faces: Faces,
    to: ArrayLike,
    limit: Optional[float] = None,
) -> Floats:
    """Weights for another version of a model, from the nearest place on it.

    Parameters
    ----------
    weights : array_like or sparse matrix, shape (P, n)
    cage : Cage, or what `Cage` accepts
    points : array_like, shape (P, d)
        Vertices of the model with weights.
    faces : array_like of int
        Its faces; rows of two are segments.
    to : array_like, shape (Q, d)
        Vertices of the other version.
    limit : float, optional
        Maximum distance from the model, in its units. Default: no limit.

    Returns
    -------
    ndarray, shape (Q, n)

    Raises
    ------
    InputError
        If points are farther away than the limit.
    """
    check_scalars(limit=(limit, "a number"))
    cage = cage_after(weights, cage)
    places = as_points(points, "points", cage.dim)
    given = as_weights(weights, "weights", len(places), len(cage))
    corners = corners_of(places, faces)
    others = as_points(to, "to", cage.dim)
    longest = np.inf if limit is None else limit
    found: Floats = _core.transfer(cage.points, places, corners, given, others, longest)[0]
    return found


def corners_of(points: Floats, faces: Optional[Faces]) -> Any:
    """Triangles, segments, and points without a face, as three corners each."""
    corners = _core.triangles(points, as_polygons(faces, "faces", len(points)))
    alone = np.setdiff1d(np.arange(len(points), dtype=np.int32), corners)
    return np.concatenate([corners, np.stack([alone] * 3, axis=1)])


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

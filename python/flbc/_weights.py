# SPDX-License-Identifier: BSD-3-Clause
"""Using weights: few influences, deformed points, other models, measures."""
from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Optional, Sequence, Union

import numpy as np

from . import _core
from ._errors import InputError
from ._shapes import (
    Cage, DomainMesh, as_array, as_cage, as_floats, as_points, as_polygons, check_scalars,
    each_pose,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ._shapes import CageLike, Faces, Floats

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

    Only `Binding.reduced` keeps masks and an exact mirror.

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
    most = limit_of(k, threshold)
    cage = cage_after(weights, cage)
    places = as_points(points, "points", cage.dim)
    given = as_weights(weights, "weights", len(places), len(cage))
    polygons = None if faces is None else as_polygons(faces, "faces", len(places))
    return from_core(
        _core.sparsify(
            cage.points, places, given, most, threshold, polygons, as_poses(poses, cage)
        )
    )


def limit_of(k: Optional[int], threshold: float) -> int:
    check_scalars(k=(k, "an integer"), threshold=(threshold, "a number"))
    return int(np.iinfo(np.int32).max) if k is None else k


def as_poses(poses: Any, cage: Any) -> Any:
    return [as_points(pose, f"poses[{k}]", cage.dim, len(cage)) for k, pose in enumerate(poses)]


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
    matrix = as_matrix(weights, "weights")
    def move(pose: Any) -> Floats:
        return np.asarray(matrix @ as_points(pose, "control_points", count=matrix.shape[1]))

    return each_pose(control_points, move, matrix.shape[0])


def transfer(
    weights: Weights,
    cage: CageLike,
    points: ArrayLike,
    faces: Faces,
    to: ArrayLike,
    limit: Optional[float] = None,
) -> Floats:
    """Weights for another version of a model, from the nearest place on it.

    Only `Binding.transferred` keeps masks and an exact mirror.

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
    from ._binding import Binding

    found = Binding(weights, cage, points).transferred(to, from_faces=faces, limit=limit)
    dense: Floats = found.weights.toarray()
    return dense


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

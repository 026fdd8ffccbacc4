# SPDX-License-Identifier: BSD-3-Clause
"""Models in their cages: making, checking, and repairing cages."""
from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Dict, List, NamedTuple, Optional

import numpy as np

from . import _core
from ._shapes import (
    Cage, as_array, as_cage, as_floats, as_points, as_polygons, check_scalars,
)
from ._weights import measure

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._shapes import CageLike, Faces
    from ._weights import Weights


class Defect(NamedTuple):
    """A defect that `check` has found."""

    kind: str  #: such as "open", "self-intersection", "outside", or "weights"
    elements: Dict[str, List[int]]  #: numbers of "vertices" and "facets"
    places: NDArray[np.float64]  #: coordinates of these vertices and facet centers
    message: str


def check(
    cage: CageLike, points: Optional[ArrayLike] = None, weights: Optional[Weights] = None
) -> List[Defect]:
    """Finds the defects of a cage, of a model in it, and of weights.

    Parameters
    ----------
    cage : Cage, or what `Cage` accepts
    points : array_like, shape (P, d), optional
        Vertices of a model that should be inside the cage.
    weights : array_like or sparse matrix, shape (P, n), optional
        Weights of these points; `measure` has more about them.

    Returns
    -------
    list of Defect
        Empty if all is well. A defective cage hides defects of model and weights.

    Raises
    ------
    InputError
        If an array has the wrong shape. Defects are returned, not raised.
    """
    cage = as_cage(cage)
    found = []
    for kind, vertices, facets, message in _core.check_cage(cage.points, cage.facets):
        inside = [f for f in facets if cage.facets[f].max(initial=0) < len(cage)]
        centers = cage.points[cage.facets[inside]].mean(axis=1).reshape(-1, cage.dim)
        places = np.concatenate([cage.points[vertices].reshape(-1, cage.dim), centers])
        found.append(Defect(kind, {"vertices": vertices, "facets": facets}, places, message))
    if found or points is None:
        return found
    model = as_points(points, "points", cage.dim)
    which, distances = _core.outside(cage.points, cage.facets, model)
    if which:
        message = (
            f"{len(which)} points are outside the cage; point {which[0]} is the first, and the "
            f"largest distance is {max(distances):.4g}"
        )
        found.append(Defect("outside", {"vertices": which, "facets": []}, model[which], message))
    if weights is not None:
        for message in measure(weights, cage, model)["violations"]:
            nowhere = np.zeros((0, cage.dim))
            found.append(Defect("weights", {"vertices": [], "facets": []}, nowhere, message))
    return found


class Repaired(NamedTuple):
    """A repaired cage and what was changed."""

    cage: Cage
    changes: List[str]  #: one sentence each
    new_numbers: NDArray[np.int32]  #: per original control point; -1 if it was removed


def repair(cage: CageLike) -> Repaired:
    """Repairs a defective cage: welds, orients, closes holes, and wraps as a last resort.

    Parameters
    ----------
    cage : Cage, or what `Cage` accepts

    Returns
    -------
    Repaired
        The new cage, all changes, and the new number of each control point.

    Raises
    ------
    InputError
        If the cage cannot be repaired.
    """
    cage = as_cage(cage)
    arrays, changes, numbers = _core.repair(cage.points, cage.facets)
    return Repaired(Cage(*arrays), changes, np.array(numbers, np.int32))


def border(vertices: ArrayLike, faces: Faces, cage: CageLike) -> NDArray[np.int32]:
    """Control points that must stay at rest where a model passes through its cage.

    Otherwise vertices inside tear away from those outside, which ``bind(outside="keep")`` leaves
    where they are.

    Parameters
    ----------
    vertices : array_like, shape (P, d)
    faces : array_like of int
        Of the model, or of the cells of a volume mesh.
    cage : Cage, or what `Cage` accepts

    Returns
    -------
    ndarray of int
        Ascending; empty if no edge passes through the cage.

    Raises
    ------
    InputError
        If the cage is defective.
    """
    cage = as_cage(cage)
    points = as_points(vertices, "vertices", cage.dim)
    polygons = as_polygons(faces, "faces", len(points))
    return np.array(_core.border(cage.points, cage.facets, points, polygons), np.int32)


def make_cage(
    vertices: ArrayLike,
    faces: Optional[Faces] = None,
    *,
    control_points: int = 0,
    offset: float = 0,
    symmetry: str = "auto",
    density: Optional[ArrayLike] = None,
) -> Cage:
    """Makes a cage around a model, which it encloses strictly.

    Warns if the cage bridges narrow gaps of a 3D model, such as those between fingers.

    Parameters
    ----------
    vertices : array_like, shape (P, d)
    faces : array_like of int, optional
        Faces of the model; rows of two are segments. They may be open or intersect.
    control_points : int, default 0
        Maximum number; 0 to choose it by shape.
    offset : float, default 0
        Distance from the model in its units; 0 to choose it.
    symmetry : str, default "auto"
        Mirror plane of the cage: "auto", "none", "x", "y", "z".
    density : array_like, shape (P,), optional
        Relative density of control points at each vertex, 0.01 to 100: 1 as usual.

    Returns
    -------
    Cage

    Raises
    ------
    InputError
        If the model is a single place, or an array has the wrong shape.
    OptionError
        If an option is out of range.

    Examples
    --------
    >>> vertices, faces = flbc.read_model("meshes/3d/limb_model.obj")
    >>> cage = flbc.make_cage(vertices, faces, control_points=60)
    """
    check_scalars(
        control_points=(control_points, "an integer"),
        offset=(offset, "a number"),
        symmetry=(symmetry, "a name"),
    )
    points = as_points(vertices, "vertices")
    polygons = as_polygons(faces, "faces", len(points))
    densities = as_floats(as_array(() if density is None else density, "density"), "density")
    made, note = _core.make_cage(points, polygons, control_points, offset, symmetry, densities)
    if note:
        warnings.warn(note, stacklevel=2)
    return Cage(*made)

# SPDX-License-Identifier: BSD-3-Clause
"""Cages and domain meshes, and the checks of array arguments."""
from __future__ import annotations

from numbers import Integral, Real
from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._errors import InputError, OptionError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]
    Ints = NDArray[np.int32]
    Polygons = Tuple[Ints, NDArray[np.int64]]
    # A (m, k) array of integers, or rows of different lengths.
    Faces = Union[ArrayLike, Sequence[Sequence[int]]]
    CageLike = Union["Cage", Tuple[ArrayLike, Any], Any]
    MeshLike = Union["DomainMesh", Tuple[ArrayLike, ArrayLike]]


def check_scalars(**values: Any) -> None:
    """Names an argument of the wrong type. None stands for a default. The arguments are tuples of
    a value and its type: "an integer", "a number", or "a name"."""
    types = {"an integer": Integral, "a number": Real, "a name": str}
    for name, (value, wanted) in values.items():
        if value is not None and not isinstance(value, types[wanted]):
            raise OptionError(f"{name} must be {wanted}, not {value!r}")


def as_array(value: Any, name: str) -> NDArray[Any]:
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise InputError(f"{name} is an array with masked entries; fill them, or leave them out")
    try:
        return np.asarray(value)
    except ValueError as error:
        raise InputError(f"{name} is no array; its rows may differ in length: {error}") from None


def as_points(
    value: Any, name: str, dim: int = 0, count: Optional[int] = None, finite: bool = True
) -> Floats:
    """Checks points: (N, dim) real numbers in any layout, dim 2 or 3 if it is 0."""
    array = as_array(value, name)
    wanted = f"({'N' if count is None else count}, {dim or '2 or 3'})"
    fits = array.ndim == 2 and array.shape[1] in ((dim,) if dim else (2, 3))
    if not fits or (count is not None and array.shape[0] != count):
        raise InputError(f"{name} has shape {array.shape}, but needs {wanted}")
    return as_floats(array, name, finite)


def as_floats(array: NDArray[Any], name: str, finite: bool = True) -> Floats:
    """Float64 in C order, without a copy where the array is that already."""
    if array.dtype.kind not in "fiu":
        raise InputError(f"{name} needs real numbers, not {array.dtype}")
    array = np.require(array, np.float64, ["C", "A"])
    if finite and not np.isfinite(array).all():
        raise InputError(f"{name}: row {np.argwhere(~np.isfinite(array))[0][0]} is not finite")
    return array


def as_indices(array: NDArray[Any], name: str, count: int, starts: Any = None) -> Ints:
    """Vertex numbers in [0, count) as int32, never rounded or wrapped. For messages, rows of a flat
    array begin at the starts."""
    if array.size == 0:
        return np.zeros(array.shape, np.int32)
    if array.dtype.kind not in "iu":
        raise InputError(f"{name} needs integers, not {array.dtype}")
    wrong = (array < 0) | (array >= count)
    if wrong.any():
        place = tuple(np.argwhere(wrong)[0])
        row = place[0] if starts is None else int(np.searchsorted(starts, place[0], "right")) - 1
        raise InputError(
            f"{name}: row {row} refers to vertex {array[place]}, but vertices are numbered "
            f"from 0 to {count - 1}"
        )
    return np.require(array, np.int32, ["C", "A"])


def as_polygons(value: Any, name: str, count: int) -> Polygons:
    """All corners of polygons in one array, and the offsets at which each begins."""
    rows = () if value is None else value
    if getattr(rows, "ndim", 0) == 2 or len({getattr(row, "__len__", int)() for row in rows}) <= 1:
        array = as_array(rows, name)
        if array.size == 0:
            return np.zeros(0, np.int32), np.zeros(1, np.int64)
        if array.ndim != 2:
            raise InputError(f"{name} has shape {array.shape}, but needs (m, k)")
        corners = as_indices(array, name, count).reshape(-1)
        return corners, np.arange(len(array) + 1, dtype=np.int64) * array.shape[1]
    rows = [as_array(row, name) for row in rows]
    if any(row.ndim != 1 or row.size == 0 for row in rows):
        raise InputError(f"{name} needs one row of vertex numbers per face")
    starts = np.cumsum([0, *(row.size for row in rows)], dtype=np.int64)
    return as_indices(np.concatenate(rows), name, count, starts), starts


def as_lists(polygons: Polygons) -> Faces:
    """Polygons as users have them: an (m, k) array, or lists where their lengths differ."""
    corners, starts = polygons
    lengths = np.diff(starts)
    if len(lengths) == 0:
        return np.zeros((0, 3), np.int32)
    if (lengths == lengths[0]).all():
        return corners.reshape(-1, lengths[0])
    return [part.tolist() for part in np.split(corners, starts[1:-1])]


def frozen(array: NDArray[Any]) -> NDArray[Any]:
    array.setflags(write=False)
    return array


class _Points:
    __slots__ = ()
    points: Floats

    @property
    def dim(self) -> int:
        """The dimension, 2 or 3."""
        return int(self.points.shape[1])

    def __len__(self) -> int:
        return len(self.points)


class Cage(_Points):
    """A cage: a closed polygon in 2D or a closed surface in 3D.

    Parameters
    ----------
    points : array_like, shape (n, 2) or (n, 3), or an object with vertices and faces
        Control points in any unit of length. One argument may also be a pair
        ``(points, facets)``, an object with ``vertices`` and ``faces``, such as a mesh of
        trimesh, or a mesh of meshio.
    facets : array_like of int, optional
        3D: faces, an (m, k) array or rows of different lengths. Polygons with more than three
        corners are triangulated. 2D: edges, shape (m, 2), or closed loops of three or more
        control points each; the default is one loop through all points in order.

    Attributes
    ----------
    points : ndarray, shape (n, d), float64, read-only
    facets : ndarray, shape (m, d), int32, read-only
        Edges in 2D and triangles in 3D.

    Raises
    ------
    InputError
        If a shape, type, or vertex number is invalid. Other defects of a cage, such as holes,
        are found by `check` and by all functions that use the cage.
    """

    __slots__ = ("points", "facets")
    points: Floats
    facets: Ints

    def __init__(self, points: Any, facets: Any = None) -> None:
        if facets is None:
            points, facets = parts_of(points)
        self.points = frozen(as_points(points, "points", finite=False).copy())
        self.facets = frozen(self._facets_of(facets))

    def _facets_of(self, facets: Any) -> Ints:
        if facets is None:
            if self.dim == 3:
                raise InputError("facets are missing: a cage in 3D needs its faces")
            facets = [range(len(self.points))]
        polygons = as_polygons(facets, "facets", len(self.points))
        lengths = np.diff(polygons[1])
        if len(lengths) and lengths.min() < self.dim:
            raise InputError(
                f"facets: row {int(lengths.argmin())} has {lengths.min()} control points, but "
                f"needs at least {self.dim}"
            )
        if self.dim == 2:
            return _edges_in_order(polygons)
        if not len(lengths) or (lengths == 3).all():
            return polygons[0].reshape(-1, 3).copy()
        return _core.triangles(self.points, polygons)

    def __repr__(self) -> str:
        kind = "edges" if self.dim == 2 else "triangles"
        return f"<flbc.Cage: {len(self)} control points, {len(self.facets)} {kind}>"

    def __reduce__(self) -> Any:
        return Cage, (self.points, self.facets)


def parts_of(value: Any) -> Any:
    if isinstance(value, Cage):
        return value.points, value.facets
    if hasattr(value, "vertices") and hasattr(value, "faces"):
        return value.vertices, value.faces
    if hasattr(value, "cells_dict"):  # of meshio
        kinds = ["line"] if value.points.shape[1] == 2 else ["triangle", "quad"]
        return value.points, [row for kind in kinds for row in value.cells_dict.get(kind, [])]
    if isinstance(value, tuple) and len(value) == 2 and as_array(value[0], "points").ndim == 2:
        return value
    return value, None


def _edges_in_order(polygons: Polygons) -> Ints:
    corners, starts = polygons
    lengths = np.diff(starts)
    following = np.arange(1, len(corners) + 1)
    following[starts[1:] - 1] = starts[:-1]
    edges = np.stack([corners, corners[following]], axis=1)
    # A row of two is one edge, not a loop of two.
    repeated = starts[1:][lengths == 2] - 1
    return np.ascontiguousarray(np.delete(edges, repeated, axis=0))


class DomainMesh(_Points):
    """A mesh of the interior of a cage: triangles in 2D, tetrahedra in 3D.

    Parameters
    ----------
    points : array_like, shape (V, d)
        Vertices in the units of the cage. Control points must be among them, in any place.
    cells : array_like of int, shape (F, d + 1)
        Vertices of each cell, in any orientation.

    Attributes
    ----------
    points : ndarray, shape (V, d), float64, read-only
    cells : ndarray, shape (F, d + 1), int32, read-only
        Positively oriented.

    Raises
    ------
    InputError
        Naming the element, if a cell is degenerate, a vertex belongs to no cell, or cells
        overlap at a facet.
    """

    __slots__ = ("points", "cells")
    points: Floats
    cells: Ints

    def __init__(self, points: ArrayLike, cells: ArrayLike) -> None:
        vertices = as_points(points, "points")
        corners = as_array(cells, "cells")
        dim = vertices.shape[1]
        if corners.ndim != 2 or corners.shape[1] != dim + 1:
            raise InputError(
                f"cells has shape {corners.shape}, but needs (F, {dim + 1}) for points of shape "
                f"{vertices.shape}"
            )
        indices = as_indices(corners, "cells", len(vertices))
        self._take(_core.normalized_mesh(vertices, indices))

    def _take(self, arrays: Tuple[Floats, Ints]) -> DomainMesh:
        self.points, self.cells = frozen(arrays[0]), frozen(arrays[1])
        return self

    def __repr__(self) -> str:
        kind = "triangles" if self.dim == 2 else "tetrahedra"
        return f"<flbc.DomainMesh: {len(self)} vertices, {len(self.cells)} {kind}>"

    def __reduce__(self) -> Any:
        return DomainMesh, (self.points, self.cells)


def mesh_from(arrays: Tuple[Floats, Ints]) -> DomainMesh:
    """A mesh that the library has made, which is valid."""
    return DomainMesh.__new__(DomainMesh)._take(arrays)


def as_cage(value: CageLike) -> Cage:
    return value if isinstance(value, Cage) else Cage(value)


def as_mesh(value: MeshLike, cage: Cage) -> DomainMesh:
    mesh = value if isinstance(value, DomainMesh) else DomainMesh(*value)
    if mesh.dim != cage.dim:
        raise InputError(
            f"mesh has points of shape {mesh.points.shape}, but cage has control points of shape "
            f"{cage.points.shape}"
        )
    return mesh


class Model(NamedTuple):
    """The surface in a file; ``vertices, faces = read_model(path)`` works too."""

    vertices: Floats
    faces: Faces

# SPDX-License-Identifier: BSD-3-Clause
"""Models in their cages: making, checking, repairing, binding, showing."""
from __future__ import annotations

import html
import warnings
from typing import TYPE_CHECKING, Any, Dict, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._errors import InputError, OptionError
from ._shapes import (
    Cage,
    as_array,
    as_cage,
    as_mesh,
    as_points,
    as_polygons,
    check_scalars,
    edges_of,
    posed_points,
)
from ._solve import (
    SolverOptions,
    as_locality,
    checked,
    mesh,
    take_phi,
    warn_unless_converged,
    with_options,
)
from ._weights import as_poses, as_weights, corners_of, deform, from_core, measure

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike, NDArray
    from typing_extensions import Unpack

    from ._shapes import CageLike, Faces, Floats, MeshLike
    from ._solve import Callback
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
) -> Cage:
    """Makes a cage around a model, which it encloses strictly.

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
    if points.shape[1] == 2:
        facets = edges_of(as_polygons(faces, "faces", len(points)))
    else:
        facets = corners_of(points, faces)
    return Cage(*_core.make_cage(points, facets, control_points, offset, symmetry))


class Binding:
    """Weights of a model, from `bind`.

    Attributes
    ----------
    weights : scipy.sparse.csr_matrix, shape (P, n)
    offsets : ndarray, shape (P, d), or None
        What is added after deforming, for vertices outside the cage.
    cage : Cage
    report : dict
        Of the solve.
    outside : ndarray of int
        Vertices outside the cage.
    """

    __slots__ = ("weights", "offsets", "cage", "report", "outside")

    def __init__(
        self,
        weights: Weights,
        offsets: Optional[Floats],
        cage: Cage,
        report: Dict[str, Any],
        outside: Any,
    ) -> None:
        self.weights, self.offsets, self.cage = weights, offsets, cage
        self.report, self.outside = report, outside

    def deform(self, control_points: CageLike) -> Floats:
        """The vertices of the model, shape (P, d), for moved control points: a Cage, or an array of
        shape (n, d). For a stack of poses, shape (T, n, d), the result has shape (T, P, d)."""
        cage, posed = self.cage, posed_points(control_points)
        if posed.ndim == 3:
            return np.array([self.deform(pose) for pose in posed])
        moved = deform(self.weights, as_points(posed, "control_points", cage.dim, len(cage)))
        if self.offsets is not None:
            moved += self.offsets
        return moved

    def __repr__(self) -> str:
        points, controls = self.weights.shape
        return f"<flbc.Binding: {points} points, {controls} control points>"

    def __reduce__(self) -> Any:
        return Binding, (self.weights, self.offsets, self.cage, self.report, self.outside)


@with_options
def bind(
    vertices: ArrayLike,
    faces: Optional[Faces],
    control_points: CageLike,
    cage_faces: Any = None,
    *,
    mesh_vertices: Optional[int] = None,
    domain: Optional[MeshLike] = None,
    max_influences: int = 8,
    outside: str = "fail",
    symmetric: Optional[str] = None,
    callback: Callback = None,
    **options: Unpack[SolverOptions],
) -> Binding:
    """Binds a model to a cage in one call: meshes, solves, evaluates, and reduces influences.

    Parameters
    ----------
    vertices : array_like, shape (P, d)
    faces : array_like of int, or None
        Influences are reduced without seams along their edges.
    control_points, cage_faces
        The cage: arrays for `Cage`, or a Cage as `control_points` alone.
    mesh_vertices : int, optional
        Number of vertices of the domain mesh; default as for `mesh`.
    domain : DomainMesh, optional
        A given mesh of the cage interior.
    max_influences : int, default 8
        Per vertex; 0 to keep all weights.
    outside : str, default "fail"
        For vertices outside the cage: "fail"; "nearest", to follow the nearest point of the
        cage at a constant offset; "keep", to stay where they are, without weights; or "extend",
        to follow an affine map of the control points around them. These vertices keep all their
        weights, of which some are negative, whatever `max_influences` is.
    symmetric : str, optional
        "x", "y", or "z": weights of mirrored vertices are exactly alike, in a cage that is
        symmetric across this axis.

    callback : callable, optional
        As for `solve`.

    Other Parameters
    ----------------
    {options}

    Returns
    -------
    Binding

    Raises
    ------
    InputError
        Naming the defect of cage or model.
    OptionError
        If an option is out of range.
    """
    given = checked(options, "bind")
    if given.get("method") == "bbw":
        raise OptionError(
            "method 'bbw': a binding needs weights that reproduce the model, which bounded "
            "biharmonic weights do not; choose another method"
        )
    check_scalars(
        mesh_vertices=(mesh_vertices, "an integer"),
        max_influences=(max_influences, "an integer"),
        outside=(outside, "a name"),
    )
    cage = as_cage(control_points) if cage_faces is None else Cage(control_points, cage_faces)
    axes = ["x", "y", "z"][: cage.dim]
    if symmetric is not None and symmetric not in axes:
        raise OptionError(f"symmetric must be one of {', '.join(axes)}, not {symmetric!r}")
    points = as_points(vertices, "vertices", cage.dim)
    if len(points) == 0:
        raise InputError("vertices has shape (0, d): the model has no vertices")
    polygons = as_polygons(faces, "faces", len(points))
    as_locality(given, len(points), cage)
    if domain is None and np.ndim(given.get("phi", "")) > 0:
        domain = mesh(cage, mesh_vertices)
    fill = None if domain is None else as_mesh(domain, cage)
    phi = None if fill is None else take_phi(given, cage, fill)
    parts, report, note, offsets, which = _core.bind_model(
        cage.points, cage.facets, None if fill is None else (fill.points, fill.cells),
        mesh_vertices, points, polygons, given, phi, max_influences, outside,
        -1 if symmetric is None else axes.index(symmetric), callback,
    )
    if note:
        warnings.warn(note, stacklevel=2)
    warn_unless_converged(report, stacklevel=3)
    return Binding(from_core(parts), offsets, cage, report, np.array(which, np.int32))


class Page:
    """A page in which the cage can be dragged; notebooks show it.

    Attributes
    ----------
    html : str
        The page, which needs no other file and no network.
    """

    __slots__ = ("html",)

    def __init__(self, html: str) -> None:
        self.html = html

    def save(self, path: "str | os.PathLike[str]") -> None:
        """Writes the page to a file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" style="width:100%;height:600px;border:0">'
            "</iframe>"
        )


def _model(
    vertices: Any, faces: Any, weights: Any, cage: Cage, poses: Any
) -> Tuple[Floats, Any, Any, Any]:
    places = as_array(vertices, "vertices")
    if cage.dim == 2 and places.ndim == 2 and not places[:, 2:].any():
        places = places[:, :2]  # as files have them, with z = 0
    points = as_points(places, "vertices", cage.dim)
    polygons = as_polygons(faces, "faces", len(points))
    given = as_weights(weights, "weights", len(points), len(cage))
    error = _core.misplacement(cage.points, cage.facets, points, given)
    if error > 1e-6 * np.linalg.norm(np.ptp(cage.points, axis=0)):
        raise InputError(
            f"weights do not belong to this model and cage: they put a vertex {error:.3g} away "
            "from its place"
        )
    return points, polygons, given, as_poses(poses, "poses", cage)


def view(
    vertices: ArrayLike,
    faces: Optional[Faces],
    weights: Weights,
    cage: CageLike,
    *,
    poses: Sequence[ArrayLike] = (),
    title: str = "model",
) -> Page:
    """Makes a page in which you drag the cage and the model follows.

    Parameters
    ----------
    vertices : array_like, shape (P, d)
    faces : array_like of int, or None to show points
    weights : array_like or sparse matrix, shape (P, n)
        The page shows at most 16 influences per vertex.
    cage : Cage, or what `Cage` accepts
    poses : sequence of array_like, shape (n, d)
        Poses of the cage to choose from.
    title : str, default "model"

    Returns
    -------
    Page
        A notebook shows it; ``page.save("model.html")`` writes a file for any browser.

    Raises
    ------
    InputError
        If the shapes of vertices, weights, cage, and poses do not match.
    """
    cage = as_cage(cage)
    points, polygons, given, moved = _model(vertices, faces, weights, cage, poses)
    return Page(
        _core.make_page(cage.points, cage.facets, points, polygons, given, moved, title)
    )


def export(
    path: "str | os.PathLike[str]",
    vertices: ArrayLike,
    faces: Faces,
    weights: Weights,
    cage: CageLike,
    *,
    poses: Sequence[ArrayLike] = (),
    times: Optional[Sequence[float]] = None,
    max_influences: int = 8,
    name: str = "model",
) -> None:
    """Writes a skin for engines: each control point is a joint that only translates.

    Parameters
    ----------
    path : str or path
        A file that ends in .glb or .usda.
    vertices : array_like, shape (P, d)
    faces : array_like of int
    weights : array_like or sparse matrix, shape (P, n)
    cage : Cage, or what `Cage` accepts
    poses : sequence of array_like, shape (n, d)
        An animation.
    times : sequence of float, optional
        Seconds of these poses, ascending. Default: 24 poses per second.
    max_influences : int, default 8
        Per vertex, 4 or 8.
    name : str, default "model"
        Of the mesh in the file.

    Raises
    ------
    IoError
        If the file cannot be written.
    OptionError
        For another extension or number of influences.
    """
    cage = as_cage(cage)
    points, polygons, given, moved = _model(vertices, faces, weights, cage, poses)
    seconds = [k / 24 for k in range(len(moved))] if times is None else list(times)
    _core.export_skin(
        str(path), cage.points, cage.facets, points, polygons, given, seconds, moved,
        max_influences, name,
    )

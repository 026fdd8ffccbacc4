# SPDX-License-Identifier: BSD-3-Clause
"""Bindings of models to cages, how they are made, and files and pages of them."""
from __future__ import annotations

import html
import warnings
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._cells import largest_step
from ._errors import InputError, OptionError
from ._shapes import (
    Cage, DomainMesh, as_array, as_cage, as_indices, as_mesh, as_points, as_polygons, check_scalars, frozen,
    mesh_from, parts_of,
)
from ._solve import (
    RigOptions, Solution, Solver, as_masks, checked, warn_unless_converged, with_options,
)
from ._weights import as_matrix, as_weights, cage_after, from_core

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike, NDArray
    from scipy.sparse import csr_matrix
    from typing_extensions import Unpack

    from ._shapes import CageLike, Faces, Floats, Ints, MeshLike
    from ._solve import Callback
    from ._weights import Weights


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
        """Writes the page to an .html file."""
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{html.escape(self.html)}" style="width:100%;height:600px;border:0">'
            "</iframe>"
        )


class Binding:
    """A model bound to a cage: weights with all that belongs to them.

    What is made of a binding keeps what it promises: masked weights stay exactly 0, mirrored ones
    bit-identical, rows sum to 1, and vertices outside the cage do what was chosen. `bind`, `Rig`,
    and `load_binding` return bindings. The constructor makes one by weights from elsewhere: what
    they do not reproduce becomes offsets, and vertices without weights stay where they are. A
    binding does not change; it can be pickled.

    Parameters
    ----------
    weights : array_like or sparse matrix, shape (P, n)
    cage : Cage, or what `Cage` accepts
    points : array_like, shape (P, d)
        Vertices of the model at rest.
    faces : array_like of int, optional
        Influences are reduced without seams along their edges.
    mask : optional
        As for `bind`; these weights must be 0.

    Attributes
    ----------
    weights : scipy.sparse.csr_matrix, shape (P, n), read-only
    offsets : ndarray, shape (P, d), or None
        What is added after deforming, for vertices outside the cage.
    cage : Cage
        At rest.
    points : ndarray, shape (P, d)
        Vertices of the model at rest.
    outside : ndarray of int
        Vertices outside the cage.
    masks : list of tuple
        Pairs of indices, ``(control_points, vertices)``, of weights that stay 0. They end at the
        facets of these control points.
    solid : list of ndarray of int
        Vertices of each region that moves by one affine map.
    held : ndarray of int
        Control points that must stay at rest (`joined`).
    report : dict
        Of the solve, with ``note``: what differs from the request. A file has a part of it.
    solution : Solution or None
        On the domain mesh, if there is one.

    Raises
    ------
    InputError
        If shapes do not match, or a masked weight is not 0.
    """

    __slots__ = (
        "weights", "offsets", "cage", "points", "outside", "masks", "solid", "held", "report",
        "solution",
        "_any"
    )
    weights: csr_matrix
    offsets: Optional[Floats]
    cage: Cage
    points: Floats
    outside: Ints
    masks: List[Tuple[Ints, Ints]]
    solid: List[Ints]
    held: Ints
    report: Dict[str, Any]
    solution: Optional[Solution]
    _any: _core.Binding

    def __init__(
        self,
        weights: Weights,
        cage: CageLike,
        points: ArrayLike,
        faces: Optional[Faces] = None,
        mask: Any = None,
    ) -> None:
        cage = cage_after(weights, cage)
        places = as_points(points, "points", cage.dim)
        given = as_weights(weights, "weights", len(places), len(cage))
        polygons = as_polygons(faces, "faces", len(places))
        masks = [] if mask is None else as_masks(mask, len(places), cage)
        core = _core.Binding(cage.points, cage.facets, places, given, polygons, masks)
        self._take(core, core.arrays())

    def _take(self, core: _core.Binding, arrays: Dict[str, Any]) -> Binding:
        parts, domain, proof = (arrays.pop(k, None) for k in ("domain_weights", "domain", "proof"))
        arrays["cage"], arrays["weights"] = Cage(*arrays["cage"]), from_core(arrays["weights"])
        arrays["solution"] = domain and Solution(
            parts, arrays["cage"], mesh_from(domain), arrays["report"], proof
        )
        for array in (arrays["weights"].data, arrays["points"], arrays["offsets"]):
            if array is not None:
                frozen(array)
        for name, value in arrays.items():
            object.__setattr__(self, name, value)
        object.__setattr__(self, "_any", core)
        return self

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a Binding does not change; its methods return others")

    @property
    def domain(self) -> Optional[DomainMesh]:
        """DomainMesh or None: the mesh of the interior of the cage, if there is one."""
        return self.solution.mesh if self.solution else None

    def _pose(self, control_points: Any, name: str = "control_points") -> Floats:
        points = control_points.points if isinstance(control_points, Cage) else control_points
        return as_points(points, name, self.cage.dim, len(self.cage))

    def _poses(self, poses: Any) -> List[Floats]:
        return [self._pose(pose, f"poses[{k}]") for k, pose in enumerate(poses)]

    def deform(
        self,
        control_points: CageLike,
        *,
        joint: Optional[str] = None,
        out: Optional[Floats] = None,
    ) -> Floats:
        """The vertices of the model, shape (P, d), for moved control points: a Cage, or an array of
        shape (n, d). For a stack of poses, shape (T, n, d), the result has shape (T, P, d).
        Vertices whose control points rest stay where they are, to the bit. `joint` is that of
        `joined`. `out` receives the result: a C-contiguous array of that shape, float64."""
        if joint is not None:
            return self.joined(joint).deform(control_points, out=out)
        given = control_points.points if isinstance(control_points, Cage) else control_points
        array = as_array(given, "control_points")
        is_pose = array.ndim != 3
        poses = [self._pose(pose) for pose in (array[None] if is_pose else array)]
        shape = self.points.shape if is_pose else (len(poses), *self.points.shape)
        moved = np.empty(shape) if out is None else out
        if not (isinstance(moved, np.ndarray) and moved.shape == shape and moved.dtype == np.float64
                and moved.flags.c_contiguous and moved.flags.writeable):
            raise InputError(f"out must be a C-contiguous, writable array of float64 and shape {shape}")
        places: Any = moved.reshape(len(poses), *self.points.shape)
        for pose, place in zip(poses, places):
            self._any.deform_into(pose, place)
        return moved

    def deform_drawing(self, svg: str, control_points: CageLike) -> str:
        """The document of a drawing, the text of an .svg file, for moved control points.

        Only geometry changes, and elements outside the cage stay. Units are those of the drawing,
        with the y axis up from its lower edge, as `read_model` reads it. A warning names what does
        not bend. The binding must be in 2D and have a domain mesh."""
        moved, notes = self._any.deform_drawing(svg, self._pose(control_points))
        if notes:
            warnings.warn(f"not bent: {'; '.join(notes)}", stacklevel=2)
        return moved

    def deform_picture(
        self,
        picture: ArrayLike,
        control_points: CageLike,
        *,
        scale: float = 1,
        size: Optional[Tuple[float, float]] = None,
    ) -> Tuple[NDArray[Any], Tuple[int, int]]:
        """A picture for moved control points, as an array of the same type, and its offset.

        `picture` has shape (height, width) or (height, width, channels), uint8 or uint16, with 1 to
        4 channels: gray or red, green, blue, then alpha if there is one. The result has alpha, and
        `scale` pixels per pixel. It is larger where pixels move beyond the edge; the offset is that
        of its upper left corner, (right, down) in pixels of the result.

        `size` is the width and height of the picture in units of the cage, by default a unit per
        pixel. Its lower left corner is at the origin. Pixels outside the cage stay. The binding must
        be in 2D and have a domain mesh."""
        check_scalars(scale=(scale, "a number"))
        array = as_array(picture, "picture")
        samples = array[..., None] if array.ndim == 2 else array
        if array.dtype not in (np.uint8, np.uint16) or samples.ndim != 3 or not (
            samples.size > 0 and samples.shape[2] <= 4
        ):
            raise InputError(f"picture has shape {array.shape} and type {array.dtype}, but needs "
                             "(height, width, 1 to 4 channels) and uint8 or uint16")
        if samples.shape[2] % 2:
            opaque = np.full_like(samples[..., :1], np.iinfo(array.dtype).max)
            samples = np.concatenate([samples, opaque], axis=2)
        return self._any.deform_picture(
            np.ascontiguousarray(samples), self._pose(control_points), scale, size or (0, 0))

    def jacobians(self, control_points: CageLike) -> Floats:
        """The Jacobians of a deformation at the vertices, shape (P, d, d), from smooth gradients on
        the domain mesh, which the binding must have. Entry ``[p, k, j]`` is the derivative of
        coordinate k in direction j. Vertices that do not move have the identity."""
        d = self.cage.dim
        columns = self._any.jacobians(self._pose(control_points)).reshape(-1, d, d)
        return np.ascontiguousarray(columns.transpose(0, 2, 1))

    def reduced(
        self, k: Optional[int] = 8, *, threshold: float = 0, poses: Sequence[ArrayLike] = ()
    ) -> Binding:
        """At most `k` influences per vertex, at least d + 1; None for no limit. Smaller weights than
        `threshold`, in [0, 1), are dropped first, where the others can reproduce the vertex. The
        error is minimized for `poses`, arrays of shape (n, d), if given. Vertices outside with
        ``outside="extend"`` keep all their weights."""
        check_scalars(k=(k, "an integer"), threshold=(threshold, "a number"))
        most = int(np.iinfo(np.int32).max) if k is None else k
        return _binding(self._any.reduced(most, threshold, self._poses(poses)))

    def transferred(
        self,
        points: ArrayLike,
        faces: Optional[Faces] = None,
        *,
        outside: str = "fail",
        from_faces: Optional[Faces] = None,
        limit: Optional[float] = None,
    ) -> Binding:
        """The binding of another model in the same cage, with all influences: of `points`, shape
        (Q, d), and their `faces`. A weight is masked where it is masked all around.

        Weights are evaluated on the domain mesh, with `outside` as for `bind`. With `from_faces`,
        the faces of this model, they come from the nearest place on it instead, within `limit` in
        units of the cage. Raises InputError for points that are outside or too far."""
        check_scalars(outside=(outside, "a name"), limit=(limit, "a number"))
        if limit is not None and from_faces is None:
            raise OptionError("limit needs from_faces, the faces of this model")
        to = as_points(points, "points", self.cage.dim)
        polygons = as_polygons(faces, "faces", len(to))
        known = len(self.points)
        of_this = None if from_faces is None else as_polygons(from_faces, "from_faces", known)
        longest = np.inf if limit is None else limit
        return _binding(self._any.transferred(to, polygons, outside, of_this, longest))

    def composed(self, map: Weights, cage: Any) -> Binding:
        """The binding to m other control points, which move those of this binding.

        `map`, shape (n, m), has the weights of the n control points: at least 0, with rows that
        sum to 1 and reproduce these. `cage` is a Cage, or an array of shape (m, d). The result has
        no domain mesh. Raises InputError if the binding is mirrored."""
        points, facets = parts_of(cage)
        if facets is None:
            facets = np.zeros((0, self.cage.dim), np.int32)
        outer = cage if isinstance(cage, Cage) else Cage(points, facets)
        if outer.dim != self.cage.dim:
            raise InputError(f"cage has points of shape {outer.points.shape}, but needs "
                             f"(m, {self.cage.dim})")
        shares = as_weights(as_matrix(map, "map"), "map", len(self.cage), len(outer))
        return _binding(self._any.composed(shares, outer.points, outer.facets))

    def skin(self, bones: Weights, *, influences: Optional[int] = None) -> csr_matrix:
        """The skin of the model if bones skin the cage: the product of `weights` and `bones`.

        `bones`, shape (n, m), has the weights of the n control points for m bones: at least 0, with
        rows that sum to 1. The result is sparse, of shape (P, m), at least 0, with rows that sum to
        1, except for vertices without weights, whose rows are empty. With `influences`, each vertex
        keeps that many of its largest weights, which are scaled. Raises InputError naming the first
        control point with other weights."""
        check_scalars(influences=(influences, "an integer"))
        if influences is not None and influences < 1:
            raise OptionError("influences must be at least 1, or None for all")
        matrix = as_matrix(bones, "bones")
        if matrix.shape[0] != len(self.cage):
            raise InputError(f"bones has shape {matrix.shape}, but needs a row for each of the "
                             f"{len(self.cage)} control points")
        shares = as_weights(matrix, "bones", *matrix.shape)
        return from_core(self._any.skin(shares, influences or 0))

    def joined(self, joint: str = "smooth") -> Binding:
        """The binding with a smooth end of the deformation where the mesh passes through the cage
        and vertices outside stay (``outside="keep"``).

        The control points of the facets there are `held`: a pose that moves one is refused. With
        the sum m of the weights of all others, their displacement is multiplied by
        ``s(min(1, m / mass))``, where ``s(t) = t (2 - t)`` for "smooth" and ``6 t^2 - 8 t^3 + 3 t^4``
        for "curvature". "smooth:0.3" sets the mass, in (0, 1], by default 0.5. Raises InputError if
        no edge of the model passes through the cage."""
        return _binding(self._any.joined(joint))

    def adjoint(self, gradients: ArrayLike, *, joint: Optional[str] = None) -> Floats:
        """The derivatives of an objective by the control points, shape (n, d), from its derivatives
        by the vertices, shape (P, d): the exact transpose of `deform`. Those of held control points
        are 0."""
        if joint is not None:
            return self.joined(joint).adjoint(gradients)
        return self._any.adjoint(as_points(gradients, "gradients", self.cage.dim, len(self.points)))

    def fit(
        self,
        targets: ArrayLike,
        *,
        points: Optional[ArrayLike] = None,
        hold: ArrayLike = (),
        stiffness: float = 1e-5,
    ) -> Tuple[Cage, Dict[str, float]]:
        """The pose of the cage that moves vertices to `targets`, by least squares.

        `targets` has shape (P, d), or a row for each of the indices `points`. The control points
        `hold` stay at rest. `stiffness`, at least 0, makes neighbors in the cage move alike where
        targets do not determine them. Returns the pose and a dict: ``rms`` and ``largest`` of the
        distances that are left, ``worst``, the vertex with the largest, and ``condition`` of the
        equations. Raises InputError if the targets do not determine the pose."""
        check_scalars(stiffness=(stiffness, "a number"))
        which: Any = as_indices(as_array(() if points is None else points, "points"), "points",
                                len(self.points)).tolist()
        held: Any = as_indices(as_array(hold, "hold"), "hold", len(self.cage)).tolist()
        count = len(self.points) if points is None else len(which)
        to = as_points(targets, "targets", self.cage.dim, count)
        pose, facts = self._any.fit(to, which, held, stiffness)
        return Cage(pose, self.cage.facets), facts

    def largest_step(
        self, control_points: CageLike, cells: ArrayLike, *, at_least: float = 0.1
    ) -> float:
        """The largest part of the way to a pose, from 0 to 1, up to which all cells of the model
        keep at least this `cell_quality` ``jacobian``: ``rest + t * (pose - rest)`` is a pose of
        the cage that keeps them. It is found by 33 steps and bisection."""
        check_scalars(at_least=(at_least, "a number"))
        if not 0 <= at_least < 1:
            raise OptionError("at_least must be at least 0 and less than 1")
        moves = self._pose(control_points) - self.cage.points
        return largest_step(lambda t: self.deform(self.cage.points + t * moves), self.points, cells,
                            at_least)

    def export(
        self,
        path: "str | os.PathLike[str]",
        faces: Faces,
        *,
        poses: Sequence[ArrayLike] = (),
        times: Optional[Sequence[float]] = None,
        max_influences: int = 8,
        rigid: bool = False,
        name: str = "model",
    ) -> None:
        """Writes a skin for engines to a file that ends in .glb or .usda: each control point is a
        joint that only translates. Vertices have at most `max_influences`, 4 or 8. With `rigid`,
        each solid region has a joint of its own, which turns it without distortion.

        `poses`, arrays of shape (n, d), become an animation at `times` in seconds, ascending, or 24
        per second. `name` is that of the mesh in the file. Raises IoError if the file cannot be
        written, OptionError for another extension or number of influences, and InputError if there
        is no solid region to be `rigid`."""
        moved = self._poses(poses)
        seconds = [k / 24 for k in range(len(moved))] if times is None else list(times)
        polygons = as_polygons(faces, "faces", len(self.points))
        _core.export_skin(self._any, str(path), polygons, seconds, moved, max_influences, bool(rigid),
                          name)

    def view(
        self,
        faces: Optional[Faces] = None,
        *,
        poses: Sequence[ArrayLike] = (),
        title: str = "model",
    ) -> Page:
        """Makes a page in which you drag the cage and the model follows, with at most 16 influences
        per vertex. Without `faces`, it shows points. The `poses` of the cage, arrays of shape
        (n, d), can be chosen. A notebook shows the page; its ``save("model.html")`` writes a file
        for any browser."""
        polygons = as_polygons(faces, "faces", len(self.points))
        return Page(_core.make_page(self._any, polygons, self._poses(poses), title))

    def save(self, path: "str | os.PathLike[str]") -> None:
        """Writes the binding to a file for `load_binding` and all commands of the program.

        Parameters
        ----------
        path : str or path
            A file that ends in .npz, an archive of NumPy arrays; `scipy.sparse.load_npz` reads its
            weights.

        Raises
        ------
        IoError
            If the file cannot be written.
        """
        if not str(path).endswith(".npz"):
            raise OptionError(f"{path}: a binding is a file that ends in .npz")
        self._any.save(str(path))

    def __repr__(self) -> str:
        points, controls = self.weights.shape
        return f"<flbc.Binding: {points} points, {controls} control points>"

    def __reduce__(self) -> Any:
        proof = self.solution._proof if self.solution else None
        return _restored, (self._any.content(), self.report, proof)


def _binding(core: _core.Binding, **other: Any) -> Binding:
    return Binding.__new__(Binding)._take(core, {**core.arrays(), **other})


def _restored(content: bytes, report: Dict[str, Any], proof: Any) -> Binding:
    return _binding(_core.binding_of(content), report=report, proof=proof)


def load_binding(path: "str | os.PathLike[str]") -> Binding:
    """Reads a binding from the `path` of a file, .npz, by `Binding.save` or the program.

    Returns
    -------
    Binding
    """
    return _binding(_core.load_binding(str(path)))


@with_options
class Rig(Solver):
    """A model in a cage whose rest shape, options, and model may change.

    A new pose needs nothing, a new model no solve, and a new rest cage, tolerance, smoothness, or
    mask a solve that resumes. One thread at a time may use a Rig. `bind` uses one once.

    Parameters
    ----------
    cage : Cage, or what `Cage` accepts
    vertices : array_like, shape (P, d)
    faces : array_like of int, optional
        Influences are reduced without seams along their edges.
    mesh_vertices, domain
        As for `bind`.
    {model options}

    Other Parameters
    ----------------
    {options}
    """

    _kind = RigOptions

    def __init__(
        self,
        cage: CageLike,
        vertices: ArrayLike,
        faces: Optional[Faces] = None,
        *,
        mesh_vertices: Optional[int] = None,
        domain: Optional[MeshLike] = None,
        **options: Unpack[RigOptions],
    ) -> None:
        check_scalars(mesh_vertices=(mesh_vertices, "an integer"))
        if options.get("method") == "bbw":
            raise OptionError(
                "method 'bbw': a binding needs weights that reproduce the model, which bounded "
                "biharmonic weights do not; choose another method"
            )
        cage = as_cage(cage)
        fill = None if domain is None else as_mesh(domain, cage)
        model = self._model(cage, vertices, faces)
        self._start(cage, fill, mesh_vertices, model, options)

    @staticmethod
    def _model(cage: Cage, vertices: Any, faces: Any) -> Tuple[Floats, Any]:
        points = as_points(vertices, "vertices", cage.dim)
        if len(points) == 0:
            raise InputError("vertices has shape (0, d): the model has no vertices")
        return points, as_polygons(faces, "faces", len(points))

    def set_model(self, vertices: ArrayLike, faces: Optional[Faces] = None) -> None:
        """Takes another model, which needs a solve only with masks. These stay, by the numbers of
        vertices."""
        model = self._model(self.cage, vertices, faces)
        self._core.set_model(*model)
        self._model_size = len(model[0])

    def bind(self, k: Optional[int] = None, *, callback: Callback = None) -> Binding:
        """The binding of the model with at most k influences per vertex, 0 for all, by default
        `max_influences`. Solves first if there is no solution."""
        return self._bound(k, callback, 3)

    def _bound(self, k: Optional[int], callback: Callback, level: int) -> Binding:
        binding = _binding(self._core.bind(k is None, callback))
        if binding.report["note"]:
            warnings.warn(binding.report["note"], stacklevel=level)
        warn_unless_converged(binding.report, level + 1)
        return binding.reduced(k) if k else binding

    def binding(self) -> Binding:
        """The binding of the model with all influences, of the present solution."""
        return _binding(self._core.bind(False, None))


@with_options
def bind(
    vertices: ArrayLike,
    faces: Optional[Faces],
    control_points: CageLike,
    cage_faces: Any = None,
    *,
    mesh_vertices: Optional[int] = None,
    domain: Optional[MeshLike] = None,
    callback: Callback = None,
    **options: Unpack[RigOptions],
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
        Number of vertices of the domain mesh; default as for `mesh`. "meanvalue", "maxentropy",
        "maxlikelihood", and "blended" are evaluated at the vertices of the model, and have a mesh
        only with `mesh_vertices` or `domain`.
    domain : DomainMesh, optional
        A given mesh of the cage interior.
    callback : callable, optional
        As for `solve`.
    {model options}

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
    checked(options, "bind", RigOptions)
    cage = as_cage(control_points) if cage_faces is None else Cage(control_points, cage_faces)
    rig = Rig(cage, vertices, faces, mesh_vertices=mesh_vertices, domain=domain, **options)
    return rig._bound(None, callback, 3)

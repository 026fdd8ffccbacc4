# SPDX-License-Identifier: BSD-3-Clause
"""Meshing, solving, and solves that resume."""
from __future__ import annotations

import inspect
import os
import textwrap
import warnings
from typing import (
    TYPE_CHECKING, Any, Callable, Dict, List, NamedTuple, Optional, Sequence, TypedDict, TypeVar,
    Union,
)

import numpy as np

from . import _core
from ._errors import Error, InputError, NotConverged, OptionError
from ._shapes import (
    DomainMesh, as_array, as_cage, as_floats, as_indices, as_mesh, as_points, as_polygons,
    check_scalars, frozen, mesh_from,
)
from ._weights import dense_of, from_core, is_sparse, joined

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from typing_extensions import Unpack

    from ._shapes import Cage, CageLike, Floats, MeshLike
    from ._weights import Weights

    Callback = Optional[Callable[[_core.Progress], Optional[bool]]]


Documented = TypeVar("Documented", bound=Callable[..., Any])


class SolverOptions(TypedDict, total=False):
    """Options of `solve`, `Solver`, `Rig`, and `bind`; see `help(flbc.solve)`."""

    method: str
    tolerance: Optional[float]
    gap: Optional[float]
    max_iterations: int
    certify: bool
    threads: int
    non_negative: str
    phi: Union[str, ArrayLike]
    smoothness: Optional[float]
    distances: str
    precision: str
    active_set: str
    penalty: Optional[float]
    mask: Any
    reach: Optional[ArrayLike]
    falloff: float


class RigOptions(SolverOptions, total=False):
    """Options of `bind` and `Rig`; see `help(flbc.bind)`."""

    max_influences: int
    outside: str
    symmetric: Optional[str]
    solid: Optional[Sequence[ArrayLike]]
    conflicts: str


OPTIONS = """\
    method : str, default "weights"
        "weights", "gradient", "paper", "lbc2014". For comparison:
        "harmonic", "meanvalue", "maxentropy", "maxlikelihood", "blended" (2D), or "bbw", which
        use only `threads` and `non_negative`. Weights by "bbw" do not reproduce points: add
        weighted displacements to them.
    tolerance : float, optional
        Target for the estimated mean squared error of the weights, or for the residuals of
        "paper" and "lbc2014". Default: 1e-6, 1e-8 with certify, 1e-7 for "paper" and "lbc2014",
        and none with smoothness 0.
    gap : float, optional
        Certified relative gap of the objective that also ends a solve; 0 for none. Default: 0,
        and 1e-3 with smoothness 0 and without tolerance.
    max_iterations : int, default 20000
    certify : bool, default False
        Whether to prove by how much the objective can exceed its minimum.
    threads : int, default 0
        Number of threads; 0 for all cores.
    non_negative : str, default "auto"
        How weights are kept non-negative: "constraint", "project", "off".
    phi : str or array_like, shape (F, n), default "square"
        Growth of the variation weighting with distance: "square", "linear", "sqrt",
        "constant". Or the weighting itself: a number >= 0 for each cell of the mesh and control
        point.
    smoothness : float, optional
        Removes kinks at the cost of more influences, as a fraction of the cage size. Useful
        values are 0.001 to 0.03, for "weights" and "gradient". 0 is the problem of the papers,
        whose optimum does not determine the weights. Default: 0.003, and 0 for "paper" and
        "lbc2014".
    distances : str, default "auto"
        "exact", or "interpolated" from the coarse mesh of a refined one.
    precision : str, default "auto"
        Of the iteration: "single" (the default), "double".
    active_set : str, default "auto"
        Whether to update only weights that may be positive: "on", "off".
    penalty : float, optional
        Penalty parameter, in units of the cage size.
    mask : array_like or sparse matrix of bool, shape (V, n), or list of pairs, optional
        True where a control point must not move a vertex of the mesh, (P, n) for `Rig` and
        `bind` those of the model: its weight is exactly 0, except on the facets of the control
        point. Or pairs of index lists, ``(control_points, vertices)``. For "weights" and a cage
        in one part. Masks that cannot be obeyed raise `MaskConflict`.
    reach : array_like, shape (n,), optional
        Factors from 1/16 to 16 by which phi of each control point is divided. Weights extend
        farther with a larger one. Not a guarantee, which a mask is.
    falloff : float, default 0
        Width of a band next to masks in which weights fade out before the mask, instead of
        ending in a crease there, as a fraction of the cage size. Useful values are 0.05 to 0.2.
"""


MODEL_OPTIONS = """\
    max_influences : int, default 8
        Per vertex; 0 to keep all weights.
    outside : str, default "fail"
        For vertices outside the cage: "fail"; "nearest", to follow the nearest point of the
        cage at a constant offset; "keep", to stay where they are, without weights; or "extend",
        to follow an affine map of the control points around them. These vertices keep all their
        weights, of which some are negative, for any `max_influences`.
    symmetric : str, optional
        "x", "y", or "z": weights of mirrored vertices are exactly alike, in a cage that is
        symmetric across this axis.
    solid : list of array_like, optional
        Regions of the model, as indices of vertices, or Boolean with an entry per vertex. Each
        moves by one affine map in every pose, also after a reduction. Weights stay >= 0, and change
        smoothly over a band around a region. Not with `symmetric`.
    conflicts : str, default "fail"
        For masks that cannot be obeyed: "fail" raises `MaskConflict`; "relax" removes a few
        control points from all masks, and lists them in ``report["note"]`` and a warning.
"""


def with_options(function: Documented) -> Documented:
    """Completes a docstring with all options, which all solves share."""
    if function.__doc__ is not None:  # None under python -OO
        doc = inspect.cleandoc(function.__doc__)  # as from Python 3.13 on
        doc = doc.replace("{model options}\n", textwrap.dedent(MODEL_OPTIONS))
        function.__doc__ = doc.replace("{options}", textwrap.dedent(OPTIONS).rstrip())
    return function


def checked(options: Any, function: str, kind: Any = SolverOptions) -> Dict[str, Any]:
    for name in options:
        if name not in kind.__annotations__:
            raise TypeError(
                f"{function}() has no option {name!r}; choose from "
                + ", ".join(kind.__annotations__)
            )
    return dict(options)


def has_own_phi(options: Dict[str, Any]) -> bool:
    phi = options.get("phi")
    return hasattr(phi, "__len__") and not isinstance(phi, str)


def as_masks(mask: Any, count: int, cage: Cage) -> Any:
    """Masks of count points as _core takes them: pairs of control points and points."""

    def is_pair(entry: Any) -> bool:
        is_list = isinstance(entry, (list, tuple)) and len(entry) == 2
        return is_list and all(hasattr(part, "__len__") for part in entry)

    def indices(part: Any, name: str, size: int) -> Any:
        return as_indices(as_array(part, name).reshape(-1), name, size)

    if isinstance(mask, (list, tuple)) and all(map(is_pair, mask)):
        return [
            (indices(first, f"mask[{k}][0]", len(cage)), indices(second, f"mask[{k}][1]", count))
            for k, (first, second) in enumerate(mask)
        ]
    array = mask.tocsc() if is_sparse(mask) else as_array(mask, "mask")
    shape = count, len(cage)
    if array.shape != shape or array.dtype != bool:
        raise InputError(
            f"mask has shape {array.shape} and type {array.dtype}, but needs {shape} and bool: one "
            "row for each vertex and one column for each control point; or pairs of index lists, "
            "(control_points, vertices)"
        )
    columns = [array[:, [i]].nonzero()[0].astype(np.int32) for i in range(len(cage))]
    return [(np.array([i], np.int32), rows) for i, rows in enumerate(columns) if len(rows)]


def as_regions(solid: Any, count: int) -> Any:
    """Solid regions of count points as _core takes them: indices."""
    regions = []
    for k, region in enumerate(solid):
        array, name = as_array(region, f"solid[{k}]").reshape(-1), f"solid[{k}]"
        if array.dtype == bool and len(array) != count:
            raise InputError(f"{name} has {len(array)} entries, but there are {count} vertices")
        indices = array.nonzero()[0] if array.dtype == bool else array
        regions.append(as_indices(indices, name, count))
    return regions


def as_table(value: Any, name: str, shape: Any, what: str) -> Floats:
    array = as_array(value, name)
    if array.shape != shape:
        raise InputError(f"{name} has shape {array.shape}, but needs {shape}: {what}")
    return as_floats(array, name)


def parsed(
    options: Dict[str, Any], cage: Cage, domain: Optional[DomainMesh], count: int
) -> Dict[str, Any]:
    """Options as _core takes them. Masks have count points."""
    given = dict(options)
    if given.get("reach") is not None:
        given["reach"] = as_table(
            given["reach"], "reach", (len(cage),), "one factor for each control point"
        )
    if has_own_phi(given) and domain:
        given["phi"] = as_table(
            given["phi"], "phi", (len(domain.cells), len(cage)),
            "one row for each cell of the mesh and one column for each control point",
        )
    if given.get("mask") is not None:
        given["mask"] = as_masks(given["mask"], count, cage)
    if given.get("solid") is not None:
        given["solid"] = as_regions(given["solid"], count)
    choices: Dict[str, Any] = {
        "symmetric": [None, "x", "y", "z"][: cage.dim + 1], "conflicts": ["fail", "relax"]
    }
    for name, known in choices.items():
        value = given.pop(name, known[0])
        if value not in known:
            names = ", ".join(choice for choice in known if choice)
            raise OptionError(f"{name} must be one of {names}, not {value!r}")
        given[name] = known.index(value)
    given["mirror_axis"], given["relax"] = given.pop("symmetric") - 1, given.pop("conflicts") == 1
    return given


class Certificate(NamedTuple):
    """A bound on the distance of weights from the optimum, in units of the objective."""

    objective: float
    lower_bound: float
    relative_gap: float


class Solution:
    """Coordinates at the vertices of a domain mesh.

    Attributes
    ----------
    weights : ndarray, shape (V, n), float64, read-only
        Row v has the weight of every control point at vertex v. Made on first use.
    sparse_weights : scipy.sparse.csr_matrix, shape (V, n)
        The same without zeros, for many control points. Nothing is copied from the solver.
    cage : Cage
    mesh : DomainMesh
    converged : bool
        Whether the tolerance or the certified gap was met.
    report : dict
        Iterations, residuals, times in seconds, and quality, with the names of the report of
        ``flbc solve``.
    certificate : Certificate or None
    """

    __slots__ = ("cage", "mesh", "report", "_parts", "_dense", "_proof")
    cage: Cage
    mesh: DomainMesh
    report: Dict[str, Any]

    def __init__(
        self, parts: Any, cage: Cage, mesh: DomainMesh, report: Dict[str, Any], proof: Any = None
    ) -> None:
        self._parts, self.cage, self.mesh, self.report = parts, cage, mesh, report
        self._proof = proof
        self._dense: Optional[Floats] = None

    @property
    def weights(self) -> Floats:
        if self._dense is None:
            self._dense = frozen(dense_of(self._parts))
        return self._dense

    @property
    def sparse_weights(self) -> Weights:
        return from_core(self._parts)

    @property
    def converged(self) -> bool:
        return bool(self.report["converged"])

    @property
    def certificate(self) -> Optional[Certificate]:
        if "relative_gap" not in self.report:
            return None
        names = "certified_objective", "lower_bound", "relative_gap"
        return Certificate(*(self.report[name] for name in names))

    def save_certificate(self, path: "str | os.PathLike[str]") -> None:
        """Writes what others need to check the certificate, for scripts/check_certificate.py.

        Parameters
        ----------
        path : str or path
            Of an archive of NumPy arrays (.npz): cage, mesh, weights, phi, and duals.

        Raises
        ------
        Error
            If the solution has no proof: it needs ``certify=True``, and a cage in one part.
        """
        if self._proof is None or self.certificate is None:
            raise Error("no proof to save; solve with certify=True, and a cage in one part")
        bounds = self.certificate
        with open(path, "wb") as file:
            np.savez(
                file,
                control_points=self.cage.points,
                facets=self.cage.facets,
                points=self.mesh.points,
                cells=self.mesh.cells,
                weights=self.weights,
                claimed=np.array([bounds.objective, bounds.lower_bound]),
                **self._proof,
            )

    def _evaluated(self, function: Any, points: ArrayLike, *rest: Any) -> List[Any]:
        """Results of _core for batches of points. Ctrl-C ends them between two batches."""
        cage, mesh = self.cage, self.mesh
        places = as_points(points, "points", cage.dim)

        def results(part: Floats) -> Any:
            return function(
                cage.points, cage.facets, mesh.points, mesh.cells, self._parts, part, *rest
            )

        size = 100_000
        try:
            return [results(places[k : k + size]) for k in range(0, max(len(places), 1), size)]
        except InputError:
            results(places)  # its error counts and numbers all points
            raise

    def at(self, points: ArrayLike, outside: str = "fail", *, sparse: bool = False) -> Weights:
        """Evaluates the coordinates at points. Ctrl-C ends the evaluation.

        Parameters
        ----------
        points : array_like, shape (P, d)
            In the units of the cage.
        outside : str, default "fail"
            For points outside the cage: "fail", "nearest" (the weights of the nearest point of
            the cage, which the point follows at a constant offset), "keep" (no weights: the
            point stays where it is), or "extend" (reproduce the point, with negative weights).
        sparse : bool, default False
            Returns a matrix of SciPy without zeros, for many points.

        Returns
        -------
        ndarray or scipy.sparse.csr_matrix, shape (P, n)

        Raises
        ------
        InputError
            If points are outside and `outside` is "fail".
        """
        check_scalars(outside=(outside, "a name"))
        found = joined(self._evaluated(_core.weights_at, points, outside))
        return from_core(found) if sparse else dense_of(found)

    def gradients(self, points: ArrayLike, *, exact: bool = False) -> Floats:
        """Evaluates the gradients of the coordinates at points.

        They are averages of the gradients of the cells around each mesh vertex, and linear in each
        cell; with `exact`, the derivatives of `at`, which are constant in each cell. The gradients
        at a point sum to zero over the control points.

        Parameters
        ----------
        points : array_like, shape (P, d)
            Inside the cage, in its units.
        exact : bool, default False

        Returns
        -------
        ndarray, shape (P, n, d)
            In 1 / units of the cage. For moved control points c, shape (n, d), the Jacobians of
            the deformation are ``np.einsum("nk,pnd->pkd", c, gradients)``.

        Raises
        ------
        InputError
            If points are outside.
        """
        found: Floats = np.concatenate(self._evaluated(_core.gradients, points, exact))
        return found.reshape(len(found), len(self.cage), self.cage.dim)

    def __repr__(self) -> str:
        shape = f"{len(self.mesh)}x{len(self.cage)}"
        return f"<flbc.Solution: {shape} weights, {self.report['status']}>"

    def __reduce__(self) -> Any:
        return Solution, (self._parts, self.cage, self.mesh, self.report, self._proof)


def mesh(
    cage: CageLike,
    vertices: Optional[int] = None,
    points: Optional[ArrayLike] = None,
    time_limit: float = 60,
) -> DomainMesh:
    """Meshes the interior of a cage, with CGAL in 2D and TetGen in 3D.

    Parameters
    ----------
    cage : Cage, or what `Cage` accepts
    vertices : int, optional
        Target number of vertices, met within 5% in 2D and about 10% in 3D; 0 for the minimum
        that element quality allows, to which a smaller number is raised, with a warning.
        Default: 10000.
    points : array_like, shape (P, d), optional
        Points that become vertices of the mesh. They follow the control points, in this
        order, without points on or outside the cage and without duplicates.
    time_limit : float, default 60
        Seconds that one run of a 3D mesher may take.

    Returns
    -------
    DomainMesh
        Its first n vertices are the control points.

    Raises
    ------
    InputError
        If the cage is defective or cannot be meshed.
    """
    check_scalars(vertices=(vertices, "an integer"), time_limit=(time_limit, "a number"))
    shape = as_cage(cage)
    inside = None if points is None else as_points(points, "points", shape.dim)

    count = 10000 if vertices is None else vertices
    arrays, note = _core.mesh(shape.points, shape.facets, count, inside, time_limit)
    if note and vertices is not None:
        warnings.warn(note, stacklevel=2)
    return mesh_from(arrays)


def warn_unless_converged(report: Dict[str, Any], stacklevel: int) -> None:
    if report["status"] == "iteration limit":
        warnings.warn(
            f"not converged within {report['iterations']} iterations; increase max_iterations or "
            "tolerance",
            NotConverged,
            stacklevel,
        )


@with_options
def solve(
    cage: CageLike,
    mesh: Optional[MeshLike] = None,
    *,
    callback: Callback = None,
    **options: Unpack[SolverOptions],
) -> Solution:
    """Computes local barycentric coordinates.

    Other Python threads run meanwhile, and Ctrl-C stops the solve.

    Parameters
    ----------
    cage : Cage, or what `Cage` accepts
        With n control points.
    mesh : DomainMesh or tuple of arrays, optional
        Domain mesh of the cage with V vertices. Default: ``flbc.mesh(cage)``.
    callback : callable, optional
        Called as ``callback(progress)`` every ten iterations with a `Progress`.
        Return False to stop with the weights so far. An exception ends the solve and reaches
        the caller.

    Other Parameters
    ----------------
    {options}

    Returns
    -------
    Solution
        With V x n weights.

    Raises
    ------
    InputError
        If the mesh does not match the cage, naming the element.
    OptionError
        If an option is out of range.
    SolverError
        If the computation breaks down.

    Warns
    -----
    NotConverged
        If `max_iterations` was reached. The weights are usable.

    Examples
    --------
    >>> cage = flbc.Cage([[0, 0], [1, 0], [1, 1], [0, 1]])
    >>> solution = flbc.solve(cage, flbc.mesh(cage, vertices=500))
    >>> solution.at([[0.5, 0.5]]).round(2)
    array([[0.25, 0.25, 0.25, 0.25]])
    """
    checked(options, "solve")
    return Solver(cage, mesh, **options)._run(None, 0, 0, callback, 4)


mesh_of = mesh  # where an argument has this name


@with_options
class Solver:
    """Solves a problem in several steps, and for a rest cage that is reshaped.

    The first solve equals `solve`; later ones resume. One thread at a time may use a Solver. A
    `Rig` does the same for a model.

    Parameters
    ----------
    cage : Cage, or what `Cage` accepts
    mesh : DomainMesh or tuple of arrays, optional
        Default: ``flbc.mesh(cage)``.

    Other Parameters
    ----------------
    {options}

    Raises
    ------
    InputError
        If the mesh does not match the cage.
    OptionError
        If an option is out of range.
    """

    _kind: Any = SolverOptions

    def __init__(
        self, cage: CageLike, mesh: Optional[MeshLike] = None, **options: Unpack[SolverOptions]
    ) -> None:
        cage = as_cage(cage)
        domain = mesh_of(cage) if mesh is None else as_mesh(mesh, cage)
        nothing = np.zeros((0, cage.dim)), as_polygons(None, "", 0)
        self._start(cage, domain, None, nothing, options)

    def _start(self, cage: Cage, domain: Any, vertices: Any, model: Any, options: Any) -> None:
        self._options = checked(options, type(self).__name__, self._kind)
        self._model_size = len(model[0])
        if domain is None and has_own_phi(self._options):
            domain = mesh_of(cage, vertices)
        given = parsed(self._options, cage, domain, self._model_size or len(domain))
        shape = domain and (domain.points, domain.cells)
        self._core = _core.Rig(
            cage.points, cage.facets, shape, vertices, model[0], model[1], given
        )

    def _run(
        self, moved: Optional[Floats], iterations: int, seconds: float, callback: Any, level: int
    ) -> Solution:
        found = self._core.solve(moved, iterations, seconds, callback)
        if not (iterations or seconds):
            warn_unless_converged(found[1], level)
        return self._solution(found)

    def _solution(self, found: Any) -> Solution:
        return Solution(found[0], self.cage, self.mesh, *found[1:])

    def solve(
        self, *, iterations: int = 0, seconds: float = 0, callback: Callback = None
    ) -> Solution:
        """Solves, or resumes the last solve.

        Parameters
        ----------
        iterations : int, default 0
            Maximum number of iterations of this call; 0 for `max_iterations`.
        seconds : float, default 0
            Time limit of this call; 0 for none.
        callback : callable, optional
            As for `solve`.

        Returns
        -------
        Solution
            With its own copy of the weights. Its report covers only this call.
        """
        return self._run(None, iterations, seconds, callback, 4)

    def reshape(
        self,
        control_points: ArrayLike,
        *,
        iterations: int = 0,
        seconds: float = 0,
        callback: Callback = None,
    ) -> Solution:
        """Moves the control points of the rest cage, and the mesh with them, and solves. The model
        of a `Rig` stays.

        Parameters
        ----------
        control_points : array_like, shape (n, d)
        iterations, seconds, callback
            As for `Solver.solve`.

        Returns
        -------
        Solution

        Raises
        ------
        InputError
            If a cell of the mesh would be inverted, the model would be outside, masks could not
            be obeyed, or the cage has several parts. Then nothing has changed.
        """
        cage = self.cage
        moved = as_points(control_points, "control_points", cage.dim, len(cage))
        return self._run(moved, iterations, seconds, callback, 4)

    def set_options(self, **options: Any) -> None:
        """Changes options of the following solves."""
        merged = {**self._options, **checked(options, type(self).__name__, self._kind)}
        size, domain = self._model_size, self.mesh
        given = parsed(merged, self.cage, domain, size or len(domain))
        self._core.set_options(given, size > 0)
        self._options = merged

    def restart(self) -> None:
        """Makes the next solve start over."""
        self._core.restart()

    def __reduce__(self) -> Any:
        raise TypeError(
            f"a {type(self).__name__} cannot be pickled or copied; keep its arguments and options, "
            f"and make another with flbc.{type(self).__name__}(cage, ..., **options)"
        )

    @property
    def options(self) -> Dict[str, Any]:
        """dict: those given so far."""
        return dict(self._options)

    @property
    def solution(self) -> Optional[Solution]:
        """Solution or None: of the last solve."""
        found = self._core.solution()
        return found and self._solution(found)

    @property
    def cage(self) -> Cage:
        """Cage: the current rest cage."""
        return as_cage(self._core.cage())

    @property
    def mesh(self) -> DomainMesh:
        """DomainMesh: the current mesh."""
        return mesh_from(self._core.mesh())

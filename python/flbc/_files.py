# SPDX-License-Identifier: BSD-3-Clause
"""Reading and writing cages, models, domain meshes, and weights."""
from __future__ import annotations

from typing import TYPE_CHECKING, Mapping, Optional, Union

import numpy as np

from . import _core
from ._errors import InputError
from ._shapes import (
    Cage, DomainMesh, Model, as_array, as_cage, as_floats, as_lists, as_points, as_polygons,
    mesh_from,
)
from ._weights import as_matrix, as_weights, from_core

if TYPE_CHECKING:
    import os

    from numpy.typing import ArrayLike

    from ._shapes import CageLike, Faces
    from ._weights import Weights

    Path = Union[str, os.PathLike[str]]


def read_cage(path: Path) -> Cage:
    """Reads a cage: a surface in 3D, or polylines in a plane z = constant in 2D.

    Parameters
    ----------
    path : str or path
        .obj, .off, .ply, .stl, or the outline of a drawing in .svg.

    Raises
    ------
    IoError, InputError
    """
    return Cage(*_core.read_cage(str(path)))


def write_cage(path: Path, cage: CageLike) -> None:
    """Writes a cage.

    Parameters
    ----------
    path : str or path
        .obj, and in 3D also .off, .ply, or .stl.
    cage : Cage, or what `Cage` accepts

    Raises
    ------
    IoError, InputError
    """
    cage = as_cage(cage)
    _core.write_cage(str(path), cage.points, cage.facets)


def read_model(path: Path, dim: Optional[int] = None) -> Model:
    """Reads the vertices and faces of a model, exactly.

    Parameters
    ----------
    path : str or path
        .obj, .off, .ply, or .stl.
    dim : int, optional
        Number of coordinates, 2 or 3. Default: 2 if all points have the same z.

    Returns
    -------
    Model
        ``vertices`` of shape (P, dim), and ``faces``: an (m, k) array, or lists if their
        lengths differ.

    Raises
    ------
    IoError, InputError
    """
    points, polygons, _ = _core.read_model(str(path))
    is_flat = len(points) > 0 and bool((points[:, 2] == points[0, 2]).all())
    if dim == 2 and not is_flat:
        raise InputError(f"{path}: the points are not in a plane z = constant")
    if dim == 2 or (dim is None and is_flat):
        points = np.ascontiguousarray(points[:, :2])
    return Model(points, as_lists(polygons))


def write_model(
    path: Path,
    vertices: ArrayLike,
    faces: Optional[Faces] = None,
    *,
    source: Optional[Path] = None,
) -> None:
    """Writes a model: .obj, .off, .ply, or .stl.

    Parameters
    ----------
    path : str or path
    vertices : array_like, shape (P, d)
    faces : array_like of int, optional
    source : str or path, optional
        A model file, of which everything but positions and normals is kept, such as texture
        coordinates and materials. Leave out `faces` then.

    Raises
    ------
    IoError, InputError
    """
    points = as_points(vertices, "vertices")
    if source is not None:
        if faces is not None:
            raise TypeError("write_model() takes faces or source, not both")
        _core.write_moved(str(path), points, str(source))
        return
    _core.write_model(str(path), points, as_polygons(faces, "faces", len(points)))


def read_mesh(path: Path) -> DomainMesh:
    """Reads a domain mesh.

    Parameters
    ----------
    path : str or path
        2D: .obj, .off. 3D: MEDIT .mesh, Gmsh .msh.

    Raises
    ------
    IoError, InputError
    """
    return mesh_from(_core.read_mesh(str(path)))


def write_mesh(
    path: Path, mesh: DomainMesh, fields: Optional[Mapping[str, ArrayLike]] = None
) -> None:
    """Writes a domain mesh in the formats of `read_mesh`, and .vtu for viewers.

    Parameters
    ----------
    path : str or path
    mesh : DomainMesh
    fields : mapping of str to array_like, shape (V,), optional
        Values at vertices, such as ``{"hand": solution.weights[:, 3]}``, for .vtu.

    Raises
    ------
    IoError, InputError
    """
    values = []
    for name, given in (fields or {}).items():
        array = as_array(given, f"fields[{name!r}]")
        if array.shape != (len(mesh),):
            raise InputError(
                f"fields[{name!r}] has shape {array.shape}, but needs ({len(mesh)},)"
            )
        values.append((name, as_floats(array, f"fields[{name!r}]")))
    _core.write_mesh(str(path), mesh.points, mesh.cells, values)


def read_weights(path: Path) -> Weights:
    """Reads weights, a row per point.

    Parameters
    ----------
    path : str or path
        .npy, .csv (dense), or .mtx (sparse).

    Returns
    -------
    ndarray or scipy.sparse.csr_matrix, shape (P, n)

    Raises
    ------
    IoError, InputError
    """
    return from_core(_core.read_weights(str(path)))


def write_weights(path: Path, weights: Weights) -> None:
    """Writes weights exactly.

    Parameters
    ----------
    path : str or path
        .npy, .csv, or .mtx.
    weights : array_like or sparse matrix, shape (P, n)

    Raises
    ------
    IoError, InputError
    """
    array = as_matrix(weights, "weights")
    _core.write_weights(str(path), as_weights(array, "weights", *array.shape))

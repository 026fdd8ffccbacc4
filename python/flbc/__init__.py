# SPDX-License-Identifier: BSD-3-Clause
"""Fast local barycentric coordinates for cage-based deformation in 2D and 3D.

Points are rows: control points (n, d), model vertices (P, d), weights (P, n). Arrays may have any
layout and real or integer type; results are float64 in C order.

>>> cage = flbc.read_cage("cage.obj")
>>> binding = flbc.bind(vertices, faces, cage)
>>> moved = binding.deform(moved_control_points)

=================== ======================================================================
Shapes              `Cage`, `DomainMesh`, `mesh`, `make_cage`, `repair`, `check`, `border`
Models              `bind`, `Rig`, `Binding`: `load_binding`
Coordinates         `solve`, `Solver`, `Solution`, `mean_value`
Cells               `cell_quality`, `Binding.largest_step`
Weights             `measure`; for weights from elsewhere, ``Binding(weights, cage, points)``
Files               `read_cage`, `read_model`, `read_mesh`, `read_weights`, and
                    `write_...` for each; `Binding.export` (glTF, USD), `Binding.view` (a page)
Exceptions          `Error` and its subclasses; the warning `NotConverged`
=================== ======================================================================
"""
import os as _os

from . import _core
from ._core import Progress
from ._binding import Binding, Page, Rig, bind, load_binding
from ._cells import cell_quality
from ._errors import (
    Error, InputError, IoError, MaskConflict, NotConverged, OptionError, SolverError,
)
from ._files import (
    read_cage, read_mesh, read_model, read_weights, write_cage, write_mesh, write_model,
    write_weights,
)
from ._models import Defect, Repaired, border, check, make_cage, repair
from ._shapes import Cage, DomainMesh, Model
from ._solve import Certificate, Solution, Solver, SolverOptions, mesh, solve
from ._weights import mean_value, measure

__version__: str = _core.version
__all__ = [
    "Binding", "Cage", "Certificate", "Defect", "DomainMesh", "Error", "InputError", "IoError",
    "MaskConflict", "Model", "NotConverged", "OptionError", "Page", "Progress", "Repaired", "Rig", "Solution", "Solver",
    "SolverError", "SolverOptions", "bind", "border", "cell_quality", "check", "load_binding", "make_cage", "mean_value",
    "measure", "mesh", "read_cage", "read_mesh", "read_model", "read_weights", "repair", "solve",
    "write_cage", "write_mesh", "write_model", "write_weights",
]

if hasattr(_os, "register_at_fork"):
    # A forked process has no other threads, for which OpenMP would wait.
    _os.register_at_fork(after_in_child=_core.has_forked)

# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and warnings of flbc."""
from typing import Sequence


class Error(Exception):
    """Base of all exceptions of flbc."""


class InputError(Error, ValueError):
    """A defect of the input: array, cage, mesh, model, or file content."""


class MaskConflict(InputError):
    """Masked points that no weights >= 0 of the other control points reproduce.

    Attributes
    ----------
    points : list of int
        Ascending.
    control_points : list of int
        Without their masks, all points can obey; ``conflicts="relax"`` removes these masks.
    """

    def __init__(
        self, message: str, points: Sequence[int] = (), control_points: Sequence[int] = ()
    ) -> None:
        super().__init__(message)
        self.points, self.control_points = points, control_points


class OptionError(Error, ValueError):
    """An option outside its valid range."""


class IoError(Error, OSError):
    """A file that cannot be opened, read, or written."""


class SolverError(Error, ArithmeticError):
    """A numerical breakdown, for example a matrix that cannot be factored."""


class NotConverged(RuntimeWarning):
    """A solve reached its maximum number of iterations. Its weights are usable."""

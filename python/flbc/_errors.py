# SPDX-License-Identifier: BSD-3-Clause
"""Exceptions and warnings of flbc."""


class Error(Exception):
    """Base of all exceptions of flbc."""


class InputError(Error, ValueError):
    """A defect of the input: array, cage, mesh, model, or file content."""


class OptionError(Error, ValueError):
    """An option outside its valid range."""


class IoError(Error, OSError):
    """A file that cannot be opened, read, or written."""


class SolverError(Error, ArithmeticError):
    """A numerical breakdown, for example a matrix that cannot be factored."""


class NotConverged(RuntimeWarning):
    """A solve reached its maximum number of iterations. Its weights are usable."""

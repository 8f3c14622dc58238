# SPDX-License-Identifier: Apache-2.0
"""What Buckens raises. Messages say what is wrong, where, the value, and what to do about it."""

from __future__ import annotations

from typing import Optional


class Error(Exception):
    """Base of all exceptions of Buckens.

    Attributes
    ----------
    file, line, column
        The place in a model file or mesh; None where it is not known.
    """

    file: Optional[str] = None
    line: Optional[int] = None
    column: Optional[int] = None


class InputError(Error):
    """The input is invalid: syntax, unknown names, units, ranges, arguments."""


class ModelError(Error):
    """The input can be read, but the mechanism it describes cannot be built or solved."""


class NumericalError(Error):
    """A calculation failed on the way: no convergence, not a number, a singular matrix."""


class IoError(Error):
    """A file or directory cannot be read or written."""


class DifferenceError(Error):
    """Two runs differ by more than was accepted; see :func:`buckens.compare`."""

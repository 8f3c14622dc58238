# SPDX-License-Identifier: Apache-2.0
"""Exceptions of Buckens. Messages state the error, its location, the value and a remedy."""

from __future__ import annotations

from typing import Optional


class Error(Exception):
    """Base class of all Buckens exceptions.

    Attributes
    ----------
    file, line, column
        Location in a model file or mesh; None if not known.
    """

    file: Optional[str] = None
    line: Optional[int] = None
    column: Optional[int] = None


class InputError(Error):
    """The input is invalid: syntax, unknown names, units, ranges or arguments."""


class ModelError(Error):
    """The input is valid, but the mechanism that it describes cannot be built or solved."""


class NumericalError(Error):
    """A calculation failed: no convergence, a value that is not finite, or a singular matrix."""


class IoError(Error):
    """A file or directory cannot be read or written."""


class DifferenceError(Error):
    """Two runs differ by more than the tolerance; see :func:`buckens.compare`."""

# SPDX-License-Identifier: Apache-2.0
"""Arrays with units."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple

import numpy as np


class Curve(np.ndarray[Any, Any]):
    """A NumPy array with a name and a unit: one row per record.

    Attributes
    ----------
    name : str
        Path or name of the quantity.
    unit : str
        Such as "m" or "N m"; "1" for dimensionless values.
    components : tuple of str
        Names along the last axis; may be empty.
    """

    name: str
    unit: str
    components: Tuple[str, ...]

    def __new__(cls, values: Any, name: str = "", unit: str = "1",
                components: Sequence[str] = ()) -> Curve:
        out = np.asarray(values).view(cls)
        out.name, out.unit, out.components = name, unit, tuple(components)
        return out

    def __array_finalize__(self, origin: Optional[Any]) -> None:
        self.name = getattr(origin, "name", "")
        self.unit = getattr(origin, "unit", "1")
        self.components = getattr(origin, "components", ())

    def __reduce__(self) -> Any:
        """For pickle and other processes, with name and unit."""
        return Curve, (np.asarray(self), self.name, self.unit, self.components)

    def __array_wrap__(self, out: Any, context: Any = None) -> Any:
        """Returns plain arrays for results of calculations, as their unit is not known."""
        return out[()] if out.ndim == 0 else np.asarray(out)

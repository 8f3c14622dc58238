# SPDX-License-Identifier: Apache-2.0
"""Current values of a simulation: motion of bodies, sensors, energies and signals."""

from __future__ import annotations

from typing import Any, Iterator, List, Mapping

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import InputError

Array = npt.NDArray[np.float64]


class Frame:
    """Motion of a body frame, as read-only arrays that follow the simulation.

    Attributes
    ----------
    position : (3,) array
        Position of the origin, the mass centre of the body, in world axes [m].
    rotation : (3, 3) array
        Rotation matrix from body axes to world axes.
    velocity : (3,) array
        Velocity of the origin, in world axes [m/s].
    angular_velocity : (3,) array
        Angular velocity in body axes [rad/s].
    """

    def __init__(self, numbers: Array) -> None:
        self.position = numbers[0:3]
        self.rotation = numbers[3:12].reshape(3, 3)
        self.velocity = numbers[12:15]
        self.angular_velocity = numbers[15:18]

    def __repr__(self) -> str:
        return f"<buckens.Frame at {self.position} m, velocity {self.velocity} m/s>"


class Body:
    """A body of a simulation."""

    def __init__(self, core: _core.Simulation, name: str) -> None:
        self._core = core
        self.name = name

    @property
    def frame(self) -> Frame:
        """Motion of the body frame."""
        return Frame(self._core.frame(self.name))

    @property
    def displacements(self) -> Array:
        """Nodal displacements [m] and rotations [rad] in body axes, shape (nodes, 6).

        A read-only view that follows the simulation and keeps it alive.
        """
        return self._core.displacements(self.name)

    @property
    def velocities(self) -> Array:
        """Time derivatives of :attr:`displacements`, shape (nodes, 6) [m/s, rad/s]."""
        return self._core.velocities(self.name)

    def __repr__(self) -> str:
        return f"<buckens.Body {self.name!r}>"


class Bodies(Mapping[str, Body]):
    """Bodies by name."""

    def __init__(self, core: _core.Simulation, names: List[str]) -> None:
        self._core = core
        self._bodies = {name: Body(core, name) for name in names}

    def belong_to(self, core: _core.Simulation) -> bool:
        """Whether they are those of this simulation."""
        return self._core is core

    def __getitem__(self, name: str) -> Body:
        if name not in self._bodies:
            known = ", ".join(self._bodies)
            raise InputError(f"there is no body {name!r}; the model has {known}")
        return self._bodies[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._bodies)

    def __len__(self) -> int:
        return len(self._bodies)


class Values(Mapping[str, Any]):
    """Current values of sensors or energies by name."""

    def __init__(self, core: _core.Simulation, prefix: str) -> None:
        self._core, self._prefix = core, prefix

    def __getitem__(self, name: str) -> Any:
        value = self._core.value(self._prefix + name)
        return float(value) if value.ndim == 0 else value

    def __iter__(self) -> Iterator[str]:
        for path, _, _ in self._core.quantities():
            if path.startswith(self._prefix):
                yield path[len(self._prefix):]

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __repr__(self) -> str:
        return repr(dict(self))


class Signals(Mapping[str, float]):
    """Current values of the signals by name."""

    def __init__(self, core: _core.Simulation) -> None:
        self._core = core

    def __getitem__(self, name: str) -> float:
        return self._core.signal(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._core.signals())

    def __len__(self) -> int:
        return len(self._core.signals())

    def __repr__(self) -> str:
        return repr(dict(self))

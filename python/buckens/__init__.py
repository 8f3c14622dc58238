# SPDX-License-Identifier: Apache-2.0
"""Buckens: dynamics of flexible multibody systems.

>>> import buckens
>>> model = buckens.load("slider_crank.yaml", set={"parameters.speed": 100})  # doctest: +SKIP
>>> sim = buckens.Simulation(model, out="out")                                # doctest: +SKIP
>>> sim.run(progress=True)                                                    # doctest: +SKIP
>>> buckens.open("out").plot("mid")                                           # doctest: +SKIP

All numbers are in SI units. Library messages go to the logger "buckens".
"""

from . import _core, study
from .array_mesh import ArrayMesh
from .curve import Curve
from .errors import DifferenceError, Error, InputError, IoError, ModelError, NumericalError
from .live_page import LivePage
from .model import Model, load
from .objects import *  # noqa: F403
from .objects import __all__ as _parts
from .present import Body, Frame
from .result_mesh import ResultMesh
from .results import Results, RunPage, open  # noqa: A004 (the name says what it does)
from .simulation import Simulation
from .verb_run import continue_run, run
from .verbs import (check, compare, convert, merge_sweep, mesh_info, modes, static, sweep, sweep_status, view,
                    view_live)
from .yaml_text import to_yaml

__version__: str = _core.version
# A plain list: type checkers do not evaluate sums, and would treat the names as private.
__all__ = ["ArrayMesh", "Body", "Curve", "DifferenceError", "Error", "Frame", "InputError", "IoError", "LivePage", "Model",
           "ModelError", "NumericalError", "ResultMesh", "Results", "RunPage", "Simulation", "check", "compare",
           "continue_run", "convert", "load", "merge_sweep", "mesh_info", "modes", "open", "run", "static", "study", "sweep",
           "sweep_status", "to_yaml", "view", "view_live"]
__all__ += _parts

# SPDX-License-Identifier: Apache-2.0
"""Buckens: multibody dynamics of machines whose parts deform.

>>> import buckens
>>> model = buckens.load("slider_crank.yaml", set={"parameters.speed": 100})  # doctest: +SKIP
>>> sim = buckens.Simulation(model, out="out")                                # doctest: +SKIP
>>> sim.run(progress=True)                                                    # doctest: +SKIP
>>> buckens.open("out").plot("mid")                                           # doctest: +SKIP

All numbers are in SI units; messages of the library go to the logger "buckens".
"""

from . import _core, study
from .array_mesh import ArrayMesh
from .curve import Curve
from .errors import DifferenceError, Error, InputError, IoError, ModelError, NumericalError
from .model import Model, load
from .objects import *  # noqa: F403
from .objects import __all__ as _parts
from .present import Body, Frame
from .result_mesh import ResultMesh
from .results import Results, RunPage, open  # noqa: A004 (the name says what it does)
from .simulation import Simulation
from .verbs import check, compare, convert, mesh_info, modes, static, sweep, view
from .yaml_text import to_yaml

__version__: str = _core.version
__all__ = ["ArrayMesh", "Body", "Curve", "DifferenceError", "Error", "Frame", "InputError", "IoError", "Model",
           "ModelError", "NumericalError", "ResultMesh", "Results", "RunPage", "Simulation", "check", "compare", "convert",
           "load", "mesh_info", "modes", "open", "static", "study", "sweep", "to_yaml", "view"] + _parts

# SPDX-License-Identifier: Apache-2.0
"""Studies: samples of varying quantities, run by :func:`buckens.sweep`, and evaluation of the results.

>>> import buckens
>>> design = buckens.study.sensitivity({"parameters.L": "300 mm +- 0.2 mm", "parameters.speed": "100 to 150 rad/s"},
...                                    64)                                                       # doctest: +SKIP
>>> sweep = buckens.sweep("slider_crank.yaml", design, "study", executor=8, progress=True)       # doctest: +SKIP
>>> bending = buckens.study.results(sweep, "mid.y max")                                          # doctest: +SKIP
>>> buckens.study.sobol_indices(design, bending).total                                           # doctest: +SKIP
"""

from .study_distributions import Distribution, lognormal, normal, triangular, uniform
from .study_effects import (SobolIndices, Statistics, main_effects, picture, results, sobol_indices, statistics)
from .study_optimum import Optimum, minimize
from .study_progress import Progress, status
from .study_sampling import Samples, grid, latin_hypercube, sensitivity, sobol

__all__ = ["Distribution", "Optimum", "Progress", "Samples", "SobolIndices", "Statistics", "grid", "latin_hypercube",
           "lognormal", "main_effects", "minimize", "normal", "picture", "results", "sensitivity", "sobol", "sobol_indices",
           "statistics", "status", "triangular", "uniform"]

# SPDX-License-Identifier: Apache-2.0
"""Docstrings of the Python module in NumPy's style: they describe every argument."""

import doctest
import inspect
import pathlib
import re
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens  # noqa: E402 (found after the path is set)

PARTS = set(buckens.objects.__all__)
# Called by other parts of the module.
FOR_THE_MODULE = {"Samples.itertuples", "Progress.of"}
# Made by users; of the others only methods are called.
MADE_BY_USERS = {"ArrayMesh", "Model", "Simulation"}


def functions():
    """Public functions, classes and methods by their names."""
    for module in (buckens, buckens.study):
        for name in sorted(vars(module)):
            value = getattr(module, name)
            if name.startswith("_") or name in PARTS or not callable(value) or not value.__module__.startswith("buckens"):
                continue
            yield name, value
            for key, method in vars(value).items() if inspect.isclass(value) else ():
                method = getattr(method, "__func__", method)
                if not key.startswith("_") and inspect.isfunction(method) and f"{name}.{key}" not in FOR_THE_MODULE:
                    yield f"{name}.{key}", method


ALL = dict(functions())


def described(text):
    """Names in the section of parameters."""
    section = re.search(r"^Parameters\n-+\n(.*?)(?=^\S[^\n]*\n-+\n|\Z)", text, re.MULTILINE | re.DOTALL)
    heads = re.findall(r"^(\*?\*?\w[^\n:]*)", section[1], re.MULTILINE) if section else []
    return {name.strip().lstrip("*") for head in heads for name in head.split(",")}


@pytest.mark.parametrize("name", ALL)
def test_every_argument_is_described(name):
    text = inspect.getdoc(ALL[name])
    assert text, "no docstring"
    if inspect.isclass(ALL[name]) and name not in MADE_BY_USERS:
        return
    parameters = [one.name for one in inspect.signature(ALL[name]).parameters.values()
                  if one.name not in ("self", "cls") and not one.name.startswith("_")]
    assert set(parameters) <= described(text), f"not described: {set(parameters) - described(text)}"


def test_there_are_functions():
    assert {"load", "Model.with_changes", "Simulation.resume", "Results.field", "sweep", "convert"} <= set(ALL) and len(ALL) > 60


def test_arrays_have_shapes_and_units():
    for name in ("position", "rotation", "velocity", "angular_velocity"):
        assert re.search(rf"{name} : \(3(, 3)?,?\) array", buckens.Frame.__doc__), name
    assert "(nodes, 6)" in buckens.Body.displacements.__doc__ and "[m/s, rad/s]" in buckens.Body.velocities.__doc__
    assert "[N]" in buckens.Simulation.multipliers.__doc__ and "(3,)" in buckens.Simulation.set_load.__doc__
    assert "(n, 3)" in buckens.ArrayMesh.__doc__ and "(m, 8)" in buckens.ArrayMesh.__doc__
    # Fields with a dimension have its unit.
    assert "[rad]" in buckens.HingeStop.__doc__ and "[m]" in buckens.Beam.__doc__


@pytest.mark.parametrize("module", ["model", "array_mesh", "simulation"])
def test_examples_in_docstrings_run(module):
    import importlib
    found = doctest.testmod(importlib.import_module(f"buckens.{module}"))
    assert found.failed == 0

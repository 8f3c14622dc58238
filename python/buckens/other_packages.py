# SPDX-License-Identifier: Apache-2.0
"""Packages that only some functions need."""

from __future__ import annotations

import importlib
from typing import Any


def package(name: str, purpose: str) -> Any:
    """Imports a package, or says that it has to be installed.

    Raises
    ------
    ModuleNotFoundError
        If it is not installed.
    """
    try:
        return importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] != name.split(".")[0]:
            raise  # it is there, but lacks something itself
        top = name.split(".")[0]
        raise ModuleNotFoundError(f"{purpose} needs the package {top}, which is not installed: "
                                  f"python3 -m pip install {top}", name=error.name) from None

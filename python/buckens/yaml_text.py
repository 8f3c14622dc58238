# SPDX-License-Identifier: Apache-2.0
"""Converts dictionaries to the text of a model file."""

from __future__ import annotations

import json
import os
import re
from typing import Any, List, Mapping, Optional

import numpy as np

from .errors import InputError
from .model_files import ModelFiles

# Written without quotation marks: names, and quantities such as `10 mm` or `7850 kg/m^3`.
_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_./-]*|[0-9.]+(e-?[0-9]+)? [A-Za-z][A-Za-z0-9/^ ]*")
_WORDS = {"true", "false", "yes", "no", "on", "off", "null", "y", "n"}


def to_yaml(tree: Mapping[str, Any], files: Optional[ModelFiles] = None) -> str:
    """Returns the contents of a dictionary as the text of a model file.

    Parameters
    ----------
    tree
        Keys as in a model file. Values are numbers (SI), strings with units, arrays, lists, dictionaries
        or file paths. Entries that are None are omitted.
    files
        Stores values that must be files, such as a :class:`buckens.ArrayMesh`; the text contains their names.

    Raises
    ------
    InputError
        If a value has another type, naming the path of the key.
    """
    lines: List[str] = []
    _write_map(tree, "", "", lines, files)
    return "".join(line + "\n" for line in lines)


def _write_map(tree: Mapping[str, Any], indent: str, path: str, lines: List[str],
               files: Optional[ModelFiles]) -> None:
    for key, value in tree.items():
        place = f"{path}.{key}" if path else str(key)
        if not isinstance(key, str):
            raise InputError(f"{place}: expected a string as key, found {key!r}")
        if value is None:
            continue
        value = _plain(value, place, files)
        name = _scalar_text(key)
        flow = _flow(value, place, files)
        if not isinstance(value, Mapping) or not value or len(indent + name + flow) < 96 and indent:
            lines.append(f"{indent}{name}: {flow}")
        else:
            lines.append(f"{indent}{name}:")
            _write_map(value, indent + "  ", place, lines, files)


def _plain(value: Any, place: str, files: Optional[ModelFiles]) -> Any:
    """Converts a value to a string, number, list or dictionary."""
    if files is not None:
        name = files.name_of(value, place)
        if name is not None:
            return name
    as_tree = getattr(value, "to_tree", None)
    if as_tree is not None:
        return as_tree()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, np.ndarray):
        if value.dtype.kind not in "biuf":
            raise InputError(f"{place}: expected an array of numbers, found one of dtype {value.dtype}")
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, tuple):
        return list(value)
    return value


def _flow(value: Any, place: str, files: Optional[ModelFiles] = None) -> str:
    """Returns a value as one line of YAML."""
    value = _plain(value, place, files)
    if isinstance(value, Mapping):
        parts = []
        for key, part in value.items():
            if not isinstance(key, str):
                raise InputError(f"{place}.{key}: expected a string as key, found {key!r}")
            if part is not None:
                parts.append(f"{_scalar_text(key)}: {_flow(part, f'{place}.{key}', files)}")
        return "{" + ", ".join(parts) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(_flow(part, f"{place}.{i}", files) for i, part in enumerate(value)) + "]"
    text = _number_text(value)
    if text is not None:
        return text
    if isinstance(value, str):
        return _scalar_text(value)
    raise InputError(f"{place}: expected a number, a string, a list or a dictionary, found {value!r} "
                     f"of type {type(value).__name__}")


def _number_text(value: Any) -> Optional[str]:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    return None


def _scalar_text(text: str) -> str:
    is_plain = _PLAIN.fullmatch(text) is not None and text.lower() not in _WORDS
    return text if is_plain else json.dumps(text, ensure_ascii=False)

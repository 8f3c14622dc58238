#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes buckens/objects.py: a class per kind of body, joint, load, sensor and section, with the fields
of schema/model.schema.json, which come from the field lists of the reader.

usage: make_objects.py SCHEMA OUT
"""

import json
import keyword
import sys
import textwrap

HEAD = '''# SPDX-License-Identifier: Apache-2.0
"""Parts of models as objects. Made by python/make_objects.py from schema/model.schema.json."""

from __future__ import annotations

import difflib
import inspect
from typing import Any, Dict, Mapping, Optional, Sequence, Union

#: A number in SI units, or a text with a unit or expression.
Quantity = Union[float, str]


class Part:
    """Part of a model: the keys of a model file as arguments. See :meth:`to_tree`."""

    def __new__(cls, *values: Any, **arguments: Any) -> Part:
        known = [name for name in inspect.signature(cls.__init__).parameters if name != "self"]
        if values and cls is not Part:
            raise TypeError(f"buckens.{cls.__name__} takes its arguments by name ({known[0]}=...), found {values[0]!r}")
        for name in arguments:
            if name not in known:
                near = difflib.get_close_matches(name, known, 1, 0.5)
                hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(known)}"
                raise TypeError(f"buckens.{cls.__name__} has no argument {name!r}; {hint}")
        return super().__new__(cls)

    def __init__(self, kind: str, fields: Mapping[str, Any], others: Mapping[str, Any]) -> None:
        self._kind = kind
        self._fields = {key: value for key, value in fields.items() if value is not None}
        self._others = {key: value for key, value in others.items() if value is not None}

    def to_tree(self) -> Dict[str, Any]:
        """The same as in a model file."""
        return {self._kind: self._fields, **self._others} if self._kind else dict(self._fields)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Part) and self.to_tree() == other.to_tree()

    def __repr__(self) -> str:
        fields = ", ".join(f"{argument(key)}={value!r}"
                           for key, value in {**self._fields, **self._others}.items())
        return f"{type(self).__name__}({fields})"


def argument(key: str) -> str:
    """Name of the argument for a key: "end-section" is end_section, "from" is from_."""
    name = key.replace("-", "_")
    return name + "_" if name in ("from", "in", "is", "with", "as") else name
'''


def argument(key):
    name = key.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def class_name(kind, suffix=""):
    return "".join(word.capitalize() for word in kind.split("-")) + suffix


# Fields that name a file, and may be arrays instead (buckens.ArrayMesh, sparse matrices).
ARRAYS = {("mesh", "file"), ("matrices", "mass"), ("matrices", "stiffness"), ("matrices", "damping"),
          ("matrices", "nodes")}


def type_of(schema, kind="", key=""):
    """Returns a Python type that covers all values that a schema allows."""
    if (kind, key) in ARRAYS:
        return "Any"
    kinds = schema.get("anyOf", [schema])
    simple = {"number", "string", "integer"}
    if all(set(_listed(k.get("type", ""))) <= simple and "type" in k for k in kinds):
        return "Quantity"
    if all(k.get("type") == "array" for k in kinds):
        return "Sequence[Any]"
    if all("enum" in k and all(isinstance(v, str) for v in k["enum"]) for k in kinds):
        return "str"
    return "Any"


def _listed(value):
    return value if isinstance(value, list) else [value]


def object_of(schema):
    """Returns the variant of a schema that is an object with known keys, or None."""
    if "properties" in schema:
        # A point of the ground is a marker, not a record.
        return None if list(schema["properties"]) == ["ground"] else schema
    for variant in schema.get("anyOf", []):
        found = object_of(variant)
        if found:
            return {**found, "description": schema.get("description", found.get("description", ""))}
    return None


def doc_lines(text, indent):
    return textwrap.wrap(text.replace("\\", "\\\\"), 100 - indent, initial_indent=" " * indent,
                         subsequent_indent=" " * indent, break_long_words=False)


def write_class(name, kind, schema, others):
    """Returns the text of one class; `others` are fields besides those of the kind, such as `at` of bodies."""
    fields, required = schema["properties"], set(schema.get("required", ()))
    own = {argument(key): (key, value, key in required) for key, value in fields.items()}
    beside = {}
    for key, value in others.items():
        name_of_argument = argument(key)
        beside["body_" + name_of_argument if name_of_argument in own else name_of_argument] = (key, value)
    lines = ["", "", f"class {name}(Part):"]
    text = schema.get("description", "").strip() or f"{kind} of a model file"
    lines += doc_lines('"""' + text[0].upper() + text[1:] + ("" if text.endswith(".") else "."), 4)
    lines += ["", "    Parameters", "    ----------"]
    for parameter, (key, value, *_) in {**own, **beside}.items():
        lines += [f"    {parameter}"] + doc_lines(value.get("description", ""), 8)
    lines += ['    """', "", "    def __init__(", "        self,"]
    if own or beside:
        lines.append("        *,")
    for parameter, (key, value, is_required) in own.items():
        if is_required:
            lines.append(f"        {parameter}: {type_of(value, kind, key)},")
    for parameter, (key, value, is_required) in own.items():
        if not is_required:
            lines.append(f"        {parameter}: Optional[{type_of(value, kind, key)}] = None,")
    for parameter, (_, value) in beside.items():
        lines.append(f"        {parameter}: Optional[{type_of(value)}] = None,")
    lines += ["    ) -> None:", f"        super().__init__(", f"            {kind!r},", "            {"]
    lines += [f"                {key!r}: {parameter}," for parameter, (key, *_) in own.items()]
    lines += ["            },", "            {"]
    lines += [f"                {key!r}: {parameter}," for parameter, (key, _) in beside.items()]
    lines += ["            },", "        )"]
    return [line.rstrip() for line in lines]


def kinds_of(schema, suffix, others=()):
    """Yields (class name, key, schema, other fields) of each kind in a map of named entries."""
    properties = schema["properties"]
    beside = {key: properties[key] for key in others if key in properties}
    one_of = [entry["required"][0] for entry in schema.get("oneOf", []) if "required" in entry]
    for kind in one_of or properties:
        as_object = object_of(properties[kind])
        if as_object is not None and kind not in beside and kind != "like":
            yield class_name(kind, suffix), kind, as_object, beside


def first_object(schema):
    """Returns the object that describes one entry of a map of names."""
    entries = schema["additionalProperties"]
    return object_of(entries) or entries


def all_classes(schema):
    tree = schema["properties"]
    bodies = first_object(tree["bodies"])
    kinds = {entry["required"][0] for entry in bodies["oneOf"]}
    yield from kinds_of(bodies, "", [key for key in bodies["properties"] if key not in kinds])
    yield from kinds_of(first_object(tree["joints"]), "")
    yield from kinds_of(first_object(tree["loads"]), "")
    yield from kinds_of(first_object(tree["sections"]), "Section")
    yield from kinds_of(first_object(tree["output"]["properties"]["sensors"]), "Sensor")
    yield "Material", "", first_object(tree["materials"]), {}


def text_of(schema):
    lines, names = [], []
    for name, kind, fields, beside in all_classes(schema):
        assert name not in names, f"two kinds are called {name}"
        names.append(name)
        lines += write_class(name, kind, fields, beside)
    return HEAD + "\n".join(lines) + "\n\n\n__all__ = " + repr(sorted(names)) + "\n"


if __name__ == "__main__":
    with open(sys.argv[1], encoding="utf-8") as source:
        made = text_of(json.load(source))
    with open(sys.argv[2], "w", encoding="utf-8") as target:
        target.write(made)

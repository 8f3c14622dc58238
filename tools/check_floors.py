#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Include floors: a module includes lower floors only, and there are no include cycles.

The floors stand in src/CMakeLists.txt (buckens_module(name floor ...)), nowhere else. A module may
have rooms, src/buckens/<module>/<room>/; rooms have no floor of their own and hold no folders.
Tests (<module>/test) may include everything.

Headers stand alone: each has `#pragma once`, and the source of the same name includes it first.
"""

import argparse
import re
import sys

import source_files

MODULE = re.compile(r"^\s*buckens_module\(\s*(\w+)\s+(\d+)", re.MULTILINE)
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+"([^"\n]+)"', re.MULTILINE)
SYSTEM_INCLUDE = re.compile(r"^[ \t]*#[ \t]*include[ \t]+<", re.MULTILINE)
GENERATED = {"buckens/base/version.h"}


def read_floors(root):
    return {name: int(floor)
            for name, floor in MODULE.findall(source_files.read(root, "src/CMakeLists.txt"))}


def includes_of(root, name):
    text = source_files.blank_comments_and_strings(source_files.read(root, name), keep_strings=True)
    for match in INCLUDE.finditer(text):
        yield source_files.line_of(text, match.start()), match.group(1)


def check_file(name, includes, floors, present):
    """Errors of one file of the library."""
    parts = name.split("/")
    module = parts[2]
    if module not in floors:
        return [f"{name}: the module \"{module}\" has no floor in src/CMakeLists.txt"]
    errors = []
    for line, target in includes:
        place = f"{name}:{line}"
        target_parts = target.split("/")
        if target_parts[0] != "buckens" or len(target_parts) < 3:
            errors.append(f"{place}: \"{target}\": write the path from src/, \"buckens/...\"")
        elif target_parts[1] not in floors:
            errors.append(f"{place}: \"{target}\": there is no module \"{target_parts[1]}\"")
        elif "src/" + target not in present and target not in GENERATED:
            errors.append(f"{place}: \"{target}\": there is no such file")
        elif parts[3] != "test" and target_parts[2] == "test":
            errors.append(f"{place}: \"{target}\": the library must not include its tests")
        elif (parts[3] != "test" and target_parts[1] != module
              and floors[target_parts[1]] >= floors[module]):
            errors.append(
                f"{place}: \"{module}\" (floor {floors[module]}) must not include "
                f"\"{target_parts[1]}\" (floor {floors[target_parts[1]]}); only lower floors")
    return errors


def check_header(name, text, includes, present):
    """Errors of a file as a header, or as the source that shows that a header compiles alone."""
    if name.endswith(".h"):
        return [] if "#pragma once" in text else [f"{name}: a header needs `#pragma once`"]
    header = name[:-len(".cpp")] + ".h"
    if header not in present:
        return []
    line, first = next(iter(includes), (1, None))
    if "src/" + str(first) == header and not SYSTEM_INCLUDE.search(text.split(first)[0]):
        return []
    return [f"{name}:{line}: include \"{header[len('src/'):]}\" first, which shows that it stands alone"]


def find_cycle(graph):
    """A cycle in the graph as a list of nodes, or None."""
    state = {}
    for start in sorted(graph):
        if start in state:
            continue
        path, iterators = [start], [iter(sorted(graph[start]))]
        state[start] = "open"
        while path:
            following = next(iterators[-1], None)
            if following is None:
                state[path.pop()] = "done"
                iterators.pop()
            elif state.get(following) == "open":
                return path[path.index(following):] + [following]
            elif following in graph and following not in state:
                state[following] = "open"
                path.append(following)
                iterators.append(iter(sorted(graph[following])))
    return None


def check(root):
    floors = read_floors(root)
    present = set(source_files.list_files(root))
    errors, graph, modules = [], {}, {name: set() for name in floors}
    for name in sorted(present):
        if not re.match(r"src/buckens/.+\.(h|cpp)$", name):
            continue
        if name.count("/") < 3:
            errors.append(f"{name}: every source belongs to a module, src/buckens/<module>/")
            continue
        if name.count("/") > 4:
            errors.append(f"{name}: at most src/buckens/<module>/<room>/; tests in <module>/test/")
        includes = list(includes_of(root, name))
        errors += check_file(name, includes, floors, present)
        if "/test/" not in name:
            errors += check_header(name, source_files.read(root, name), includes, present)
        graph[name] = {"src/" + target for _, target in includes}
        if "/test/" not in name:
            module = name.split("/")[2]
            used = {t.split("/")[1] for _, t in includes if t.count("/") > 1}
            modules.setdefault(module, set()).update((used & set(floors)) - {module})
    for kind, cycle in (("files", find_cycle(graph)), ("modules", find_cycle(modules))):
        if cycle:
            errors.append(f"{kind} include each other in a circle: " + " -> ".join(cycle))
    return errors


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", nargs="?", default=".")
    sys.exit(source_files.report("include floors", check(parser.parse_args().root)))

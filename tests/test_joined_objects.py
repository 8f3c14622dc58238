# SPDX-License-Identifier: Apache-2.0
"""Parts of the library are compiled without optimisation (BUCKENS_LIGHT in src/CMakeLists.txt). Functions of templates that
they share with optimised parts must come from the latter, or steps would run at a fraction of their speed."""

import os
import re
import subprocess

from conftest import BINARY


def shared_functions(path):
    """Functions of which the linker keeps one copy, by their size."""
    told = subprocess.run(["nm", "-S", str(path)], capture_output=True, text=True, check=True).stdout
    out = {}
    for line in told.splitlines():
        words = line.split()
        if len(words) == 4 and words[2] == "W":
            out[words[3]] = int(words[1], 16)
    return out


def joined_objects():
    """The objects in the order in which they are joined. A build folder may hold others, of an earlier configuration."""
    rule = next(line for line in (BINARY / "build.ninja").read_text().splitlines() if " -r -nostdlib " in line)
    return [os.path.normpath(path) for path in re.findall(r"[^ ]+_objects\.dir/[^ ]+\.o", rule)]


def compiled_objects():
    """The objects of the library, as the rules that compile them name them."""
    rules = re.findall(r"^build ([^ ]+_objects\.dir/[^ ]+\.o): ", (BINARY / "build.ninja").read_text(), re.MULTILINE)
    return {os.path.normpath(BINARY / path) for path in rules if "/buckens_" in path}


def test_optimised_copies_are_kept():
    light = [path for path in joined_objects() if "_light_objects" in path]
    optimised = [path for path in joined_objects() if path not in light]
    assert light and len(optimised) > 10
    assert joined_objects() == optimised + light
    assert set(joined_objects()) == compiled_objects()
    sizes = {}
    for path in optimised:
        for name, size in shared_functions(path).items():
            sizes.setdefault(name, set()).add(size)
    kept = shared_functions(BINARY / "lib" / "libbuckens.a")
    both = differing = 0
    for path in light:
        for name, size in shared_functions(path).items():
            if name in sizes:
                both += 1
                differing += size not in sizes[name]
                assert kept[name] in sizes[name], name
    assert both > 100
    if "CMAKE_BUILD_TYPE:STRING=Release" in (BINARY / "CMakeCache.txt").read_text():
        # Most are longer without optimisation: the comparison tells the copies apart.
        assert differing > 50

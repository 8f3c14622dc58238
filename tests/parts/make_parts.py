#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the meshes in this folder with the program gmsh (Debian: gmsh). It is needed only to change
them. All files named crank_web contain the same mesh."""

import pathlib
import subprocess

HERE = pathlib.Path(__file__).parent
CRANK_WEB = [("crank_web_22.msh", "msh22", False), ("crank_web_22_binary.msh", "msh22", True),
             ("crank_web_41.msh", "msh41", False), ("crank_web_41_binary.msh", "msh41", True),
             ("crank_web.unv", "unv", False)]


def gmsh(part, dimension, target, form, binary=False):
    subprocess.run(["gmsh", f"-{dimension}", HERE / f"{part}.geo", "-format", form, "-o", HERE / target]
                   + (["-bin"] if binary else []), check=True, stdout=subprocess.DEVNULL)


for name, form, is_binary in CRANK_WEB:
    gmsh("crank_web", 3, name, form, is_binary)
gmsh("bracket", 3, "bracket.msh", "msh41", True)
gmsh("housing", 2, "housing.msh", "msh41")

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes assembly.step of assembly.geo with the program gmsh (Debian: gmsh), with names of products and faces
and colours of faces and solids as CAD systems write them. It is needed only to change the assembly."""

import pathlib
import re
import subprocess
import tempfile

HERE = pathlib.Path(__file__).parent
PRODUCTS = ["frame", "plate", "pin", "block"]  # the assembly, and its parts in the order of assembly.geo
# Part, face of a box (x0, x1, y0, y1, z0, z1), name as ISO 10303-21 writes it, colour.
FACES = [(1, "x0", "wall", (1, 0, 0)), (1, "x1", "seat", None), (2, "x1", "Stirnfl\\X2\\00E4\\X0\\che", None),
         (2, "z1", "", (0, 1, 0)), (3, "z0", "it''s below", (0, 0, 1))]
SIDES = ["x0", "x1", "y0", "y1", "z0", "z1"]


def plain_step(geometry):
    with tempfile.TemporaryDirectory() as directory:
        step = pathlib.Path(directory) / "part.step"
        subprocess.run(["gmsh", "-0", geometry, "-o", step], check=True, stdout=subprocess.DEVNULL)
        text = step.read_text()
    return re.sub(r"'\d{4}-\d\d-\d\dT[\d:]+'", "'2026-01-01T00:00:00'", text)


def with_names(text):
    generic = "Open CASCADE STEP translator 7.6 1"
    for number in range(len(PRODUCTS) - 1, 0, -1):
        text = text.replace(f"{generic}.{number}", PRODUCTS[number])
    return text.replace(generic, PRODUCTS[0])


class Styles:
    def __init__(self, text):
        self.next = max(map(int, re.findall(r"^#(\d+)", text, re.M))) + 1
        self.lines = []
        self.items = []

    def add(self, entity):
        self.lines.append(f"#{self.next} = {entity};")
        self.next += 1
        return self.next - 1

    def color(self, item, rgb):
        color = self.add("COLOUR_RGB('',{:.1f},{:.1f},{:.1f})".format(*rgb))
        area = self.add(f"FILL_AREA_STYLE_COLOUR('',#{color})")
        area = self.add(f"FILL_AREA_STYLE('',(#{area}))")
        area = self.add(f"SURFACE_STYLE_FILL_AREA(#{area})")
        side = self.add(f"SURFACE_SIDE_STYLE('',(#{area}))")
        usage = self.add(f"SURFACE_STYLE_USAGE(.BOTH.,#{side})")
        style = self.add(f"PRESENTATION_STYLE_ASSIGNMENT((#{usage}))")
        self.items.append(self.add(f"STYLED_ITEM('color',(#{style}),#{item})"))


def main():
    text = with_names(plain_step(HERE / "assembly.geo"))
    styles = Styles(text)
    parts = [re.findall(r"#(\d+) = ADVANCED_FACE\(", part) for part in text.split("MANIFOLD_SOLID_BREP")[1:]]
    for part, side, name, rgb in FACES:
        face = parts[part - 1][SIDES.index(side)]
        text = text.replace(f"#{face} = ADVANCED_FACE(''", f"#{face} = ADVANCED_FACE('{name}'")
        if rgb:
            styles.color(face, rgb)
    solid, = re.findall(r"#(\d+) = MANIFOLD_SOLID_BREP", text.split("'pin'")[-1].split("'block'")[0])
    styles.color(solid, (0.5, 0.5, 0.5))
    context = re.findall(r"ADVANCED_BREP_SHAPE_REPRESENTATION\('',\([^)]*\),#(\d+)\)", text)[0]
    styles.add("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',("
               + ",".join(f"#{item}" for item in styles.items) + f"),#{context})")
    end = text.rindex("ENDSEC;")
    (HERE / "assembly.step").write_text(text[:end] + "\n".join(styles.lines) + "\n" + text[end:])


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes rod.step of rod.geo with the program gmsh (Debian: gmsh), as a CAD system would have saved it:
the bores are coloured and have names. It is needed only to change the part."""

import pathlib
import re
import subprocess
import tempfile

HERE = pathlib.Path(__file__).parent
# Radius of the bore [mm], name, red, green, blue.
BORES = [(14.0, "big bore", (1, 0, 0)), (9.0, "small bore", (0, 0, 1))]


def plain_step(geometry):
    with tempfile.TemporaryDirectory() as directory:
        step = pathlib.Path(directory) / "rod.step"
        subprocess.run(["gmsh", "-0", geometry, "-o", step], check=True, stdout=subprocess.DEVNULL)
        text = step.read_text()
    text = text.replace("Open CASCADE STEP translator 7.6 1", "rod")
    return re.sub(r"'\d{4}-\d\d-\d\dT[\d:]+'", "'2026-01-01T00:00:00'", text)


class Step:
    def __init__(self, text):
        self.text = text
        body = re.sub(r"\s*\n\s*", "", text[text.index("DATA;") + 5:])
        self.entities = dict(re.findall(r"#(\d+) ?= ?(.*?);", body))
        self.next = max(map(int, self.entities)) + 1
        self.styles = []

    def add(self, entity):
        self.styles.append(f"#{self.next} = {entity};")
        self.next += 1
        return self.next - 1

    def bores(self, radius):
        """Faces on cylinders of this radius."""
        for number, entity in self.entities.items():
            if not entity.startswith("ADVANCED_FACE"):
                continue
            surface = self.entities[re.findall(r"#(\d+)", entity)[-1]]
            if not surface.startswith("CYLINDRICAL_SURFACE"):
                continue
            if abs(float(surface.rsplit(",", 1)[1].rstrip(")")) - radius) < 1e-6:
                yield number

    def name(self, face, name):
        self.text = self.text.replace(f"#{face} = ADVANCED_FACE(''", f"#{face} = ADVANCED_FACE('{name}'")

    def color(self, face, rgb):
        color = self.add("COLOUR_RGB('',{:.1f},{:.1f},{:.1f})".format(*rgb))
        area = self.add(f"FILL_AREA_STYLE_COLOUR('',#{color})")
        area = self.add(f"FILL_AREA_STYLE('',(#{area}))")
        area = self.add(f"SURFACE_STYLE_FILL_AREA(#{area})")
        side = self.add(f"SURFACE_SIDE_STYLE('',(#{area}))")
        usage = self.add(f"SURFACE_STYLE_USAGE(.BOTH.,#{side})")
        style = self.add(f"PRESENTATION_STYLE_ASSIGNMENT((#{usage}))")
        return self.add(f"STYLED_ITEM('color',(#{style}),#{face})")

    def finished(self, items):
        shape = next(e for e in self.entities.values() if e.startswith("ADVANCED_BREP_SHAPE"))
        context = re.findall(r"#(\d+)", shape)[-1]
        self.add("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',("
                 + ",".join(f"#{item}" for item in items) + f"),#{context})")
        end = self.text.rindex("ENDSEC;")
        return self.text[:end] + "\n".join(self.styles) + "\n" + self.text[end:]


def main():
    step = Step(plain_step(HERE / "rod.geo"))
    items = []
    for radius, name, rgb in BORES:
        for face in list(step.bores(radius)):
            step.name(face, name)
            items.append(step.color(face, rgb))
    (HERE / "rod.step").write_text(step.finished(items))


if __name__ == "__main__":
    main()

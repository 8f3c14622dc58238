# SPDX-License-Identifier: Apache-2.0
"""Several bodies from one STEP file, each a solid of it, where the assembly has them."""

import math
import pathlib

import pytest

from conftest import may_mesh_step_files

pytestmark = pytest.mark.skipif(not may_mesh_step_files(), reason="built without Gmsh (BUCKENS_GPL=OFF)")

# A plate from x = 0 to 40 mm and a pin of 20 mm × 10 mm × 10 mm that stands on its end face.
ASSEMBLY = pathlib.Path(__file__).parent / "parts" / "assembly.step"

MODEL = f"""
buckens: 1
gravity: [0, 0, -9.81 m/s^2]
materials: {{steel: {{E: 210 GPa, nu: 0.3, rho: 7850 kg/m^3}}}}
bodies:
  plate:
    geometry: {{step: {ASSEMBLY}, solid: plate, size: 5 mm, material: steel}}
    interfaces: {{wall: {{face: wall}}, seat: {{face: seat}}}}
  pin:
    geometry:
      step: {ASSEMBLY}
      solid: pin
      size: 5 mm
      material: steel
      faces: {{foot: {{plane: {{point: [40 mm, 10 mm, 5 mm], normal: [1, 0, 0]}}}}}}
    interfaces: {{foot: {{face: foot}}, tip: {{face: Stirnfläche}}}}
joints:
  hold: {{fixed: {{between: [{{ground: [0, 10 mm, 5 mm]}}, plate/wall]}}}}
  hinge: {{revolute: {{between: [plate/seat, pin/foot], axis: [0, 1, 0]}}}}
simulation: {{duration: 60 ms, step: 0.1 ms}}
output:
  every: 10 ms
  sensors: {{tip: {{position: pin/tip}}}}
"""


def falling_pin(times):
    """Angles below the horizontal of a rigid prism that hangs on the middle of its end face, released horizontally."""
    length, height, g = 0.02, 0.01, 9.81
    rate = g * length / 2 / ((length**2 + height**2) / 12 + length**2 / 4)
    angle, speed, time, step, out = 0.0, 0.0, 0.0, 1e-5, []
    for wanted in times:
        while time < wanted - step / 2:  # leapfrog: the error of 1e-5 s is of the order of 1e-8
            speed += step / 2 * rate * math.cos(angle)
            angle += step * speed
            speed += step / 2 * rate * math.cos(angle)
            time += step
        out.append(angle)
    return out


def test_two_solids_of_one_file_move_on_a_joint_between_them(buckens, sensors, tmp_path):
    """Nothing says where the bodies are: the file does, and the hinge finds its faces at one place."""
    told = sensors(MODEL)
    bodies = buckens("check", "model.yaml", "--json").must(0).json["bodies"]
    assert bodies["plate"]["mass"] == pytest.approx(7850 * 40 * 20 * 10e-9, rel=1e-9)
    assert bodies["pin"]["mass"] == pytest.approx(7850 * 20 * 10 * 10e-9, rel=1e-9)
    angles = falling_pin(told["t"])
    assert angles[-1] > 1.0, "it has turned far"
    for k, angle in enumerate(angles):
        place = tuple(told[f"tip.{axis}"][k] for axis in "xyz")
        # Steps of 0.1 ms make 1e-7 m here; steel bends by some 1e-9 m.
        assert place == pytest.approx((0.04 + 0.02 * math.cos(angle), 0.01, 0.005 - 0.02 * math.sin(angle)), abs=2e-7)


def test_bodies_of_one_file_may_overlap(buckens, tmp_path):
    """Nothing is cut: each body is its solid, whatever others of the file fill the same place."""
    (tmp_path / "same.yaml").write_text(
        "buckens: 1\nmaterials: {steel: {E: 210 GPa, nu: 0.3, rho: 7850}}\nbodies:\n"
        + "".join(f"  {name}: {{geometry: {{step: {ASSEMBLY}, solid: {solid}, material: steel}}}}\n"
                  for name, solid in (("one", "plate"), ("other", "1"))))
    bodies = buckens("check", "same.yaml", "--json").must(0).json["bodies"]
    assert bodies["one"]["mass"] == bodies["other"]["mass"] == pytest.approx(7850 * 8e-6, rel=1e-9)
    (tmp_path / "none.yaml").write_text((tmp_path / "same.yaml").read_text().replace("solid: 1", "solid: pim"))
    buckens("check", "none.yaml").must(2, "no solid \"pim\"", "Did you mean \"pin\"")

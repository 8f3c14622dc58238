# SPDX-License-Identifier: Apache-2.0
"""Input by users of other programs, and typing mistakes; entries added by --set; meshes of
files with full integration; rigid interfaces of bodies with several frames."""

import json

import pytest

MODEL = """
buckens: 1
materials:
  steel: {E: 2.1e11 Pa, nu: 0.3, rho: 7850 kg/m^3}
parameters: {L: 1 m}
bodies:
  rod: {beam: {from: [0, 0, 0], to: [L, 0, 0], elements: 2, section: {circle: {diameter: 6 mm}}, material: steel}}
  bar: {mesh: {box: {size: [1 m, 0.1 m, 0.1 m], divisions: [4, 1, 1]}, material: steel}}
joints:
  hinge: {revolute: {between: [ground, rod/start], axis: [0, 0, 1]}}
loads:
  push: {force: {on: rod/end, value: [0, 1 N, 0]}}
initial: {bodies: {rod: {velocity: [0, 0, 0]}}}
simulation: {duration: 1 ms, step: 0.1 ms}
"""


@pytest.fixture
def refuse(buckens, tmp_path):
    def call(old, new, *words):
        assert old in MODEL
        (tmp_path / "model.yaml").write_text(MODEL.replace(old, new, 1))
        return buckens("check", "model.yaml").must(2, *words)

    return call


# ---- wishes


@pytest.mark.parametrize("old, new, words", [
    ("axis: [0, 0, 1]}", "axis: [0, 0, 1], friction: 0.1}", ["model.yaml:10:", "\"friction\"", "`hinge-friction`"]),
    ("revolute:", "cardan:", ["\"cardan\"", "called `universal`"]),
    ("revolute:", "helical:", ["\"helical\"", "called `screw`"]),
    ("push: {force:", "push: {pulley:", ["\"pulley\"", "`belt`"]),
    ("revolute:", "cam:", ["\"cam\"", "`slot`"]),
    ("revolute:", "hinge:", ["\"hinge\"", "called `revolute`"]),
    ("axis: [0, 0, 1]}", "axis: [0, 0, 1], limits: [0, 1]}", ["limits", "`hinge-stop`"]),
    ("push: {force:", "push: {collision:", ["model.yaml:12:", "\"collision\"", "the load `contact`"]),
    ("push: {force:", "push: {PID:", ["\"PID\"", "controller", "`pid`", "`hinge-motor`"]),
    ("simulation:", "controllers: {a: 1}\nsimulation:", ["controller", "`signals`"]),
    ("velocity: [0, 0, 0]", "position: [0, 0, 1]", ["model.yaml:13:", "initial.bodies.rod", "its key `at`"]),
    ("velocity: [0, 0, 0]", "orientation: [0, 0, 1]", ["its key `at`"]),
    ("nu: 0.3", "plasticity: 0.3", ["not supported yet", "linear elastic"]),
])
def test_wishes_are_told_what_to_do_instead(refuse, old, new, words):
    refuse(old, new, *words)


@pytest.mark.parametrize("material, section, words", [
    ("aluminium", "{circle: {diameter: 6 mm}}", ["unknown material \"aluminium\"", "has no material", "E: 70 GPa"]),
    ("PA12", "{circle: {diameter: 6 mm}}", ["unknown material \"PA12\"", "# those of steel"]),
    ("{E: 2 GPa, rho: 1010}", "shaft", ["unknown section \"shaft\"", "has no section"]),
])
def test_what_a_model_lacks_is_shown_in_two_lines_to_paste(buckens, tmp_path, material, section, words):
    text = ("buckens: 1\nbodies:\n  rod:\n    beam: {to: [1 m, 0, 0], elements: 2, material: MATERIAL, section: SECTION}\n"
            .replace("MATERIAL", material).replace("SECTION", section))
    (tmp_path / "model.yaml").write_text(text)
    told = buckens("check", "model.yaml").must(2, "model.yaml:4:", "nothing is built in", *words).err
    example = told[told.index(f"\n{words[0].split()[1]}s:\n"):].splitlines()[1:3]
    # Definitions stand above the bodies that use them.
    (tmp_path / "model.yaml").write_text(text.replace("bodies:", "\n".join(example) + "\nbodies:"))
    buckens("check", "model.yaml").must(0)


def test_a_full_stop_for_a_slash(refuse):
    refuse("rod/start", "rod.start", "model.yaml:10:", "\"rod.start\"", "Did you mean \"rod/start\"?")
    refuse("on: rod/end", "on: \"rod:end\"", "Did you mean \"rod/end\"?")


# ---- commas and brackets


@pytest.mark.parametrize("old, new, words", [
    ("to: [L, 0, 0]", "to: [0,3, 0, 0]", ["model.yaml:7:", "bodies.rod.beam.to", "0,3", "0.3"]),
    ("value: [0, 1 N, 0]", "value: [0, 1,5 N, 0]", ["loads.push.force.value", "1,5 N", "1.5 N"]),
    ("value: [0, 1 N, 0]", "value: [0, max(1,2), 0]", ["max(1,2)", "\"max(1, 2)\"", "quotes"]),
    ("axis: [0, 0, 1]", "axis: [0, 0]", ["a list of 2 values"]),
    ("axis: [0, 0, 1]", "axis: [0, 0, 1, 2]", ["a list of 4 values"]),
    ("E: 2.1e11 Pa", "E: 2,1e11 Pa", ["model.yaml:4:", "\"1e11 Pa\"", "decimals with a point"]),
    ("diameter: 6 mm", "diameter: max(6,7)", ["\"7)\"", "in quotes"]),
    ("{L: 1 m}", "{L: \"1,5 m\"}", ["decimals are written 1.5"]),
])
def test_commas_that_cut_values(refuse, old, new, words):
    refuse(old, new, *words)


@pytest.mark.parametrize("old, new, words", [
    ("material: steel}}\n  bar", "material: steel}\n  bar", ["model.yaml:7:8: ", "the bracket {", "add }"]),
    ("rho: 7850 kg/m^3}", "rho: 7850 kg/m^3", ["model.yaml:4:10: ", "the bracket {"]),
    ("to: [L, 0, 0]", "to: [L, 0, 0", ["model.yaml:7:37: ", "the bracket [", "add ]"]),
    ("step: 0.1 ms}", "step: 0.1 ms # not closed }", ["model.yaml:14:13: ", "the bracket {"]),
])
def test_an_open_bracket_is_named_where_it_opens(refuse, old, new, words):
    refuse(old, new, *words)


# ---- lists and remedies


def test_lists_of_known_names_are_whole(refuse):
    keys = [f"a{k:02}: {{sphere: {{center: [0, 0, 0], radius: 1 mm}}}}" for k in range(20)]
    text = "material: steel}, interfaces: {" + ", ".join(keys) + "}}\njoints"
    error = refuse("material: steel}}\njoints", text.replace("a07: {sphere", "a07: {zzz"), "zzz").err
    for known in ("face", "set", "sphere", "box", "cylinder", "plane"):
        assert known in error


def test_a_bad_face_is_listed_once(refuse):
    error = refuse("material: steel}}\njoints", "material: steel}, interfaces: {a: {face: middle_of_it}}}\njoints",
                   "\"middle_of_it\"", "x0").err
    assert error.count("x1") == 1


def test_a_mesh_without_faces_has_a_remedy(buckens, tmp_path):
    rows = "".join(f"{k}, {x}, {y}, {z}\n" for k, (x, y, z) in enumerate(
        [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], 1))
    (tmp_path / "part.inp").write_text("*NODE\n" + rows + "*ELEMENT, TYPE=C3D8, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n")
    part = "bodies: {part: {mesh: {file: part.inp, material: {E: 2e11, nu: 0.3, rho: 7850}}INTERFACES}}\n"
    load = "loads: {p: {pressure: {on: part/top, value: 1 MPa}}}\n"
    (tmp_path / "model.yaml").write_text("buckens: 1\n" + part.replace("INTERFACES", "") + load)
    error = buckens("check", "model.yaml")
    assert error.code == 2 and "interface" in error.err
    # A joint off the mesh: the interfaces that could carry it are listed.
    joint = "joints: {j: {fixed: {between: [ground, part]}}}\n"
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\n" + part.replace("INTERFACES", ", interfaces: {foot: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}") + joint)
    buckens("check", "model.yaml").must(2, "\"part\" is not a point of the mesh", "use one of: foot")
    (tmp_path / "model.yaml").write_text("buckens: 1\n" + part.replace("INTERFACES", "") + joint)
    buckens("check", "model.yaml").must(2, "\"part\" is not a point of the mesh", "define an interface", "such as \"n")


def test_a_beam_that_leaves_the_plane_is_told_so(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\nplanar: xy\nbodies:\n  rod: {beam: {to: [1, 0, 0.3], elements: 3, section: {circle: "
        "{diameter: 6 mm}}, material: {E: 2e11, nu: 0.3, rho: 7850}}}\n")
    buckens("check", "model.yaml").must(2, "model.yaml:4:3", "\"rod\"", "leaves the plane", "by 0.1 m", "`planar`")
    # Parallel to the plane, any position is allowed.
    (tmp_path / "model.yaml").write_text((tmp_path / "model.yaml").read_text().replace(
        "to: [1, 0, 0.3]", "from: [0, 0, 0.3], to: [1, 0, 0.3]"))
    buckens("check", "model.yaml").must(0)


@pytest.mark.parametrize("joint, words", [
    ("spherical: {between: [ground, block/pin]}", "about any axis without"),
    ("revolute: {between: [ground, block/pin], axis: [0, 0, 1]}", "about (0, 0, "),
])
def test_a_free_motion_is_not_given_an_axis_that_chance_chose(buckens, tmp_path, joint, words):
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\nbodies: {block: {rigid: {mass: 1 kg, inertia: [1, 2, 2.5]}, markers: {pin: {position: [0.1, 0.2, 0]}}}}\n"
        "joints: {j: {" + joint + "}}\ninitial: {start: static}\nsimulation: {duration: 1 ms, step: 0.1 ms}\n")
    out = buckens("check", "model.yaml").must(0).out
    assert "not unique" in out and words in out, out


def test_beams_count_from_one_everywhere(buckens, tmp_path):
    beams = "".join(f"    - {{between: [n{k}, n{k + 1}], section: {{circle: {{diameter: {6 + k} mm}}}}, material: "
                    "{E: 2e11, nu: 0.3, rho: 7850}}\n" for k in range(3))
    (tmp_path / "model.yaml").write_text(
        "buckens: 1\nbodies:\n  frame:\n   structure:\n    nodes: {n0: [0, 0, 0], n1: [1, 0, 0], n2: [1, 1, 0], n3: [1, 1, 1]}\n"
        "    beams:\n" + beams + "loads: {w: {line-load: {on: frame/4, value: [0, 1 N/m, 0]}}}\n")
    buckens("check", "model.yaml").must(2, "frame/4", "from 1 to 3")
    modes = buckens("modes", "model.yaml", "--body", "frame", "--set", "loads.w.line-load.on=frame/3", "--json").must(0).json
    assert set(modes["analyses"][0]["modes"][0]["energy_shares"]) == {"beam 1", "beam 2", "beam 3"}


# ---- --set


def test_set_adds_entries_of_named_maps(buckens, tmp_path):
    (tmp_path / "model.yaml").write_text(MODEL)
    buckens("run", "model.yaml", "-o", "out", "-q",
            "--set", "output.sensors.tip={position: rod/end}",
            "--set", "output.sensors.reaction.joint-force=hinge",
            "--set", "loads.pull={force: {on: rod/end, value: [0, F, 0]}}",
            "--set", "parameters.F=2 N").must(0)
    head = (tmp_path / "out" / "sensors.csv").read_text().splitlines()[0]
    assert "tip.x" in head and "reaction.y" in head
    buckens("check", "model.yaml", "--set", "output.sensors.tip={positon: rod/end}").must(
        2, "--set output.sensors.tip", "\"positon\"", "Did you mean \"position\"?")
    buckens("check", "model.yaml", "--set", "output.sensors.a b={position: rod/end}").must(2, "cannot be a name")


@pytest.mark.parametrize("setting, words", [
    ("bodies.rdo.beam.elements=4", ["no \"rdo\" in bodies", "\"rod\"", "as a whole"]),
    ("parameters.F=3", ["no \"F\" in parameters", "no value uses it", "L"]),
    ("bodies.third={rigid: {mas: 1}}", ["\"mas\"", "\"mass\""]),
    ("output.sensor.tip={position: rod/end}", ["\"sensor\"", "\"sensors\""]),
])
def test_set_checks_what_it_adds(buckens, tmp_path, setting, words):
    (tmp_path / "model.yaml").write_text(MODEL)
    buckens("check", "model.yaml", "--set", setting).must(2, *words)


# ---- integration of meshes of files

N = 6


def deck(bend):
    nodes = [(i / N, j * 0.1, k * 0.1) for i in range(N + 1) for j in range(2) for k in range(2)]
    number = {(i, j, k): 1 + 4 * i + 2 * j + k for i in range(N + 1) for j in range(2) for k in range(2)}
    rows = "".join(f"{n}, {x!r}, {y!r}, {z!r}\n" for n, (x, y, z) in enumerate(nodes, 1))
    cells = "".join(
        f"{i + 1}, " + ", ".join(str(number[(i + a, b, c)]) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)))
        + "\n" for i in range(N))
    return "*NODE\n" + rows + f"*ELEMENT, TYPE={bend}, ELSET=ALL\n" + cells


@pytest.mark.parametrize("integration", ["full", "incompatible-modes"])
def test_a_mesh_of_a_file_takes_an_integration(buckens, tmp_path, integration):
    (tmp_path / "bar.inp").write_text(deck("C3D8"))
    material = "material: {E: 2e11, nu: 0.3, rho: 7850}"
    (tmp_path / "file.yaml").write_text(
        f"buckens: 1\nbodies: {{bar: {{mesh: {{file: bar.inp, {material}, integration: {integration}}}}}}}\n")
    (tmp_path / "box.yaml").write_text(
        "buckens: 1\nbodies: {bar: {mesh: {box: {size: [1, 0.1, 0.1], divisions: [6, 1, 1], "
        f"integration: {integration}}}, {material}}}}}}}\n")
    ours, same = (buckens("check", name, "--json").must(0).json["bodies"]["bar"]["frequencies"]
                  for name in ("file.yaml", "box.yaml"))
    # The same elements by two routes: rounding.
    assert ours == pytest.approx(same, rel=1e-9)
    # Bending locks without the incompatible modes: it is far stiffer in one layer of cubes of this slenderness.
    bending = 4.7300407448627040**2 * (2e11 * 0.1**2 / 12 / 7850)**0.5 / (2 * 3.141592653589793)
    assert (ours[0] > 1.1 * bending) == (integration == "full")


def test_the_integration_of_a_generated_mesh_belongs_to_its_shape(refuse):
    refuse("material: steel}}\njoints", "material: steel, integration: full}}\njoints", "bodies.bar.mesh.integration", "belongs to the shape")


# ---- rigid interfaces with frames

BLOCK = """
buckens: 1
bodies:
  bar:
    mesh: {box: {size: [1 m, 0.1 m, 0.1 m], divisions: [8, 1, 1]}, material: {E: 2e11, nu: 0.3, rho: 7850}}
    frames: FRAMES
    interfaces:
      root: {face: x0, kind: rigid}
      tip: {REGION, kind: rigid}
joints: {wall: {fixed: {between: [ground, bar/root]}}}
loads: {push: {force: {on: bar/tip, value: [0, 10 N, 0]}}}
initial: {start: static}
simulation: {duration: 1 ms, step: 0.1 ms}
output: {every: 1 ms, sensors: {tip: {displacement: bar/tip}, place: {position: bar/tip}, turn: {rotation: bar/tip}}}
"""


def test_rigid_interfaces_work_with_several_frames(buckens, tmp_path):
    reports, systems, places = [], [], []
    for frames in (1, 2, 4):
        (tmp_path / "model.yaml").write_text(BLOCK.replace("FRAMES", str(frames)).replace("REGION", "face: x1"))
        reports.append(buckens("check", "model.yaml", "--json").must(0).json["bodies"]["bar"])
        systems.append([m["frequency"] for m in buckens(
            "modes", "model.yaml", "--system", "--about", "initial", "--count", "4", "--json").must(0).json["analyses"][0]["modes"]])
        buckens("run", "model.yaml", "-o", f"out{frames}", "-q").must(0)
        row = (tmp_path / f"out{frames}" / "sensors.csv").read_text().splitlines()
        names = [name.split(" [")[0] for name in row[0].split(",")]
        places.append(dict(zip(names, map(float, row[1].split(",")))))
    for k in (1, 2):
        # Frames change neither M nor K of the undeformed body.
        assert reports[k]["frequencies"] == pytest.approx(reports[0]["frequencies"], rel=1e-6)
        assert systems[k] == pytest.approx(systems[0], rel=1e-6)
        # 10 N bend it by 2e-6 m: what frames add is of the order of its square.
        assert places[k]["place.y"] == pytest.approx(places[0]["place.y"], rel=1e-6)
        assert places[k]["turn.z"] == pytest.approx(places[0]["turn.z"], rel=1e-6)
    deflection = 10 * 1**3 / (3 * 2e11 * 0.1**4 / 12)
    # Timoshenko adds 1 %, elements and the held face take some away.
    assert places[0]["place.y"] == pytest.approx(deflection, rel=0.03)


def test_a_rigid_interface_across_a_cut_is_refused_by_name(buckens, tmp_path):
    text = BLOCK.replace("FRAMES", "2").replace("REGION", "box: {from: [0.3, -1, -1], to: [0.7, 1, 1]}")
    (tmp_path / "model.yaml").write_text(text)
    result = buckens("check", "model.yaml")
    assert result.code in (2, 3)
    for word in ("\"tip\"", "several", "frames"):
        assert word in result.err

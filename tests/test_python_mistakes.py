# SPDX-License-Identifier: Apache-2.0
"""What users of the Python module do wrong, and what it tells them."""

import copy
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import buckens, source  # noqa: E402 (found after the path is set)

TREE = {
    "title": "Cart",
    "bodies": {"cart": {"rigid": {"mass": "2 kg", "inertia": [1, 1, 1]},
                        "markers": {"top": {"position": [0, 0, "1 m"]}}}},
    "joints": {"guide": {"prismatic": {"between": ["ground", "cart"], "axis": [1, 0, 0]}}},
    "loads": {"drive": {"force": {"on": "cart", "value": [1, 0, 0]}}},
    "simulation": {"duration": "10 ms", "step": "1 ms"},
    "output": {"sensors": {"place": {"position": "cart"}}},
}


def tree(path, value):
    """The model with another value."""
    out = copy.deepcopy(TREE)
    inner = out
    keys = path.split(".")
    for key in keys[:-1]:
        inner = inner[key]
    inner[keys[-1]] = value
    return out


@pytest.fixture
def sim():
    return buckens.Simulation(buckens.Model.from_dict(TREE))


def test_a_dictionary_or_a_path_is_a_model(tmp_path):
    model = buckens.Model.from_dict(TREE)
    model.save(tmp_path / "cart.yaml")
    given = [model, TREE, str(tmp_path / "cart.yaml"), tmp_path / "cart.yaml"]
    ends = set()
    for one in given:
        sim = buckens.Simulation(one)
        sim.run()
        ends.add(sim.sensors["place"].tobytes())
        sim.save(tmp_path / "end")
        assert buckens.Simulation.resume(tmp_path / "end", one, until=20e-3).end_time == 20e-3
        assert buckens.check(one)["bodies"] == buckens.check(model)["bodies"]
    assert len(ends) == 1
    buckens.run(TREE, tmp_path / "out")
    assert buckens.open(tmp_path / "out").title == "Cart"
    assert buckens.Model(TREE).to_yaml() == buckens.load(TREE).to_yaml() == model.to_yaml()
    assert buckens.Simulation(buckens.load(TREE, set={"simulation.duration": "5 ms"})).end_time == 5e-3
    table = {"simulation.duration": [5e-3]}
    assert [row["status"] for row in buckens.sweep(TREE, table, tmp_path / "sweep")["variants"]] == ["done"]
    assert [row["status"] for row in buckens.sweep(TREE, table, tmp_path / "study", executor=1)["variants"]] == ["done"]


def test_callbacks_may_add_others(sim):
    calls = []

    @sim.on_step
    def first(now):
        if not calls:
            for _ in range(20):
                now.on_step(lambda _: calls.append("later"))
        calls.append("first")

    sim.run()
    # Those added in the first of ten steps begin with the second.
    assert calls.count("first") == 10 and calls.count("later") == 20 * 9


def test_arguments_of_simulations(sim):
    with pytest.raises(buckens.InputError, match="on_step: expected a function, found 3"):
        sim.on_step(3)
    with pytest.raises(buckens.InputError, match="time to advance to: expected a number, found '0.03'"):
        sim.advance("0.03")
    with pytest.raises(buckens.InputError, match="threads: expected a whole number from 1 to 256, found -1"):
        buckens.Simulation(buckens.Model.from_dict(TREE), threads=-1)


@pytest.mark.parametrize("path, value, words", [
    ("bodies.cart.rigid.mas", 3, ["bodies.cart.rigid", "mas", "mass"]),             # wrong key
    ("bodies.cart.rigid.mass", "2 m", ["bodies.cart.rigid.mass", "2 m", "kg"]),     # wrong unit
    ("bodies.cart.rigid.inertia", np.ones((3, 2)), ["bodies.cart.rigid.inertia"]),  # wrong shape
    ("bodies.cart.rigid.inertia", np.array(["1", "1", "x"]),                        # wrong dtype
     ["bodies.cart.rigid.inertia", "array of numbers", "dtype <U1"]),
    ("bodies.cart.rigid.mass", 1 + 2j, ["bodies.cart.rigid.mass", "(1+2j)", "complex"]),
    ("bodies.cart.rigid.mass", float("nan"), ["bodies.cart.rigid.mass", "nan"]),
    ("bodies.cart.markers", {3: {"position": [0, 0, 0]}}, ["bodies.cart.markers.3", "a string as key"]),
    ("bodies.cart.rigid", lambda: 3, ["bodies.cart.rigid", "function"]),
])
def test_models(path, value, words):
    with pytest.raises(buckens.InputError) as caught:
        buckens.Model.from_dict(tree(path, value))
    for word in words:
        assert word in str(caught.value)
    # The text that was made of the dictionary is nobody's file.
    assert "model.yaml" not in str(caught.value) and caught.value.file is None


def test_names_of_markers():
    with pytest.raises(buckens.InputError, match='drive.force.on.*"cart" has no marker "tip".*"top"'):
        buckens.Model.from_dict(tree("loads.drive.force.on", "cart/tip"))
    model = buckens.Model.from_dict(TREE)

    @model.force("cart/tpo")
    def push(t, x, v):
        return 0, 0, 0

    with pytest.raises(buckens.Error, match="tpo.*top"):
        buckens.Simulation(model)
    with pytest.raises(buckens.InputError, match="function 'push' as a force"):
        buckens.check(model)


def test_functions_are_checked_at_once(sim):
    model = buckens.Model.from_dict(TREE)
    for owner in (model, sim):
        with pytest.raises(buckens.InputError, match="force on 'cart': expected a function, found 5"):
            owner.force("cart")(5)
        with pytest.raises(buckens.InputError, match='force: expected a name, found the function .push.; write @.*force."rod/end"'):
            @owner.force
            def push(t, x, v):
                return 0, 0, 0
        with pytest.raises(buckens.InputError, match="force: expected a name, found 3"):
            owner.force(3)
        with pytest.raises(buckens.InputError, match="force: name: expected a name, found 3"):
            owner.force("cart", name=3)
        with pytest.raises(buckens.InputError, match=r"signal: expected a name, found the function 'angle'; write @.*signal\(\)"):
            @owner.signal
            def angle(t):
                return 0
    assert not model._forces and not model._signals and sim.time == 0


def test_a_force_is_given_once(sim):
    """As when a cell of a notebook is executed twice, which would double it."""
    model = buckens.Model.from_dict(TREE)
    for owner in (model, sim):
        owner.force("cart", name="push")(lambda t, x, v: (3, 0, 0))
        for marker, name in (("cart", "push"), ("cart/top", "push"), ("cart", "drive")):
            with pytest.raises(buckens.InputError, match=f"force on '{marker}': the model has a load '{name}' already; give another name"):
                owner.force(marker, name=name)(lambda t, x, v: (0, 0, 0))
    for one in (sim, buckens.Simulation(model)):
        one.run()
        assert one.sensors["place"][0] == pytest.approx(0.5 * (1 + 3) / 2 * 0.01 ** 2, rel=1e-9)


def test_texts_that_nobody_has_seen_are_not_cited(tmp_path):
    """A model of a dictionary or objects has no lines; those of a file are told, as in test_files."""
    steel = {"E": "200 GPa", "nu": 0.3, "rho": 7850}
    block = {"mesh": {"box": {"size": [0.2, 0.02, 0.01], "divisions": [4, 1, 1]}, "material": "steel"},
             "interfaces": {"root": {"face": "x9"}}}
    model = buckens.Model(materials={"steel": steel}, bodies={"bar": block}, simulation={"duration": 1, "step": 1})
    again = model.with_changes({"simulation.step": 0.5})
    for use in (buckens.Simulation, buckens.check, lambda one: buckens.run(one, tmp_path / "out")):
        for one in (model, again):
            with pytest.raises(buckens.InputError) as caught:
                use(one)
            assert str(caught.value).startswith('interface "root" of body "bar": the mesh has no face "x9"')
            assert (caught.value.file, caught.value.line, caught.value.column) == (None, None, None)
    model.save(tmp_path / "bar.yaml")
    for use in (buckens.Simulation, buckens.check):
        with pytest.raises(buckens.InputError, match=r'bar.yaml:\d+:\d+: interface "root"') as caught:
            use(tmp_path / "bar.yaml")
        assert caught.value.file == str(tmp_path / "bar.yaml")


def test_a_wrong_function_is_dropped(sim):
    @sim.force("cart")
    def sound(t, x, v):
        return 4, 0, 0

    assert sim.time == 0

    @sim.force("cart/tpo")
    def push(t, x, v):
        return 0, 0, 0

    with pytest.raises(buckens.Error, match="tpo.*top.*dropped from the simulation: force 'push' on 'cart/tpo'"):
        sim.time
    # The simulation is as it was before, with the force that was right.
    assert sim.time == 0
    sim.run()
    assert sim.sensors["place"][0] == pytest.approx(0.5 * (1 + 4) / 2 * 0.01 ** 2, rel=1e-9)


def test_files(tmp_path):
    with pytest.raises(buckens.IoError, match="nothing.yaml"):
        buckens.load(tmp_path / "nothing.yaml")
    (tmp_path / "wrong.yaml").write_text("buckens: 1\nbodies:\n  rod: {rigid: {mass: -1 kg}}\n")
    with pytest.raises(buckens.InputError) as caught:
        buckens.load(tmp_path / "wrong.yaml")
    error = caught.value
    assert (error.file, error.line) == (str(tmp_path / "wrong.yaml"), 3) and error.column > 1
    assert f"{error.file}:3:{error.column}: bodies.rod.rigid.mass" in str(error)
    with pytest.raises(buckens.InputError, match="simulation.stp.*step"):
        buckens.load(source("examples/slider_crank/slider_crank.yaml"), set={"simulation.stp": 1})
    with pytest.raises(buckens.IoError, match="no results.h5.*buckens run"):
        buckens.open(tmp_path)
    with pytest.raises(buckens.InputError, match="wrong.yaml:3:.*bodies.rod.rigid.mass"):
        buckens.Simulation(str(tmp_path / "wrong.yaml"))
    for take in (buckens.Simulation, buckens.check):
        with pytest.raises(buckens.InputError, match="expected a buckens.Model, a dictionary or the path of a model file, found 5"):
            take(5)
    with pytest.raises(buckens.InputError, match="load: expected the path of a model file or a dictionary, found 5"):
        buckens.load(5)
    with pytest.raises(buckens.InputError, match="Model: expected a dictionary.*found 'wrong.yaml'; buckens.load reads a file"):
        buckens.Model("wrong.yaml")
    with pytest.raises(buckens.InputError, match="Model: a dictionary and the keys title; put them into the dictionary"):
        buckens.Model(TREE, title="Cart")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("years of work")
    with pytest.raises(buckens.IoError, match="mine"):
        buckens.Simulation(buckens.Model.from_dict(TREE), out=tmp_path / "mine")
    assert (tmp_path / "mine" / "thesis.tex").read_text() == "years of work"


def test_time_and_its_end(sim):
    sim.advance(5e-3)
    with pytest.raises(buckens.InputError, match="t = 0.001 s is over.*0.005"):
        sim.advance(1e-3)
    with pytest.raises(buckens.InputError, match="expected an instant.*nan"):
        sim.advance(float("nan"))
    with pytest.raises(buckens.InputError, match="expected a number, found '5 ms'"):
        sim.advance("5 ms")
    sim.run()
    with pytest.raises(buckens.InputError, match="ended at t = 0.01 s"):
        sim.step()
    with pytest.raises(buckens.InputError, match="finished at t = 0.01 s"):
        sim.advance(1)
    no_end = {key: value for key, value in TREE.items() if key != "simulation"}
    with pytest.raises(buckens.InputError, match="no `simulation:`.*duration"):
        buckens.Simulation(buckens.Model.from_dict(no_end))


def test_a_run_that_was_ended_is_not_taken_for_a_whole_one():
    finished, failed, stopped, whole = (buckens.Simulation(TREE) for _ in range(4))
    finished.step()
    finished.finish()

    @failed.on_step
    def fail(now):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        failed.run()
    stopped.on_step(lambda now: now.stop())
    assert stopped.run()["steps"] == 1
    for sim in (finished, failed, stopped):
        for use in (sim.run, lambda: sim.advance(5e-3)):
            with pytest.raises(buckens.InputError, match="finished at t = 0.001 s.*begin another one, or resume"):
                use()
    assert whole.run() == whole.run()


def test_a_block_completes_the_results(tmp_path):
    with buckens.Simulation(TREE, out=tmp_path / "out") as sim:
        sim.advance(5e-3)
    assert buckens.open(tmp_path / "out").summary["end_time"] == pytest.approx(5e-3, rel=1e-12)
    with pytest.raises(RuntimeError, match="enough"), buckens.Simulation(TREE, out=tmp_path / "failed") as sim:
        sim.step()
        raise RuntimeError("enough")
    assert buckens.open(tmp_path / "failed").status == "interrupted"
    with pytest.raises(buckens.InputError, match="finished at t = 0.001 s"):
        sim.step()


def test_names_of_what_is_looked_at(sim):
    with pytest.raises(buckens.InputError, match="no body 'crat'.*cart"):
        sim.bodies["crat"]
    with pytest.raises(buckens.InputError, match="sensors/plac.*place"):
        sim.sensors["plac"]
    with pytest.raises(buckens.InputError, match="rigid.*frame"):
        sim.bodies["cart"].displacements
    with pytest.raises(ValueError, match="read-only"):
        sim.bodies["cart"].frame.position[0] = 1


def test_arrays_are_read_only_after_the_end(tmp_path):
    sim = buckens.Simulation(buckens.Model.from_dict(TREE), out=tmp_path / "out")
    place = sim.bodies["cart"].frame.position
    sim.run()
    sim.finish()
    with pytest.raises(ValueError, match="read-only"):
        place[0] = 1
    with pytest.raises(ValueError, match="WRITEABLE"):
        place.flags.writeable = True
    # Results are copies, which may be written; the file is as it was.
    run = buckens.open(tmp_path / "out")
    run["place"][:] = 1
    assert buckens.open(tmp_path / "out")["place"][0, 2] == 0


def test_values_of_loads(sim):
    for wrong in ([1, 2], "far", [1, "x", 3], [[1, 2, 3]]):
        with pytest.raises(buckens.InputError, match="'drive': expected three numbers, found"):
            sim.set_load("drive", wrong)
    with pytest.raises(buckens.InputError, match="drvie.*drive"):
        sim.set_load("drvie", [1, 2, 3])
    with pytest.raises(buckens.Error, match="finite|number"):
        sim.set_load("drive", [float("inf"), 0, 0])


def test_forces_of_the_wrong_kind(sim):
    model = buckens.Model.from_dict(TREE)
    results = [None, (1, 2), "far", np.ones((3, 1))]

    @model.force("cart")
    def push(t, x, v):
        return results[0]

    while results:
        with pytest.raises(TypeError, match='force on "cart" must be three numbers .N., found'):
            buckens.Simulation(model).run()
        results.pop(0)
        if not results:
            break
    results.append((float("nan"), 0, 0))
    with pytest.raises(buckens.NumericalError, match="not finite"):
        buckens.Simulation(model).run()
    with pytest.raises(buckens.InputError, match="comes too late"):
        sim.step()
        sim.force("cart")(push)


def test_use_from_within_a_step(sim):
    wrong = []

    @sim.force("cart")
    def curious(t, x, v):
        for use in (lambda: sim.step(), lambda: sim.sensors["place"], lambda: sim.save("x.h5")):
            try:
                use()
            except buckens.InputError as error:
                wrong.append(str(error))
        return 0, 0, 0

    @sim.on_step
    def nested(now):
        with pytest.raises(buckens.InputError, match="step: .*already advancing"):
            now.step()
        assert now.sensors["place"].shape == (3,)

    sim.step()
    assert any("already advancing" in text for text in wrong)
    assert any("within a step" in text for text in wrong)

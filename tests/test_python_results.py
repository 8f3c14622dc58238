# SPDX-License-Identifier: Apache-2.0
"""Results and verbs of the program from Python, and the module's types."""

import copy
import json
import math
import pathlib
import pickle
import subprocess
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from python_module import PACKAGES, SOURCE, buckens, source  # noqa: E402 (found after the path is set)

TREE = {
    "title": "Sagging bar", "gravity": [0, 0, "-9.81 m/s^2"],
    "materials": {"steel": {"E": "200 GPa", "nu": 0.3, "rho": 7850}},
    "bodies": {"bar": {"mesh": {"box": {"size": ["200 mm", "20 mm", "10 mm"], "divisions": [4, 1, 1]},
                                "material": "steel"}, "interfaces": {"root": {"face": "x0"}}}},
    "joints": {"clamp": {"fixed": {"between": ["ground", "bar/root"]}}},
    "simulation": {"duration": "20 ms", "step": "1 ms"},
    "output": {"every": "2 ms", "sensors": {"place": {"position": "bar/corner_100"}, "total": {"energy": "total"}},
               "fields": {"every": "10 ms", "record": ["von-mises"]}},
}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run of a beam with a sensor of three components and a scalar one."""
    out = tmp_path_factory.mktemp("results") / "out"
    sim = buckens.Simulation(buckens.load(source("examples/slider_crank/slider_crank.yaml"),
                                          set={"simulation.duration": "5 ms"}), out=out)
    sim.run()
    return buckens.open(out)


def test_results_are_arrays_with_units(run):
    assert repr(run) == f"<buckens.Results {str(run.directory)!r}: 'Flexible slider-crank', finished>"
    slider = run["slider"]
    assert slider.shape == (len(run.time), 3) and slider.unit == "m"
    assert slider.components == ("x", "y", "z")
    assert np.array_equal(slider[:, 0], run["slider.x"]) and run["slider.x"].unit == "m"
    assert run.time.unit == "s" and run.time[-1] == pytest.approx(5e-3)
    # Columns of sensors.csv are the same numbers.
    table = np.genfromtxt(run.directory / "sensors.csv", delimiter=",", skip_header=1)
    assert np.array_equal(table[:, 0], run.time)
    heads = (run.directory / "sensors.csv").read_text().splitlines()[0].split(",")
    assert np.array_equal(table[:, heads.index("slider.x [m]")], run["slider.x"])
    assert run["energies/total"].unit == "J" and "energies/total" in run.quantities
    assert run["bodies/rod/pose"].shape == (len(run.time), 7)
    # Results of calculations are plain: nobody knows their unit.
    assert type(slider * 2) is np.ndarray and type(slider[3:]) is buckens.Curve
    assert isinstance(np.max(run["slider.x"]), float)
    assert set(run.sensors) >= {"mid", "slider", "guide", "balance"}
    with pytest.raises(buckens.InputError, match="nothing is recorded as 'silder'.*'slider'"):
        run["silder"]
    with pytest.raises(buckens.InputError, match="'slider' has no component 'w'; it has x, y, z"):
        run["slider.w"]
    with pytest.raises(buckens.InputError, match="no field .* ask for them in `output"):
        run.field("von_mises", body="rod")
    assert run.summary["title"] == run.title == "Flexible slider-crank"
    assert run.energy_account["brought_in"] and run.energy_account == run.summary["energy_account"]


def test_curves_reach_other_processes_with_their_units(run):
    for one in (run["slider"], run["slider.x"], run["slider"][3:]):
        again = pickle.loads(pickle.dumps(one))
        assert np.array_equal(again, one) and type(again) is buckens.Curve
        assert (again.name, again.unit, again.components) == (one.name, one.unit, one.components)
        assert copy.deepcopy(one).unit == one.unit == "m"


def test_a_run_in_progress_shows_all_its_records(tmp_path):
    """Records reach the file within a second; a reader in the same process does not wait for them."""
    sim = buckens.Simulation(TREE, out=tmp_path / "out")
    run = buckens.open(tmp_path / "out")
    first = run._repr_html_()
    assert "Sagging bar: no records yet" in first or "<iframe" in first
    sim.advance(10e-3)
    assert np.allclose(run.time, np.arange(0, 11e-3, 2e-3), rtol=0, atol=1e-12)
    assert len(run["place"]) == 6 and np.allclose(run.field_times, [0, 10e-3])
    assert "<iframe" in run._repr_html_()
    sim.advance(12e-3)
    assert len(buckens.open(tmp_path / "out").time) == 7
    assert buckens.view(tmp_path / "out", tmp_path / "page.html")["frames"] == 7

    seen = []

    @sim.on_step
    def look(now):
        seen.append(run.time[-1])

    sim.run()
    assert seen[-1] == run.time[-1] == pytest.approx(20e-3) and seen[1] == pytest.approx(14e-3)


def test_what_was_recorded_stays_readable_when_the_disk_is_full(run):
    from buckens import live_records

    class Full:
        def flush(self):
            raise buckens.IoError("no space left on device")

    full = Full()
    before = run.time
    live_records.flush_before_reading(run.directory, full)
    assert np.array_equal(run.time, before) and len(before)


def test_plots_have_names_and_units(run):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = run.plot("slider.x", "mid")
    assert axes.get_xlabel() == "t [s]" and axes.get_ylabel() == "[m]"
    labels = [line.get_label() for line in axes.get_lines()]
    assert labels[0] == "slider.x" and labels[1] == "mid.x"
    assert np.array_equal(axes.get_lines()[0].get_ydata(), run["slider.x"])


def test_tables_of_pandas_hold_the_sensors(run):
    pandas = pytest.importorskip("pandas")
    table = run.to_pandas("slider", "balance")
    assert isinstance(table, pandas.DataFrame)
    assert list(table.columns) == ["slider.x", "slider.y", "slider.z", "balance"]
    assert np.array_equal(table["slider.x"], run["slider.x"]) and table.index.name == "t"


def test_a_dataset_of_xarray_holds_the_sensors_with_units(run):
    pytest.importorskip("xarray")
    data = run.to_xarray()
    assert set(data.data_vars) == set(run.sensors) and data["slider"].dims == ("t", "slider_0")
    assert np.array_equal(data["slider"].values, run["slider"]) and data["slider"].attrs["units"] == "m"
    assert np.array_equal(data["t"].values, run.time) and data["t"].attrs["units"] == "s"
    assert data["balance"].dims == ("t",) and data["balance"].attrs["units"] == "J"


def test_a_run_is_shown_in_a_notebook(run):
    page = run._repr_html_()
    assert page.startswith("<iframe srcdoc=") and "Flexible slider-crank" in page
    assert pathlib.Path(run.view()).name == "view.html"


def test_verbs_take_files_and_models(run, tmp_path):
    crank = source("examples/slider_crank/slider_crank.yaml")
    by_file = buckens.check(crank, set={"bodies.rod.beam.elements": 4})
    model = buckens.load(crank, set={"bodies.rod.beam.elements": 4})
    assert by_file == buckens.check(model) and by_file["bodies"]["rod"]["elements"] == 4
    lowest = buckens.modes(model, body="rod", count=2)["analyses"][0]["modes"][0]["frequency"]
    # Free-free bending of a round steel rod, diameter d: 4.730^2/(2 pi L^2) sqrt(E d^2/16/rho); four
    # elements leave 0.1 %.
    exact = 4.7300407**2 / (2 * np.pi * 0.3**2) * np.sqrt(200e9 * 0.006**2 / 16 / 7870)
    assert lowest == pytest.approx(exact, rel=3e-3)
    table = buckens.sweep(crank, {"bodies.rod.beam.elements": [2, 4]}, tmp_path / "sweep",
                          set={"simulation.duration": "1 ms"})
    assert [v["status"] for v in table["variants"]] == ["done", "done"]
    names = [pathlib.Path(v["directory"]).name for v in table["variants"]]
    first, second = (tmp_path / "sweep" / name for name in names)
    assert buckens.compare(first, second)["largest_relative_difference"] > 1e-6
    with pytest.raises(buckens.DifferenceError, match="more than the tolerance"):
        buckens.compare(first, second, tolerance=1e-9)
    static = buckens.static(source("examples/large_bend/large_bend.yaml"), tmp_path / "static")
    assert static["status"] == "finished"
    assert "load-factor" in buckens.open(tmp_path / "static").sensors


def test_meshes_are_read_and_converted(tmp_path):
    deck = source("examples/bracket_inp/bracket.inp")
    info = buckens.mesh_info(deck, length_unit="mm")
    assert info["nodes"] > 8 and info["volume"] > 0
    out = buckens.convert(deck, tmp_path / "bracket.msh", length_unit="mm")
    assert (tmp_path / "bracket.msh").is_file() and out["nodes"] == info["nodes"]
    with pytest.raises(buckens.IoError, match="nothing.inp"):
        buckens.mesh_info(tmp_path / "nothing.inp")


def test_types_are_right(tmp_path):
    """mypy over the package, and over a program that uses it rightly and wrongly."""
    mypy = pathlib.Path("/usr/bin/mypy")
    if not mypy.exists():
        pytest.skip("mypy is not installed")
    uses = ("import buckens\n"
            "sim = buckens.Simulation(buckens.load('x.yaml'))\n"
            "t: float = sim.time\n"
            "x: str = sim.time\n"
            "sim.advance('far')\n")
    # With the same options the second call takes what the first one has read of NumPy.
    mypy = [mypy, "--strict", f"--cache-dir={tmp_path}", "--ignore-missing-imports"]
    call = subprocess.run([*mypy, "-p", "buckens"], cwd=PACKAGES, capture_output=True, text=True, timeout=300)
    assert call.returncode == 0, call.stdout + call.stderr
    call = subprocess.run([*mypy, "-c", uses], cwd=PACKAGES, capture_output=True, text=True, timeout=300)
    assert "<string>:4: error" in call.stdout and "<string>:5: error" in call.stdout
    assert "<string>:3: error" not in call.stdout and "<string>:2: error" not in call.stdout


def test_the_stub_of_the_core_names_what_is_there():
    """Each function of the compiled part is in its stub, and nothing else."""
    import ast
    import importlib

    core = importlib.import_module("buckens._core")
    stub = ast.parse((SOURCE / "python" / "buckens" / "_core.pyi").read_text())
    for node in stub.body:
        if isinstance(node, ast.ClassDef):
            named = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
            there = {name for name in vars(getattr(core, node.name)) if not name.startswith("_")}
            assert named - {"__init__"} == there
    functions = {node.name for node in stub.body if isinstance(node, ast.FunctionDef)}
    assert functions == {name for name, value in vars(core).items() if type(value).__name__ == "builtin_function_or_method"}
    assert (PACKAGES / "buckens" / "py.typed").exists()


def test_fields_by_the_words_of_the_model_file_and_within_the_run(tmp_path):
    buckens.Simulation(TREE, out=tmp_path / "out").run()
    run = buckens.open(tmp_path / "out")
    last = run.field("von_mises", "bar", t=0.02)
    assert np.array_equal(run.field("von-mises", "bar"), last) and last.size
    # Fields every 10 ms, records every 2 ms: half an interval beyond them is theirs.
    assert np.array_equal(run.field("von_mises", "bar", t=0.0249), last)
    assert np.array_equal(run.mesh("bar", t=0.0209).points, run.mesh("bar", t=0.02).points)
    for t in (-0.006, 0.0251, 20, math.inf, math.nan):
        with pytest.raises(buckens.InputError, match="t = .* s: the fields span t = 0 s to 0.02 s; give a time"):
            run.field("von_mises", "bar", t=t)
    for t in (-0.0011, 0.0211, math.nan):
        with pytest.raises(buckens.InputError, match="t = .* s: the records span t = 0 s to 0.02 s; give a time"):
            run.mesh("bar", t=t)


def test_a_package_that_is_missing_is_named(run, monkeypatch):
    mesh = run.mesh("rod")
    for name, use in (("xarray", run.to_xarray), ("meshio", mesh.to_meshio), ("pyvista", mesh.to_pyvista),
                      ("pandas", run.to_pandas), ("matplotlib", run.plot), ("h5py", lambda: run.time)):
        with monkeypatch.context() as without:
            for known in [known for known in sys.modules if known.split(".")[0] == name]:
                without.delitem(sys.modules, known)
            without.setattr(sys, "meta_path", [Without(name), *sys.meta_path])
            with pytest.raises(ModuleNotFoundError, match=f"needs the package {name}, .*: python3 -m pip install {name}"):
                use()


class Without:
    """Finds no such package, installed or not."""

    def __init__(self, name):
        self.name = name

    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] == self.name:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)


def test_models_of_objects_are_those_of_dictionaries():
    """The classes come from the schema; objects, dictionary and file say the same."""
    steel = buckens.Material(E="200 GPa", nu=0.3, rho=7850)
    beam = buckens.Beam(to=["500 mm", 0, 0], elements=4, material="steel", up=np.array([0, 1, 0]),
                        section=buckens.CircleSection(diameter="10 mm"), rotary_inertia="on",
                        at={"position": [0, 0, 1]})
    model = buckens.Model(
        title="Cantilever", materials={"steel": steel}, bodies={"beam": beam},
        joints={"clamp": buckens.Fixed(between=["ground", "beam/start"])},
        loads={"push": buckens.Force(on="beam/end", value=[0, 0, "-10 N"])},
        simulation={"duration": "1 ms", "step": "0.1 ms"},
        output={"sensors": {"tip": buckens.PositionSensor(of="beam/end")}})
    tree = {"buckens": 1, "title": "Cantilever",
            "materials": {"steel": {"E": "200 GPa", "nu": 0.3, "rho": 7850}},
            "bodies": {"beam": {"beam": {"to": ["500 mm", 0, 0], "elements": 4,
                                         "section": {"circle": {"diameter": "10 mm"}},
                                         "material": "steel", "up": [0, 1, 0],
                                         "rotary-inertia": "on"},
                                "at": {"position": [0, 0, 1]}}},
            "joints": {"clamp": {"fixed": {"between": ["ground", "beam/start"]}}},
            "loads": {"push": {"force": {"on": "beam/end", "value": [0, 0, "-10 N"]}}},
            "simulation": {"duration": "1 ms", "step": "0.1 ms"},
            "output": {"sensors": {"tip": {"position": {"of": "beam/end"}}}}}
    assert model.to_yaml() == buckens.Model.from_dict(tree).to_yaml()
    assert buckens.check(model)["degrees_of_freedom"] == 0
    assert repr(buckens.Fixed(between=["ground", "a"])) == "Fixed(between=['ground', 'a'])"
    for wrong, words in (({"too": 3}, "buckens.Beam has no argument 'too'; did you mean 'to'?"),
                         ({"elemnts": 3}, "buckens.Beam has no argument 'elemnts'; did you mean 'elements'?"),
                         ({"qqq": 3}, "buckens.Beam has no argument 'qqq'; there are to, section, material")):
        with pytest.raises(TypeError) as caught:
            buckens.Beam(to=[1, 0, 0], section="s", material="m", **wrong)
        assert words in str(caught.value)
    with pytest.raises(TypeError, match=r"buckens.Fixed takes its arguments by name \(between=...\), found \['ground', 'a'\]"):
        buckens.Fixed(["ground", "a"])
    assert copy.deepcopy(steel) == pickle.loads(pickle.dumps(steel)) == steel
    # Every kind of body, joint and load of the format has its class.
    schema = json.loads(pathlib.Path(source("schema/model.schema.json")).read_text())["properties"]
    kinds = [kind["required"][0] for part in ("bodies", "joints", "loads")
             for kind in schema[part]["additionalProperties"]["oneOf"] if kind["required"] != ["like"]]
    assert len(kinds) > 40
    for kind in kinds:
        assert hasattr(buckens, "".join(word.capitalize() for word in kind.split("-"))), kind


def test_the_tutorial_works_as_it_is_written(tmp_path, monkeypatch, capsys):
    """docs/tutorials/python.md: from a file to a plot, a model of objects, and a study."""
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    (tmp_path / "examples").symlink_to(SOURCE / "examples")
    monkeypatch.chdir(tmp_path)
    text = (SOURCE / "docs" / "tutorials" / "python.md").read_text()
    blocks = [block.split("```")[0] for block in text.split("```python\n")[1:]]
    first, objects, arrays, stopped, controller, force, setting, signal, study, whole = blocks
    names = {}
    exec(first, names)
    assert names["summary"]["steps"] == 2000
    assert (tmp_path / "mid.png").read_bytes().startswith(b"\x89PNG") and (tmp_path / "mid.png").stat().st_size > 1000
    drawn = matplotlib.pyplot.gca()
    (line,) = drawn.lines
    assert (drawn.get_xlabel(), drawn.get_ylabel(), drawn.get_title()) == ("t [s]", "[m]", names["run"].title)
    assert [text.get_text() for text in drawn.get_legend().get_texts()] == ["mid.y"]
    assert (line.get_xdata() == names["run"].time).all() and (line.get_ydata() == names["run"]["mid.y"]).all()
    exec(objects.replace('"1 s"', '"10 ms"'), names)
    exec(stopped.replace("0.2", "2e-3"), names)
    assert names["sim"].time == pytest.approx(10e-3, rel=1e-12)
    exec(study, names)
    exec(whole, names)
    exec(arrays, names)
    assert buckens.check(names["cantilever"])["bodies"]["bar"]["elements"] == 2
    shown = capsys.readouterr().out.splitlines()
    exec(setting, names)
    # Constant torque: 4 rad/s^2 for half a second, integrated exactly.
    assert [float(word) for word in capsys.readouterr().out.split()] == pytest.approx([0.5, 2.0], rel=1e-9)
    exec(signal, names)
    turned = buckens.Simulation(names["shaft"])
    turned.run()
    # w = 20 rad/s, damping ratio 0.2: e^(-4) of the way is left.
    assert turned.signals["angle"] == pytest.approx(0.5, abs=0.5 * math.exp(-4))
    # Two lines of the first block, and a height per variant: 10 ms of fall about the hinge.
    assert len(shown) == 2 + 3 + 2
    # Steps of 0.5 ms over 10 ms of a fall by 0.4 mm: well below its height.
    assert 0 < float(shown[5]) < 1e-4 and float(shown[6]) == pytest.approx(15e-3, rel=1e-12)
    for line in shown[2:5]:
        assert float(line.split()[-1]) == pytest.approx(-0.75 * 9.81 * 0.01**2, rel=0.3)
    names["sim"] = buckens.Simulation(names["model"])
    exec(force, names)
    exec(controller, names)
    with pytest.raises(buckens.InputError, match="sensors/angle.value"):
        names["sim"].run()

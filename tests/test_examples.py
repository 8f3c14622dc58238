# SPDX-License-Identifier: Apache-2.0
"""Every example runs and shows the physics described on its page; so does the model in README.md."""

import csv
import itertools
import json
import math
import os
import pathlib
import re
import subprocess
import sys

import numpy
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from slider_crank import middle_deflections  # noqa: E402

SOURCE = pathlib.Path(os.environ.get("BUCKENS_SOURCE_DIR", pathlib.Path(__file__).parents[1]))
BINARY = pathlib.Path(os.environ.get("BUCKENS_BINARY_DIR", SOURCE / "build" / "release"))
PROGRAM = pathlib.Path(os.environ.get("BUCKENS_PROGRAM", BINARY / "bin" / "buckens"))
EXAMPLES = SOURCE / "examples"
G = 9.81


class Run:
    """A finished run: columns of sensors.csv by name, and summary.json."""

    def __init__(self, model, out, **settings):
        command = [PROGRAM, "run", model, "-o", out, "--quiet"]
        for path, value in settings.items():
            command += ["--set", f"{path.replace('__', '.')}={value}"]
        done = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        with open(out / "sensors.csv", newline="") as file:
            rows = list(csv.reader(file))
        table = numpy.array(rows[1:], dtype=float)
        self.names = [re.sub(r" \[.*\]$", "", name) for name in rows[0]]
        self.columns = {name: table[:, k] for k, name in enumerate(self.names)}
        self.summary = json.loads((out / "summary.json").read_text())
        assert self.summary["finished"]

    def __getitem__(self, name):
        return self.columns[name]

    def vector(self, name, axes="xyz"):
        return numpy.column_stack([self[f"{name}.{axis}"] for axis in axes])

    def at(self, name, time):
        """Value recorded at this time; records must fall on it."""
        index = int(numpy.argmin(numpy.abs(self["t"] - time)))
        assert abs(self["t"][index] - time) < 1e-9
        return self[name][index]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Runs examples/<name>.yaml with changed settings (a__b=1 stands for --set a.b=1)."""
    def start(name, **settings):
        return Run(EXAMPLES / f"{name}.yaml", tmp_path_factory.mktemp("run") / "out", **settings)
    return start


def elliptic_k(k):
    """Complete elliptic integral of the first kind by the arithmetic-geometric mean."""
    a, b = 1.0, math.sqrt(1.0 - k * k)
    while abs(a - b) > 1e-15:
        a, b = 0.5 * (a + b), math.sqrt(a * b)
    return math.pi / (2.0 * a)


def crossings(t, y):
    """Times at which y changes sign, by cubic interpolation through the four nearest records."""
    found = []
    for k in numpy.nonzero(y[:-1] * y[1:] < 0.0)[0]:
        if k < 1 or k + 3 > len(t):
            continue
        found.append(numpy.polyval(numpy.polyfit(y[k - 1:k + 3], t[k - 1:k + 3] - t[k], 3), 0.0) + t[k])
    return numpy.array(found)


def test_pendulum_has_the_period_of_a_large_swing(run):
    r = run("pendulum/pendulum", output__every="10 ms")
    # From the horizontal: amplitude 90 degrees, T = 4 sqrt(I/(m g s)) K(sin 45 deg).
    period = 4.0 * math.sqrt((1.0 / 3.0) / (G * 0.5)) * elliptic_k(math.sin(math.pi / 4.0))
    bottom = crossings(r["t"], r["angle"] + 0.5 * math.pi)
    assert len(bottom) == 2
    # Order 2 with h = 1 ms and w = 3.25 rad/s: (w h)^2 = 1e-5, times a constant below one.
    assert 2.0 * (bottom[1] - bottom[0]) == pytest.approx(period, rel=1e-5)
    assert numpy.ptp(r["energy"]) < 1e-5 * G  # of the energy that changes form, m g s = 4.9 J
    # At the bottom the bearing carries m g (1 + 3/2): m g + m w^2 s with w^2 = 3 g / L.
    assert r["bearing.y"].max() == pytest.approx(2.5 * G, rel=1e-3)  # records miss the bottom


def test_double_pendulum_follows_the_reference(run):
    r = run("double_pendulum/double_pendulum", simulation__duration="1 s", output__every="0.5 s")
    # Absolute angles from the downward vertical, from an integration with an error of 1e-14
    # (verification/rigid_double_pendulum). At t = 1 s a step of 0.1 ms must be good to 1e-6 rad.
    reference = {0.5: (0.4481426259320015, 1.0419628873038667),
                 1.0: (-1.207716238190638, -0.8143910230912964)}
    for time, (upper, lower) in reference.items():
        assert r.at("upper_angle", time) + 0.5 * math.pi == pytest.approx(upper, abs=1e-6)
        assert r.at("lower_angle", time) + 0.5 * math.pi == pytest.approx(lower, abs=1e-6)
    # Joints of a model in space close as well as in the plane.
    assert r.summary["residuals"]["position"] < 1e-12


def test_block_pendulum_falls_like_a_rigid_one_that_bends_a_little(run):
    coarse = run("block_pendulum/block_pendulum")
    finer = run("block_pendulum/block_pendulum", bodies__block__mesh__box__divisions="[36,2,2]")
    # Rigid block about the middle of its end face: I/m = 1/3 + 0.1^2/12.
    def rate(y):
        return numpy.array([y[1], -G * 0.5 / (1.0 / 3.0 + 0.01 / 12.0) * math.cos(y[0])])
    y, h = numpy.zeros(2), 1e-4
    for _ in range(1000):
        k1 = rate(y)
        k2 = rate(y + 0.5 * h * k1)
        k3 = rate(y + 0.5 * h * k2)
        y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3))
    # The tip bends back by about w L^4 / (100 E I) = 4e-6 m, and the first vibration is about that position.
    for r in (coarse, finer):
        assert r.at("tip.y", 0.1) == pytest.approx(math.sin(y[0]), abs=2e-5)
        assert numpy.abs(r["tip.z"]).max() < 1e-9
        assert r.summary["bodies"]["block"]["factorisations"] == 1
    assert 1e-9 < numpy.abs(coarse.vector("tip") - finer.vector("tip")).max() < 5e-6


def test_two_link_arm_of_solids_moves_like_one_of_beams(run):
    # Coarser than on the page, to save time.
    solid = run("two_link_arm/two_link_arm", bodies__upper__mesh__box__divisions="[12,2,2]")
    beams = run("two_link_arm/beams")
    assert abs(solid.at("tip.x", 0.4) - 1.2) > 1.0
    # The page's mesh differs by 5e-9 m, of a bending of 4e-6 m; four times coarser elements of order
    # two bend by up to some per cent less.
    assert numpy.abs(solid.vector("tip") - beams.vector("tip")).max() < 1e-7
    for bend in ("upper_bend.y", "lower_bend.y"):
        largest = numpy.abs(beams[bend]).max()
        assert largest > 3e-6
        assert numpy.abs(solid[bend] - beams[bend]).max() < 0.03 * largest
    # Equal links share one factor.
    assert sum(solid.summary["bodies"][link]["factorisations"] for link in ("upper", "lower")) == 1


def test_flexible_pendulum_follows_the_reference(run):
    r = run("flexible_pendulum/flexible_pendulum", simulation__duration="0.3 s",
            output__every="50 ms")
    # Tip of the same discretisation (8 elements, one frame, full coupling), computed independently;
    # verification/flexible_pendulum found 4e-7 m at this step of 0.05 ms.
    reference = {0.05: (0.9998359378075699, -0.018128318565289226),
                 0.10: (0.9973406013686714, -0.07289645803622824),
                 0.15: (0.9864270026451925, -0.16421514272378218),
                 0.20: (0.9572668013377303, -0.2892209932740769),
                 0.25: (0.8975812568432746, -0.4408637679322166),
                 0.30: (0.7947232448545546, -0.6069866878365786)}
    for time, (x, y) in reference.items():
        assert math.hypot(r.at("tip.x", time) - x, r.at("tip.y", time) - y) < 1e-6
    body = r.summary["bodies"]["beam"]
    assert body["factorisations"] == 1
    assert r.summary["residuals"]["sieve"] < 1e-12


@pytest.fixture(scope="module")
def slider_crank(run):
    return run("slider_crank/slider_crank")


def test_slider_crank_starts_straight_and_bends(slider_crank):
    r = slider_crank
    deflection = numpy.linalg.norm(r.vector("mid"), axis=1) / 0.3
    assert deflection[0] == 0.0  # the rod is undeformed at t = 0
    # The independent route below has its first peak at 0.018772 L; those of the next two turns are
    # 0.1 % higher, and records every 0.25 ms miss peaks by less than that.
    assert deflection.max() == pytest.approx(0.018772, rel=5e-3)
    # The slider stays within the range of crank and rod: |r - L| ... r + L, and on its line.
    assert r["slider.x"].max() < 0.45 + 1e-4 and r["slider.x"].min() > 0.15 - 1e-3
    assert numpy.abs(r["slider.y"]).max() < 1e-12
    assert r.summary["bodies"]["rod"]["factorisations"] == 1
    assert r.summary["energy_error"] < 1e-2


def test_slider_crank_bends_as_an_independent_route_says(run):
    r = run("slider_crank/slider_crank", bodies__rod__beam__elements=4, simulation__duration="6 ms",
            simulation__step="2 us", output__every="50 us")
    t, deflection = middle_deflections(elements=4, duration=6e-3, steps=960)
    assert r["t"] == pytest.approx(t[::8], abs=1e-12)
    # Measured: 7e-8 at t = 5 ms with this step, 1e-8 with half of it. The axial vibration of rod and
    # slider (18 500 rad/s) needs the short step.
    assert numpy.abs(r["mid.y"] / 0.3 - deflection[::8]).max() < 3e-7


def test_slider_crank_in_space_is_the_same_machine(run, slider_crank):
    planar = slider_crank
    spatial = run("slider_crank/slider_crank_3d")
    # Planar matrices are the spatial ones with rows removed, and nothing moves out of the plane:
    # only the order of rounding differs. Measured: 6e-16 m, 2e-15 m and 1.5e-8 N of 188 N.
    for name in ("mid.x", "mid.y", "slider.x"):
        assert numpy.abs(spatial[name] - planar[name]).max() < 1e-13
    assert numpy.abs(spatial["guide.y"] - planar["guide.y"]).max() < 1e-6
    for name in ("mid.z", "slider.y", "slider.z"):
        assert numpy.abs(spatial[name]).max() < 1e-13


def euler_flips(J, w, duration, steps):
    """Times at which w_y changes sign in torque-free rotation, by the classical Runge-Kutta method."""
    def rate(w):
        return numpy.array([(J[1] - J[2]) * w[1] * w[2] / J[0], (J[2] - J[0]) * w[2] * w[0] / J[1],
                            (J[0] - J[1]) * w[0] * w[1] / J[2]])
    h = duration / steps
    found = []
    for k in range(steps):
        a = rate(w)
        b = rate(w + 0.5 * h * a)
        c = rate(w + 0.5 * h * b)
        after = w + h / 6.0 * (a + 2.0 * b + 2.0 * c + rate(w + h * c))
        if w[1] * after[1] < 0.0:
            found.append(h * (k + w[1] / (w[1] - after[1])))
        w = after
    return found


def test_gas_pushes_the_piston_of_solids_as_its_table_says(run):
    out = run("pressurised_piston/pressurised_piston")
    rows = [line.split(",") for line in (EXAMPLES / "pressurised_piston" / "gas.csv").read_text().split()
            if line[0].isdigit()]
    area = math.pi * 0.04**2
    for time, bar in rows:
        # The quadratic elements of the crown form its rim of sixteen parabolas, 1e-5 from a circle.
        assert out.at("gas.x", float(time)) == pytest.approx(-float(bar) * 1e5 * area, rel=1e-4, abs=1e-6)
    # Held by the pin in its middle, the crown bends down around it, most when the pressure is highest.
    assert abs(out["t"][numpy.argmax(out["crown.x"])] - out["t"][numpy.argmin(out["gas.x"])]) < 0.5e-3
    assert 1.5e-7 < out["crown.x"].max() < 3e-7
    # Newton's law for the piston: gas, pin (its force on the second marker, the piston) and liner.
    mass = 2750 * area * 0.04
    t, x = out["t"], out["piston.x"]
    acceleration = numpy.gradient(numpy.gradient(x, t), t)[2:-2]
    force = (out["gas.x"] + out["pin.x"])[2:-2]
    # Differences over 0.25 ms average the vibration of the start, some kN.
    assert abs(numpy.mean(force - mass * acceleration)) < 0.02 * numpy.abs(force).max()
    # J, of some 1000 J that the crank supplies and absorbs.
    assert numpy.abs(out["balance"]).max() < 0.1


def test_spinning_body_flips_and_keeps_its_momentum(run):
    r = run("spinning_body/spinning_body")
    J = numpy.array([1e-2, 2e-2, 3e-2])
    w = r.vector("spin")
    energy = 0.5 * (w * w) @ J
    momentum = numpy.linalg.norm(w * J, axis=1)
    # Order 2: (|w| h)^2 = 1e-4 times a constant below one. Found 8e-6 and 4e-6.
    assert numpy.abs(energy / energy[0] - 1.0).max() < 1e-4
    assert numpy.abs(momentum / momentum[0] - 1.0).max() < 1e-4
    assert r["energy"] == pytest.approx(energy, rel=1e-12)
    # The body turns over when w_y changes sign; (|w| h)^2 = 1e-4 of five seconds bounds the time.
    flips = crossings(r["t"], w[:, 1])
    assert flips == pytest.approx(euler_flips(J, w[0], 5.0, 5000), abs=5e-4)
    assert len(flips) == 2


def test_balls_come_to_rest_in_a_tray(run):
    r = run("balls_in_tray/balls_in_tray")
    radius = {"wood": 28e-3, "glass": 20e-3, "steel": 16e-3}
    mass = {"wood": 64.37e-3, "glass": 83.78e-3, "steel": 134.7e-3}
    # Where each ball ends is decided by rounding; that it rests on something within the tray is not.
    for name in ("wood", "steel"):
        assert radius[name] - 1e-6 < r[name + ".z"][-1] < 0.2
        assert numpy.abs([r[f"{name}.{axis}"][-1] for axis in "xy"]).max() < 75e-3 - radius[name] + 1e-6
    heights = numpy.arange(70, 70 + 12 * 55, 55) * 1e-3
    fallen = G * sum(mass[kind] * (z - 3 * radius[kind]) for z, kind in zip(heights, itertools.cycle(mass)))  # at least, one above the other
    assert r["lost"][-1] > fallen
    assert r["moving"][-1] < 1e-2 * r["moving"].max()
    assert r["heap.touching"][-1] >= 12
    # What blows of one body within a step leave open (theory/25-contact.md, 5).
    assert numpy.abs(r["balance"]).max() < 0.05 * r["lost"][-1]


def test_tumbling_block_turns_over_nearly_like_a_rigid_one(run):
    r = run("tumbling_block/tumbling_block")
    J = 1100 * 0.3 * 0.2 * 0.05 / 12 * numpy.array([0.2**2 + 0.05**2, 0.3**2 + 0.05**2,
                                                    0.3**2 + 0.2**2])
    rigid = euler_flips(J, numpy.array([0.5, 12.0, 0.0]), 1.0, 4000)
    # Elastic and rigid motion exchange (|w|/w_1)^2 < 1 % of the energy.
    assert crossings(r["t"], r["spin.y"]) == pytest.approx(rigid, rel=0.01)
    path = numpy.outer(r["t"], [0, 0.2, 0])
    assert numpy.abs(r.vector("com") - path).max() < 1e-12
    assert 0 < 1 - r["energy"][-1] / r["energy"][0] < 3e-3
    assert (numpy.diff(r["energy"]) < 1e-6 * r["energy"][0]).all()
    assert (r["peak.mises"] >= r["middle.mises"] * (1 - 1e-12)).all()
    assert 20e3 < r["peak.mises"].max() < 60e3
    assert r.summary["bodies"]["block"]["spin_over_lowest_frequency"] == pytest.approx(0.08, abs=0.005)
    assert r.summary["trust"] == "ok"


def test_door_on_two_hinges_swings_as_the_spring_says(run):
    r = run("door/door")
    # Five of the ten hinge equations follow from the others.
    redundant = r.summary["redundant_constraints"]
    assert redundant and all("hinge" in text for text in redundant)
    assert sum(int(re.search(r": (\d+) of its", text).group(1)) for text in redundant) == 5
    # One degree of freedom: a linear oscillator about -90 degrees.
    m, s, k, c = 20.0, 0.4, 4.0, 3.0
    J = 1.1 + m * s * s
    decay = c / (2.0 * J)
    w = math.sqrt(k / J - decay * decay)
    t = r["t"]
    angle = 0.5 * math.pi * (numpy.exp(-decay * t) * (numpy.cos(w * t) + decay / w * numpy.sin(w * t)) - 1.0)
    # Order 2: (w h)^2 = 2e-5 of a right angle, times a constant below one.
    assert numpy.abs(r["opening"] - angle).max() < 2e-5
    lower, upper = r.vector("lower"), r.vector("upper")
    # The weight is shared evenly: least-norm forces. Together the hinges carry m (a - g).
    assert lower[:, 2] == pytest.approx(upper[:, 2], abs=1e-6 * m * G)
    assert lower[:, 2] + upper[:, 2] == pytest.approx(m * G, rel=1e-9)


def lead_lag_frequency(r):
    """Frequency of the sine that fits the tip's deflection best."""
    t, y = r["t"], r["tip.y"]

    def misfit(w):
        basis = numpy.column_stack([numpy.cos(w * t), numpy.sin(w * t), numpy.ones_like(t)])
        return numpy.linalg.norm(basis @ numpy.linalg.lstsq(basis, y, rcond=None)[0] - y)

    coarse = min(numpy.arange(2.0, 6.0, 0.01), key=misfit)
    return min(numpy.arange(coarse - 0.01, coarse + 0.01, 0.0005), key=misfit)


def test_rotating_beam_is_stiffened_by_frames(run):
    # Linearised equations with as many frames; the second mode in the fit costs 0.07 %.
    eight = run("rotating_beam/rotating_beam")
    assert lead_lag_frequency(eight) == pytest.approx(4.480, rel=2e-3)
    assert eight.summary["bodies"]["beam"]["frames"] == 8
    # At the sections next to the hub, the tension is that of the whole beam, less the
    # half of an element: rho A Omega^2 (L^2 - x^2) / 2.
    tension = 0.5 * 1.2 * 36.0 * 100.0
    assert numpy.mean(eight["root.force.N"][50:]) == pytest.approx(tension, rel=5e-3)
    one = run("rotating_beam/rotating_beam", bodies__beam__frames=1)
    assert lead_lag_frequency(one) == pytest.approx(3.282, rel=2e-3)
    assert any("more `frames`" in text for text in one.summary["warnings"])
    assert any("of its buckling load" in text for text in one.summary["trust"])


def test_large_bend_reaches_the_known_tip(run):
    r = run("large_bend/large_bend")
    tip = r.vector("tip")
    # Geometrically exact solution, known to 0.05; the polygon of 16 elements adds 0.01.
    moved = tip[0] - numpy.array([70.7107, 29.2893, 0.0])
    assert moved == pytest.approx([-23.82, -13.73, 53.61], abs=0.06)
    # A start in equilibrium stays there.
    assert numpy.abs(tip - tip[0]).max() < 1e-6
    # Moment about the clamp: arm times force.
    assert abs(r["clamp.x"][0]) == pytest.approx(600.0 * tip[0][1], rel=1e-6)
    assert abs(r["clamp.y"][0]) == pytest.approx(600.0 * tip[0][0], rel=1e-6)


def test_truss_snaps_through(run):
    # Static paths of this example and the next: tests/test_static.py.
    reference = json.loads((SOURCE / "verification/von_mises_truss/reference.json").read_text())
    table = reference["A"]["dyn"]["Fdot_10000"]
    for bars in (1, 2):
        r = run("snap_through/snap_through", parameters__n=bars, parameters__rate="10000 N/s",
                simulation__duration=table["t"][-1], output__every=table["t"][1])
        # Step of 10 microseconds: 3e-7 m by order 2 from 7e-8 m at 4.9 microseconds.
        assert r["w"] == pytest.approx(table[f"n{bars}_full"], abs=4e-7)


def test_truss_of_bending_bars_gives_way_earlier(run):
    slow = run("snap_through_bending/snap_through_bending", parameters__n=4,
               simulation__duration="0.5 s")
    straight = run("snap_through/snap_through", simulation__duration="0.5 s")
    # At 500 N the truss of straight bars, which carries 592 N, has not yet collapsed.
    assert straight["w"].max() < 0.1 and slow["w"].max() > 0.3
    assert numpy.hypot(slow["bow.x"], slow["bow.y"]).max() > 0.01


@pytest.mark.parametrize("model", ["planar_levels/pendulum", "planar_levels/free_flight"])
def test_levels_of_coupling_differ_as_the_page_says(run, model):
    tips, errors = {}, {}
    for level in ["full", "first-order", "nocent", "nocor", "none"]:
        flight = run(model, bodies__beam__coupling=level)
        tips[level] = flight.vector("tip", "xy")
        errors[level] = flight.summary["energy_error"]
    off = {level: numpy.linalg.norm(tip - tips["full"], axis=1).max()
           for level, tip in tips.items()}
    # The ranking is independent of the step: first-order keeps all terms linear in the deformation.
    assert 1e-4 < off["first-order"] < 0.2 * off["nocent"]
    assert off["nocent"] < off["nocor"] < off["none"]
    # Levels derived from a kinetic energy conserve it up to the error of the step; the others do not.
    assert max(errors["full"], errors["first-order"], errors["none"]) < 1e-6
    assert min(errors["nocent"], errors["nocor"]) > 1e-3


def test_model_in_readme_runs(tmp_path):
    text = (SOURCE / "README.md").read_text()
    model = re.search(r"```yaml\n(.*?)```", text, re.DOTALL).group(1)
    assert len(model.splitlines()) <= 20
    (tmp_path / "strip.yaml").write_text(model)
    r = Run(tmp_path / "strip.yaml", tmp_path / "out")
    # Nearly a pendulum: the tip stays about one length from the pin and passes below it.
    distance = numpy.hypot(r["tip.x"], r["tip.y"])
    assert numpy.abs(distance - 1.0).max() < 0.02
    assert r["tip.y"].min() < -0.95
    assert r.summary["trust"] == "ok"


def test_tuning_fork_sounds_a():
    model = (EXAMPLES / "tuning_fork/tuning_fork").with_suffix(".yaml")
    for options in [[], ["--system"]]:
        done = subprocess.run([str(PROGRAM), "modes", str(model), "--json", *options],
                              capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        modes = json.loads(done.stdout)["analyses"][0]["modes"]
        assert min(abs(mode["frequency"] - 440) for mode in modes) < 0.1


def test_tube_changes_its_section_before_it_bends():
    model = (EXAMPLES / "tube_modes/tube_modes").with_suffix(".yaml")
    done = subprocess.run([str(PROGRAM), "modes", str(model), "--json", "--count", "8"],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    found = [mode["frequency"] for mode in json.loads(done.stdout)["analyses"][0]["modes"]]
    # A ring in plane strain vibrates as an oval with two lobes: f = sqrt(36/5 E I'/(rho A R^4))/(2 pi).
    h, radius = 4e-3, 58e-3
    ring = math.sqrt(7.2 * 210e9 / (7850 * 12 * (1 - 0.3**2))) * h / radius**2 / (2 * math.pi)
    assert found[0] == pytest.approx(ring, rel=0.015)  # 1.1 % with this mesh, 0.05 % with 48 around
    assert found[1] == pytest.approx(found[0], rel=1e-6)
    # Bending of the tube as a beam (1723 Hz by Timoshenko) comes seventh.
    assert found[6] == pytest.approx(1723, rel=0.01)


def test_every_example_has_a_page_and_a_test():
    tested = "".join(path.read_text() for path in pathlib.Path(__file__).parent.glob("test_*.py"))
    for folder in sorted(path for path in EXAMPLES.iterdir() if path.is_dir()):
        assert (folder / "README.md").exists(), folder
        for model in folder.glob("*.yaml"):
            assert f'"{folder.name}/{model.stem}"' in tested, model

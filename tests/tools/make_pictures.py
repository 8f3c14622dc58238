#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Regenerates all pictures of docs/pictures and of the examples: runs the models, writes their pages, takes screenshots.

    tests/tools/make_pictures.py [--program build/release/bin/buckens] [--out docs/pictures] [NAME...]

NAME: pictures by the beginning of their names; without one all of them (some minutes). Needs node, Chromium and the npm
packages of viewer/; the drawings and the Python example besides need python3-numpy, those of the snap-through python3-matplotlib.
"""

import argparse
import dataclasses
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CRANK = "examples/slider_crank/slider_crank.yaml"
LEVELS = "examples/planar_levels/pendulum.yaml"


@dataclasses.dataclass(frozen=True)
class Picture:
    """A page at one time in one view."""

    name: str
    runs: tuple = ()  # per run directory the arguments of `buckens`; two of them are shown side by side
    folders: tuple = ("out",)  # names of the run directories, which pages of two runs show
    time: float = 0.3  # share of the run
    view: tuple = ()  # arguments of viewer/scripts/screenshot.mjs
    size: tuple = (1280, 800)
    fixture: str = ""  # a synthetic page of viewer/tests/fixture.mjs in place of runs
    script: str = ""  # in Python, which gets a run directory, in place of runs
    cpp: str = ""  # program of examples/cpp, which gets a run directory, in place of runs


@dataclasses.dataclass(frozen=True)
class Drawing:
    """Curves that a script of an example draws."""

    names: tuple  # of the files
    script: tuple  # with PROGRAM and OUT for the program and the folder of the pictures


# Model, time and view of each picture.
PICTURES = (
    Picture("slider_crank", (("run", CRANK),), time=0.055),
    Picture("spring_leg", (("run", "examples/spring_leg/spring_leg.yaml"),), time=0.19375),
    Picture("gyro_rotor", (("run", "examples/gyro_rotor/gyro_rotor.yaml"),), time=0.36),
    Picture("plate_bdf", (("run", "examples/plate_bdf/plate_bdf.yaml"),), time=0.3),
    Picture("bracket_inp", (("run", "examples/bracket_inp/bracket_inp.yaml"),), time=0.9, view=("--scale", "500")),
    Picture("connecting_rod", (("run", "examples/connecting_rod/connecting_rod.yaml"),), time=0.94),
    Picture("tumbling_block", (("run", "examples/tumbling_block/tumbling_block.yaml"),), time=0.13,
            view=("--scale", "5")),
    Picture("rough_lid", (("run", "examples/rough_lid/rough_lid.yaml"),), time=0.65),
    Picture("crane_cable", (("run", "examples/crane_cable/crane_cable.yaml"),), time=0.4),
    Picture("gear_train", (("run", "examples/gear_train/gear_train.yaml"),), time=0.5),
    Picture("belt_drive", (("run", "examples/belt_drive/belt_drive.yaml"),), time=0.6),
    Picture("block_and_tackle", (("run", "examples/block_and_tackle/block_and_tackle.yaml"),), time=0.6),
    Picture("marble_bowl", (("run", "examples/marble_bowl/marble_bowl.yaml"),), time=0.35),
    Picture("balls_in_tray", (("run", "examples/balls_in_tray/balls_in_tray.yaml"),), time=0.97,
            view=("--press", "+") * 3),
    Picture("windscreen_wiper", (("run", "examples/windscreen_wiper/windscreen_wiper.yaml"),), time=0.4),
    Picture("cam_follower", (("run", "examples/cam_follower/cam_follower.yaml"),), time=0.4),
    Picture("robot_arm", (("run", "examples/robot_arm/robot_arm.yaml"),), time=0.3),
    Picture("trolley_on_flexible_rail", (("run", "examples/trolley_on_flexible_rail/trolley_on_flexible_rail.yaml"),),
            time=0.6, view=("--scale", "400")),
    Picture("clearance_slider_crank", (("run", "examples/clearance_slider_crank/clearance_slider_crank.yaml"),), time=0.2),
    Picture("bouncing_dumbbell", (("run", "examples/bouncing_dumbbell/bouncing_dumbbell.yaml"),), time=0.3),
    Picture("wheel", (("run", "examples/wheel/wheel.yaml"),), time=0.15),
    Picture("tube_modes", (("modes", "examples/tube_modes/tube_modes.yaml", "--count", "8"),), time=0.25),
    Picture("double_pendulum", (("run", "examples/double_pendulum/double_pendulum.yaml"),), time=0.3),
    Picture("flexible_pendulum", (("run", "examples/flexible_pendulum/flexible_pendulum.yaml"),), time=0.3),
    Picture("method_comparison", (("run", "examples/method_comparison/method_comparison.yaml"),), time=0.3),
    Picture("pressurised_piston", (("run", "examples/pressurised_piston/pressurised_piston.yaml"),), time=0.3),
    Picture("spinning_body", (("run", "examples/spinning_body/spinning_body.yaml"),), time=0.3),
    Picture("block_pendulum", (("run", "examples/block_pendulum/block_pendulum.yaml"),), time=0.3),
    Picture("pendulum", (("run", "examples/pendulum/pendulum.yaml"),), time=0.2),
    Picture("door", (("run", "examples/door/door.yaml"),), time=0.12),
    Picture("two_link_arm", (("run", "examples/two_link_arm/two_link_arm.yaml"),), time=0.55, view=("--press", "+") * 2),
    Picture("rotating_beam", (("run", "examples/rotating_beam/rotating_beam.yaml"),), time=0.04, view=("--scale", "50")),
    Picture("large_bend", (("run", "examples/large_bend/large_bend.yaml"),), time=0.3),
    Picture("planar_levels", (("run", LEVELS), ("run", LEVELS, "--set", "bodies.beam.coupling=none")),
            folders=("full", "none"), time=0.48),
    # A quarter of the period of the third mode, of twice the frequency of the first that the page begins with.
    Picture("tuning_fork", (("modes", "examples/tuning_fork/tuning_fork.yaml", "--system", "--count", "6"),), time=0.125,
            view=("--click", "text=system 3")),
    Picture("snap_through", (("run", "examples/snap_through/snap_through.yaml", "--set", "parameters.rate=5000 N/s",
                              "--set", "parameters.n=2"),), time=0.72),
    Picture("snap_through_bending", (("static", "examples/snap_through_bending/snap_through_bending.yaml"),), time=0.1),
    Picture("python", script="examples/python/flexible_arm.py", time=0.1, view=("--scale", "15")),
    Picture("cpp", cpp="pendulum", time=0.35),
    Picture("page_side_by_side", (("run", CRANK), ("run", CRANK, "--set", "bodies.rod.beam.elements=4")),
            folders=("fine", "coarse"), time=0.055),
    Picture("page_dark", fixture="large", time=0.22,
            view=("--dark", "--press", "x", "--follow", "5000", "--follow", "6510")),
    Picture("page_many", fixture="long-chain", time=0.1),
)
DRAWINGS = (
    Drawing(("docs/pictures/method_comparison.svg",),
            ("examples/method_comparison/compare.py", "PROGRAM", "--out", "OUT")),
    Drawing(("docs/pictures/planar_levels_pendulum.svg", "docs/pictures/planar_levels_free_flight.svg"),
            ("examples/planar_levels/figures.py", "PROGRAM", "OUT")),
    Drawing(tuple(f"examples/snap_through/{name}.svg" for name in ("displacement_over_load", "coupling", "single_terms")),
            ("examples/snap_through/figures.py", "--program", "PROGRAM")),
    Drawing(("examples/snap_through_bending/displacement_over_load.svg",),
            ("examples/snap_through_bending/figures.py", "--program", "PROGRAM")),
    # Of figures that were measured; nothing is measured again.
    Drawing(tuple(f"docs/pictures/cost_{name}.svg" for name in ("variables", "frames", "sharing")),
            ("bench/draw_costs.py", "OUT")),
    Drawing(("docs/pictures/large_cubes.png",), ("bench/large_bodies.py", "--draw", "OUT")),
)


def call(*arguments, **environment):
    subprocess.run([str(argument) for argument in arguments], cwd=ROOT, check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, **environment})


def compiled(name, build, folder):
    """A program of examples/cpp, built against what is installed from a build directory."""
    call("cmake", "--install", build, "--prefix", folder / "prefix")
    call("cmake", "-S", "examples/cpp", "-B", folder / "cpp", f"-DCMAKE_PREFIX_PATH={folder / 'prefix'}",
         "-DCMAKE_BUILD_TYPE=Release")
    call("cmake", "--build", folder / "cpp", "--target", name)
    return folder / "cpp" / name


def page_of(picture, program, folder):
    """Writes the page for a picture."""
    page = folder / "page.html"
    if picture.fixture:
        call("node", "viewer/tests/fixture.mjs", page, picture.fixture)
        return page
    directories = []
    if picture.script:
        directories.append(folder / "out")
        module = program.parents[1] / "python"
        call(sys.executable, picture.script, directories[-1], PYTHONPATH=str(module), BUCKENS_PROGRAM=str(program))
    if picture.cpp:
        directories.append(folder / "out")
        call(compiled(picture.cpp, program.parents[1], folder), directories[-1])
    for name, (verb, model, *options) in zip(picture.folders if picture.runs else (), picture.runs, strict=True):
        directories.append(folder / name)
        call(program, verb, model, *options, "-o", directories[-1])
    call(program, "view", *directories, "-o", page)
    return page


def photograph(picture, program, out):
    with tempfile.TemporaryDirectory() as folder:
        page = page_of(picture, program, pathlib.Path(folder))
        width, height = picture.size
        call("node", "viewer/scripts/screenshot.mjs", page, out / f"{picture.name}.png", "--time", picture.time,
             "--width", width, "--height", height, *picture.view)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/bin/buckens")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs/pictures")
    arguments = parser.parse_args()
    program, out = arguments.program.resolve(), arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)

    def wanted(name):
        return not arguments.names or any(name.startswith(prefix) for prefix in arguments.names)

    for picture in filter(lambda picture: wanted(picture.name), PICTURES):
        print(picture.name, flush=True)
        photograph(picture, program, out)
    for drawing in DRAWINGS:
        if any(wanted(pathlib.Path(name).stem) for name in drawing.names):
            print(*drawing.names, flush=True)
            values = {"PROGRAM": program, "OUT": out}
            call(sys.executable, *(values.get(word, word) for word in drawing.script))


if __name__ == "__main__":
    main()

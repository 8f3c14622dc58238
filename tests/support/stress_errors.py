# SPDX-License-Identifier: Apache-2.0
"""Errors of recorded stresses against exact solutions: runs of the models in verification/stresses, for
tests/test_stresses.py and docs/figures/stresses.py."""

import pathlib

import h5py
import numpy

CASES = pathlib.Path(__file__).resolve().parents[2] / "verification" / "stresses"
RHO, G, NU = 7850.0, 9.81, 0.3
BODIES = {"spinning_bar": ("bar", "box"), "disc": ("disc", "disc"), "cantilever": ("bar", "box")}


def arguments(case, divisions, element, out):
    """Of a run of the program."""
    body, shape = BODIES[case]
    path = f"bodies.{body}.mesh.{shape}"
    return ["run", str(CASES / f"{case}.yaml"), "-o", str(out), "-q", "--set", f"{path}.divisions={divisions}",
            "--set", f"{path}.element={element}"]


def recorded(case, directory):
    """Undeformed places and stresses of the last record, at nodes and at centres."""
    body, _ = BODIES[case]
    with h5py.File(pathlib.Path(directory) / "results.h5", "r", swmr=True) as file:
        geometry = file[f"geometry/bodies/{body}"]
        nodes = geometry["nodes"][:]
        kinds = geometry["cell_kinds"].attrs["kinds"][geometry["cell_kinds"][0]]
        corners = {"hex8": 8, "hex20": 8, "tet10": 4}[kinds]
        cells = geometry["cell_nodes"][:].reshape(len(geometry["cell_kinds"]), -1)[:, :corners]
        fields = file[f"fields/bodies/{body}"]
        return ((nodes[geometry["field_nodes"][:]], fields["nodes/stress"][-1]),
                (nodes[cells].mean(1), fields["elements/stress"][-1]))


def bar_error(places, stress):
    """Largest error of all components relative to the largest stress of a bar of 1 m x 0.1 m at 10 rad/s."""
    exact = numpy.zeros_like(stress)
    exact[:, 0] = RHO * 100 * (0.25 - places[:, 0]**2) / 2
    exact[:, 1] = RHO * 100 * (0.0025 - places[:, 1]**2) / 2
    return numpy.abs(stress - exact).max() / (RHO * 100 / 8)


def disc_error(places, stress):
    """Largest error of radial and hoop stress relative to the largest hoop stress."""
    a, b, w = 0.05, 0.2, 100.0
    x, y = places[:, 0], places[:, 1]
    r = numpy.hypot(x, y)
    c, s = x / r, y / r
    radial = stress[:, 0] * c * c + stress[:, 1] * s * s + 2 * stress[:, 3] * c * s
    hoop = stress[:, 0] * s * s + stress[:, 1] * c * c - 2 * stress[:, 3] * c * s
    factor = (3 + NU) / 8 * RHO * w * w
    exact_radial = factor * (a * a + b * b - a * a * b * b / r**2 - r**2)
    exact_hoop = factor * (a * a + b * b + a * a * b * b / r**2 - (1 + 3 * NU) / (3 + NU) * r**2)
    largest = factor * (2 * b * b + a * a - (1 + 3 * NU) / (3 + NU) * a * a)
    return max(numpy.abs(radial - exact_radial).max(), numpy.abs(hoop - exact_hoop).max()) / largest


def cantilever_error(places, stress):
    """Largest error of the stress along the bar well away from its ends, relative to its largest there. What the clamp and
    the free end disturb has fallen to 5e-5: exp(-2.1 distance/c), 5 and 3 half heights away."""
    c, length = 0.1, 1.0
    x, y = places[:, 0] + length / 2, places[:, 1]
    exact = RHO * G * ((length - x)**2 * 3 * y / (2 * c * c) + 0.6 * y - y**3 / c**2)
    inside = (x > 0.5 - 1e-9) & (x < 0.65 + 1e-9)
    return numpy.abs(stress[inside, 0] - exact[inside]).max() / numpy.abs(exact[inside]).max()


ERRORS = {"spinning_bar": bar_error, "disc": disc_error, "cantilever": cantilever_error}


def errors(case, directory):
    """Largest relative errors of a run at nodes and at centres."""
    return tuple(float(ERRORS[case](*place)) for place in recorded(case, directory))

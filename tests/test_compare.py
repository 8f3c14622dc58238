# SPDX-License-Identifier: Apache-2.0
"""`buckens compare`: how far two runs differ."""

import pathlib

import pytest

EXAMPLES = pathlib.Path(__file__).parents[1] / "examples"
PENDULUM = EXAMPLES / "pendulum" / "pendulum.yaml"
CRANK = EXAMPLES / "slider_crank" / "slider_crank.yaml"


@pytest.fixture
def crank(buckens):
    def call(out, *changes):
        settings = [part for change in ("simulation.duration=5 ms", *changes)
                    for part in ("--set", change)]
        buckens("run", CRANK, "-o", out, "-q", *settings).must(0)
        return out

    return call


def test_a_run_equals_itself(crank, buckens):
    crank("a")
    found = buckens("compare", "a", "a", "--tolerance", "1e-15", "--json").must(0).json
    assert found["kind"] == "motion" and found["common_records"] == 21
    assert found["largest_relative_difference"] == 0 and found["within_tolerance"] is True
    assert found["only_in_first"] == found["only_in_second"] == found["of_other_shape"] == []


def test_differences_are_found_and_ordered(crank, buckens):
    crank("a")
    crank("b", "bodies.rod.coupling=none")
    found = buckens("compare", "a", "b", "--json").must(0).json
    relative = [q["relative"] for q in found["quantities"]]
    assert relative == sorted(relative, reverse=True) and 0 < relative[0]
    mid = next(q for q in found["quantities"] if q["quantity"] == "sensors/mid")
    assert mid["difference"] == pytest.approx(mid["relative"] * mid["largest"])
    assert 0 < mid["at"] <= 5e-3 and 1e-6 < mid["relative"] < 1e-2
    text = buckens("compare", "a", "b", "--sensors", "--tolerance", "1e-9").must(6).out
    assert "sensors/mid" in text and "beyond the tolerance" in text and "bodies/rod" not in text


def test_other_steps_meet_at_common_records(crank, buckens):
    crank("a")
    crank("b", "simulation.step=0.1 ms", "output.every=0.5 ms")
    found = buckens("compare", "a", "b", "--json").must(0).json
    assert found["common_records"] == 11 and found["last_time"] == pytest.approx(5e-3)


def test_other_meshes_are_named(crank, buckens):
    crank("a")
    crank("b", "bodies.rod.beam.elements=8")
    found = buckens("compare", "a", "b", "--json").must(0).json
    assert "bodies/rod/displacement" in found["of_other_shape"]
    assert any(q["quantity"] == "sensors/mid" for q in found["quantities"])


def test_frequencies_of_modes_are_compared(buckens):
    for out, elements in (("a", 16), ("b", 8)):
        buckens("modes", CRANK, "--count", "3", "-o", out,
                "--set", f"bodies.rod.beam.elements={elements}").must(0)
    found = buckens("compare", "a", "b", "--json").must(0).json
    assert found["kind"] == "vibrations"
    frequency = next(q for q in found["quantities"] if q["quantity"] == "modes/frequency")
    assert 0 < frequency["relative"] < 1e-2, "the third mode with 8 elements"
    assert not any("displacement" in q["quantity"] for q in found["quantities"])


def test_what_cannot_be_compared_is_refused(crank, buckens):
    crank("a")
    crank("other", "output.sensors={}")
    buckens("compare", "a", "other", "--sensors", "--tolerance", "1").must(2, "no sensor", "--sensors")
    buckens("modes", CRANK, "--count", "3", "-o", "m").must(0)
    buckens("compare", "a", "m").must(2, "vibrations", "motion")
    buckens("compare", "a", "nothing").must(5, "nothing")
    buckens("compare", "a", "a", "--tolerance", "-1").must(2, "tolerance")

# SPDX-License-Identifier: Apache-2.0
"""Every model of the examples, every command of their pages and of README.md: silent, or with the one warning that is listed
here with its reason."""

import json
import re
import shlex

import pytest

from conftest import SOURCE

PAGES = [SOURCE / "README.md", *sorted((SOURCE / "docs" / "tutorials").glob("*.md")),
         *sorted((SOURCE / "examples").glob("*/README.md"))]
COMMAND = re.compile(r"^ *(?:build/release/bin/)?buckens ((?:run|static|check|modes) (?:\\\n|[^\n#])*)", re.MULTILINE)

# Permitted warnings and reasons not to trust a run: words of them, and why the example is as it is.
BUCKLING = "of its buckling load"
ONE_FRAME = ([], [BUCKLING])  # the paper's case has one frame; its page says that 22 % are wrong
WORRIES = {
    "examples/slider_crank/slider_crank.yaml": ONE_FRAME,
    # The error statement finds the error due to one frame and doubts the force across the guide.
    "examples/slider_crank/slider_crank.yaml --error": ([], [BUCKLING, "halving the step changes the curves", "error statement gives"]),
    "examples/slider_crank/slider_crank_3d.yaml": ONE_FRAME,
    "examples/method_comparison/method_comparison.yaml": ONE_FRAME,
    "examples/connecting_rod/beam.yaml": ONE_FRAME,  # as the rod of solids beside it
    # One frame is compared with eight to show the effect of tension.
    "examples/rotating_beam/rotating_beam.yaml --set bodies.beam.frames=1": (["of its lowest elastic frequency"], [BUCKLING]),
    # One element in one frame, soft enough that the levels of coupling differ.
    "examples/planar_levels/free_flight.yaml": (["is a modulus of"], [BUCKLING]),
    "examples/planar_levels/pendulum.yaml": (["of its lowest elastic frequency", "is strained by", "is a modulus of"],
                                             ["bends by up to", BUCKLING]),
    "examples/planar_levels/pendulum.yaml --set bodies.beam.coupling={drop": (
        ["of its lowest elastic frequency", "is a modulus of"], ["bends by up to", BUCKLING]),
    # A truss that is pushed through quickly is compressed by 5 %.
    "examples/snap_through/snap_through.yaml --set parameters.rate=5000 N/s": (["is strained by"] * 2, []),
    # Bars that buckle, with one frame per element: eight elements are not many.
    "examples/snap_through_bending/snap_through_bending.yaml": (["is strained by"] * 2, ["bends by up to", BUCKLING] * 2),
}


def documented():
    """The commands of all pages that name a model of this repository, without their output directory, each once."""
    found = []
    for page in PAGES:
        for match in COMMAND.finditer(page.read_text()):
            words = shlex.split(match[1].replace("\\\n", " "))
            if "-o" in words:
                del words[words.index("-o"):words.index("-o") + 2]
            is_readme = page == SOURCE / "README.md" and words[1] == "rod.yaml"
            if is_readme or (SOURCE / words[1]).is_file():
                found.append(tuple(words))
    for path in sorted((SOURCE / "examples").glob("*/*.yaml")):
        verb = "run" if "\nsimulation:" in path.read_text() else "check"
        found.append((verb, str(path.relative_to(SOURCE))))
    return sorted(set(found))


def worries(words):
    key = " ".join(words[1:])
    return next((WORRIES[known] for known in sorted(WORRIES, key=len, reverse=True) if key.startswith(known)), ([], []))


def test_the_pages_are_read():
    commands = documented()
    assert ("run", "rod.yaml") in commands and ("check", "rod.yaml") in commands
    assert ("run", "examples/rotating_beam/rotating_beam.yaml", "--set", "bodies.beam.frames=1") in commands
    assert len(commands) > 40
    for known in WORRIES:
        assert any(" ".join(words[1:]).startswith(known) for words in commands), known


@pytest.mark.parametrize("words", documented(), ids=" ".join)
def test_a_documented_command_is_silent_or_warns_with_reason(buckens, tmp_path, words):
    verb, model, *rest = words
    if model == "rod.yaml":
        text = re.search(r"```yaml\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)[1]
        (tmp_path / model).write_text(text)
        model = tmp_path / model
    out = [] if verb == "check" else ["-o", tmp_path / "out"]
    quiet = {"run": ["-q"], "static": ["-q"], "check": ["--json"], "modes": []}[verb]
    result = buckens(verb, model, *rest, *out, *quiet, cwd=SOURCE).must(0)
    said = [line for line in result.err.splitlines() if "warning: " in line]
    if verb in ("run", "static"):
        assert result.err.splitlines() == said, "a quiet command says warnings and errors only"
        assert len(said) == len(set(said)), "nothing is said twice"
        warnings, doubts = worries(words) if verb == "run" else ([], [])
        summary = json.loads((tmp_path / "out" / "summary.json").read_text())
        trust = [] if summary["trust"] == "ok" else summary["trust"]
        assert sorted(said) == sorted(f"buckens: warning: {text}" for text in summary["warnings"] + trust)
        for texts, expected in ((summary["warnings"], warnings), (trust, doubts)):
            assert len(texts) == len(expected), texts
            for known in expected:
                matching = next((text for text in texts if known in text), None)
                assert matching, (known, texts)
                texts = [text for text in texts if text is not matching]
    else:
        assert said == []
        if verb == "check":
            assert result.json["warnings"] == []

# SPDX-License-Identifier: Apache-2.0
"""Commands of the program on pages are executed, and the output that a page shows is the program's.

Here: the commands of `buckens` on all pages, in their order, with the files that a page speaks of. Runs take a few steps; what they
show at the end is compared in test_examples.py, test_example_pages.py and test_example_warnings.py. Programs on pages are executed by
test_result_docs.py, test_python_results.py and tests/install. ELSEWHERE names who executes the commands of other programs, NOT_EXECUTED
those that nobody does.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import textwrap

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "support"))
from conftest import PROGRAM, SOURCE  # noqa: E402
from doc_blocks import blocks_of, commands_of  # noqa: E402

# Who executes it, and the words by which: they stand in that file.
ELSEWHERE = {
    "cmake --preset release": ("tools/setup.sh", "cmake --preset release"),
    "ctest --preset release": ("test.sh", "ctest --preset release"),
    "cmake -S examples/cpp": ("tests/install/run.cmake", '-S "${examples}"'),
    "cmake --build build-cpp": ("tests/install/run.cmake", '--build "${work}/examples"'),
    "build-cpp/pendulum": ("tests/install/run.cmake", 'run("${work}/examples/pendulum"'),
    "export PYTHONPATH": ("tests/test_python_examples.py", '"PYTHONPATH": '),
    "python3 examples/python/flexible_arm.py": ("tests/test_python_package.py", "call(PYTHON, script"),
    "python3 examples/python/rod_taper.py": ("tests/test_python_examples.py", 'run("rod_taper.py"'),
    "python3 examples/python/parameter_study.py": ("tests/test_python_examples.py", 'run("parameter_study.py"'),
    "python3 examples/python/tolerances.py": ("tests/test_python_examples.py", 'run("tolerances.py"'),
    "python3 examples/method_comparison/compare.py": ("tests/test_method_comparison.py", '"--short"'),
    "python3 bench/run.py --list": ("tests/test_bench.py", '"bench/run.py", "--list"'),
    "/usr/bin/python3 -m pytest": ("cmake/BuckensTests.cmake", "-m pytest"),
    "tests/fuzz/run_fuzzer.py": ("cmake/BuckensFuzz.cmake", "tests/fuzz/run_fuzzer.py"),
    "npm run build": ("cmake/build_viewer.cmake", "run --silent build"),
    "npm test": ("cmake/BuckensViewer.cmake", "ITEMS test test:page"),
    "npm run test:page": ("cmake/BuckensViewer.cmake", "ITEMS test test:page"),
    "./docs.sh": ("tests/test_docs_site.py", 'SOURCE / "docs.sh"'),
    "tools/census.py": ("tests/test_census.py", '"census.py"'),
}
# What no test executes, and why.
NOT_EXECUTED = {
    "./test.sh": "calls this test; .github/workflows/test.yaml calls it, where that runs",
    "./demo.sh": "installs packages and builds; tools/test/test_setup.sh tests how it decides what to install",
    "./packages.sh": "builds everything anew; tests/test_packages.py has cpack make the packages of this build",
    "cmake --preset dev": "builds everything a second time; that there are such presets is tested here",
    "cmake --build --preset dev": "the same",
    "python3 examples/planar_levels/figures.py": "minutes, and it replaces pictures; tests/test_pictures.py tests that it is there",
    "python3 bench/": "minutes to half an hour, and times on a busy machine say nothing; tests/test_bench.py tests names and tables",
    "tests/tools/make_pictures.py": "minutes, and it replaces pictures; tests/test_pictures.py tests its table",
    "node viewer/scripts/screenshot.mjs": "tests/tools/make_pictures.py calls it, which no test does",
    "npm run fixture": "writes a page to look at; viewer/tests make theirs by the same function",
}

PAGES = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "docs").rglob("*.md")),
         *sorted((SOURCE / "examples").glob("*/README.md")), *sorted((SOURCE / "bench").glob("*.md"))]
BLOCKS = [block for page in PAGES
          for block in blocks_of(str(page.relative_to(SOURCE)), page.read_text())]

README_MODEL = re.search(r"```yaml\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)[1]

# Files that a page speaks of without being about them: name on the page, file of the repository or text.
CRANK = "examples/slider_crank/slider_crank.yaml"
VARIANTS = """name,parameters.speed,bodies.rod.beam.elements,gravity
slow,100 rad/s,16,"[0, -9.81 m/s^2, 0]"
fast,150 rad/s,32,"[0, 0, 0]"
"""
FILES = {
    "README.md": {"rod.yaml": README_MODEL},
    "docs/reference/command-line.md": {"crank.yaml": CRANK},
    "docs/reference/saved-state.md": {"slider_crank.yaml": CRANK},
    "docs/tutorials/continue.md": {"slider_crank.yaml": CRANK},
    "docs/tutorials/frames.md": {"model.yaml": README_MODEL},
    "docs/tutorials/free-vibration.md": {"tuning_fork.yaml": "examples/tuning_fork/tuning_fork.yaml"},
    "docs/tutorials/meshes.md": {"part.msh": "", "housing.inp": "examples/bracket_inp/bracket.inp",
                                 "rod.step": "examples/connecting_rod/rod.step"},
    "docs/tutorials/results.md": {"rod.yaml": README_MODEL},
    "docs/tutorials/studies.md": {"slider_crank.yaml": CRANK, "variants.csv": VARIANTS},
    "docs/tutorials/sweeps.md": {"slider_crank.yaml": CRANK, "variants.csv": VARIANTS},
    "docs/tutorials/viewer.md": {"MODEL.yaml": CRANK},
}
# What was done before, on pages that take it for granted.
BEFORE = {
    "docs/tutorials/meshes.md": ["convert housing.inp part.msh --length-unit mm"],
    "docs/tutorials/results.md": ["run rod.yaml -o out", "run rod.yaml -o coarse --set bodies.rod.beam.elements=4",
                                  "run rod.yaml -o fine"],
    "docs/tutorials/viewer.md": ["run MODEL.yaml -o OUT1", "run MODEL.yaml -o OUT2"],
}
# Words that stand for others.
MEANT = {"docs/tutorials/README.md": {"NAME": "pendulum"}, "docs/reference/saved-state.md": {"0.05": "1e-3"}}
STEPS = 40


def is_grammar(block):
    """The list of verbs at the head of the reference: words in capitals and brackets, no command."""
    return "[-o OUT]" in block.text


def shortened(words, folder):
    """`run` and `sweep` with a few steps."""
    if words[0] not in ("run", "sweep") or "--error" in words:
        return words
    if words[1] == "--merge":
        return words
    if words[1] == "--continue":  # what has ended can go on only further
        return words if "--until" in words else [*words, "--until", "0.01"]
    text = (folder / words[1]).read_text()
    units = {"s": 1, "ms": 1e-3, "us": 1e-6}
    given = {key: re.search(rf"\b{key}: *([\d.e-]+) *(s|ms|us)\b", text) for key in ("duration", "step", "every")}
    if given["duration"] is None or given["step"] is None:
        return words
    seconds = {key: float(match[1]) * units[match[2]] for key, match in given.items() if match}
    length = min(max(STEPS * seconds["step"], seconds.get("every", 0)), seconds["duration"])
    return [*words, "--set", f"simulation.duration={length:.12g} s"]


def numbers_agree(shown, printed, tolerance):
    """Rounding errors are any small numbers."""
    return shown == printed or max(abs(shown), abs(printed)) < 1e-8 or abs(shown - printed) <= tolerance * abs(shown)


def agrees(shown, printed):
    """Whether two lines say the same, up to the mark of omission and without times of computing."""
    shown, printed = (re.sub(r"\bin [\d.e-]+ s\b.*", "", line) for line in (shown, printed))
    is_cut = "…" in shown
    words = [re.sub(r"[,;:()]", "", line.split("…")[0]).split() for line in (shown, printed)]
    if len(words[0]) > len(words[1]) or not is_cut and len(words[0]) != len(words[1]):
        return False
    for place, (one, other) in enumerate(zip(*words)):
        # 1e-5 is less than a digit of what is shown. In the list of vibrations, which have shares in %, the mass stands for a
        # largest displacement of 1; of two with the same frequency it depends on rounding which ones are shown. An oval
        # section with nodes every 5.6 degrees misses its largest displacement by up to 1 - cos(5.6 degrees): 1 % of mass.
        tolerance = 1e-2 if "%" in shown and place > 1 else 1e-5
        try:
            if not numbers_agree(float(one), float(other), tolerance):
                return False
        except ValueError:
            if one != other:
                return False
    return True


def commands(page):
    """The blocks of a page that hold commands."""
    for block in BLOCKS:
        if block.page == page and not block.language and not block.reason and not is_grammar(block):
            yield block, list(commands_of(block))


WITH_COMMANDS = [page for page in dict.fromkeys(block.page for block in BLOCKS)
                 if any(found for _, found in commands(page))]


@pytest.mark.parametrize("page", WITH_COMMANDS)
def test_commands_of_a_page(page, tmp_path):
    (tmp_path / "examples").symlink_to(SOURCE / "examples")
    for name, content in FILES.get(page, {}).items():
        if "\n" in content:
            (tmp_path / name).write_text(content)
        elif content:
            shutil.copy(SOURCE / content, tmp_path / name)

    def call(words, is_whole=False):
        words = [MEANT.get(page, {}).get(word, word) for word in words]
        for name, meant in MEANT.get(page, {}).items():
            words = [word.replace(name, meant) for word in words]
        if not is_whole:
            words = shortened(words, tmp_path)
        done = subprocess.run([PROGRAM, *words], cwd=tmp_path, capture_output=True, text=True,
                              timeout=300)
        assert done.returncode == 0, f"{' '.join(words)}\n{done.stderr}"
        return done.stdout

    for line in BEFORE.get(page, []):
        call(line.split(), is_whole=True)
    printed = []
    for block, found in commands(page):
        if found:
            printed += [line for words in found for line in call(words[1:]).splitlines()]
        # Results of whole runs are compared in test_example_pages.py; what a page tells to put into a file is no output.
        elif printed and "steps to t =" not in block.text and block.text not in FILES.get(page, {}).values() and \
                not block.text.startswith((*ELSEWHERE, *NOT_EXECUTED)):
            for line in block.text.splitlines():
                assert any(agrees(line, other) for other in printed), f"{block.name}: not printed: {line}"


OTHER_PROGRAM = re.compile(r"(\./\w|cmake|ctest|pip |apt|export|python3|/usr/bin/python3|tests/|tools/|build-|node |npm )")


def test_commands_of_other_programs_are_executed_elsewhere_or_said_not_to_be():
    used = set()
    for block in BLOCKS:
        if block.language or block.reason or is_grammar(block):
            continue
        for line in re.sub(r"\\\n\s*", "", block.text).splitlines():
            if OTHER_PROGRAM.match(line):
                known = [start for start in (*ELSEWHERE, *NOT_EXECUTED) if line.startswith(start)]
                assert known, f"{block.name}: nobody executes {line!r}; name who does in ELSEWHERE, or say why not in " \
                              "NOT_EXECUTED or before the block: <!-- not run: REASON -->"
                used.add(max(known, key=len))
    assert used == {*ELSEWHERE, *NOT_EXECUTED}, "no page has the others"
    for command, (place, words) in ELSEWHERE.items():
        assert words in (SOURCE / place).read_text(), f"{place} does not execute {command}: it has no {words!r}"


def test_presets_and_scripts_on_pages_exist():
    """Of commands that are not executed."""
    presets = json.loads((SOURCE / "CMakePresets.json").read_text())
    names = {preset["name"] for preset in presets["configurePresets"]} & {preset["name"] for preset in presets["buildPresets"]}
    scripts = set(json.loads((SOURCE / "viewer" / "package.json").read_text())["scripts"])
    lines = [line for block in BLOCKS if not block.language for line in block.text.splitlines() if OTHER_PROGRAM.match(line)]
    found = [word for line in lines for word in re.findall(r"--preset (\w+)", line)]
    assert set(found) <= names and "dev" in found
    assert {word for line in lines for word in re.findall(r"^npm run ([\w:]+)", line)} <= scripts
    for line in lines:
        for path in re.findall(r"(?<![\w/])(?:\./)?((?:bench|examples|tests|tools|viewer)/[\w/]+\.(?:py|mjs|sh))", line):
            assert (SOURCE / path).exists(), line


def test_languages_of_blocks():
    """A new kind of block needs somebody who executes it."""
    assert {block.language for block in BLOCKS} <= {"", "yaml", "python", "cpp", "json", "{toctree}", "{eval-rst}"}
    assert len(WITH_COMMANDS) > 35


def loaded(text):
    """A fragment of a model file; unlike PyYAML by itself, with `on` and `off` as texts."""
    yaml = pytest.importorskip("yaml")

    class Loader(yaml.SafeLoader):
        pass

    Loader.yaml_implicit_resolvers = {key: [entry for entry in entries if not entry[0].endswith(":bool")]
                                      for key, entries in yaml.SafeLoader.yaml_implicit_resolvers.items()}
    Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("^(true|false)$"), list("tf"))
    return yaml.load(textwrap.dedent(text), Loader)


def in_a_model(fragment):
    """A fragment at its place in a model."""
    if "mesh" in fragment:
        return {"bodies": {"part": fragment}}
    if "fields" in fragment:
        return {"output": fragment}
    if not set(fragment) <= set(SCHEMA["properties"]):
        return {"output": {"sensors": fragment}}
    return fragment


SCHEMA = json.loads((SOURCE / "schema" / "model.schema.json").read_text())
FRAGMENTS = [block for block in BLOCKS if block.language == "yaml"]


@pytest.mark.parametrize("block", FRAGMENTS, ids=lambda block: block.name)
def test_fragments_of_models_are_right(block):
    """Their keys and kinds of values, by the schema; whole models among them are run."""
    jsonschema = pytest.importorskip("jsonschema")
    parts = {key: value for key, value in SCHEMA.items() if key != "required"}
    errors = list(jsonschema.Draft202012Validator(parts).iter_errors(in_a_model(loaded(block.text))))
    assert not errors, f"{block.name}: {list(errors[0].path)}: {errors[0].message}"


def test_wrong_fragments_are_found():
    jsonschema = pytest.importorskip("jsonschema")
    parts = {key: value for key, value in SCHEMA.items() if key != "required"}
    for text in ("loads: {push: {force: {on: rod/end, valu: [0, 0, 1 N]}}}", "mesh: {fil: rod.inp}", "tip: {positio: rod/end}"):
        assert not jsonschema.Draft202012Validator(parts).is_valid(in_a_model(loaded(text))), text
    assert len(FRAGMENTS) > 15


def test_the_page_of_a_short_model_runs(tmp_path):
    """docs/reference/model-file.md begins with a whole model."""
    (block,) = [block for block in FRAGMENTS if block.page == "docs/reference/model-file.md"]
    (tmp_path / "model.yaml").write_text(block.text)
    done = subprocess.run([PROGRAM, "run", "model.yaml", "-o", "out", "--quiet"], cwd=tmp_path, capture_output=True, text=True,
                          timeout=300)
    assert (done.returncode, done.stderr) == (0, "")

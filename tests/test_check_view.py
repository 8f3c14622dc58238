# SPDX-License-Identifier: Apache-2.0
"""`buckens check --view`: a page with the assembled model, before any run."""

import json
import re

from test_save_state import LAWS, model


def data_of(page):
    return json.loads(re.search(r"window\.BUCKENS_DATA = (.*?);</script>", page.read_text(), re.DOTALL)[1])["runs"][0]


def test_the_page_shows_the_assembled_model(buckens, tmp_path):
    (tmp_path / "crank.yaml").write_text(model(LAWS).replace("loads:\n", "loads:\n  push: {force: {on: rod/mid, value: [0, 5 N, 0]}}\n", 1))
    result = buckens("check", "crank.yaml", "--view").must(0)
    assert "crank.html shows it" in result.out and "mass" in result.out
    run = data_of(tmp_path / "crank.html")
    assert run["time"]["n"] == 1
    assert [body["name"] for body in run["bodies"]] == ["crank", "rod", "slider"]
    assert {marker["name"] for marker in run["bodies"][0]["markers"]} >= {"shaft", "pin"}
    assert {joint["name"] for joint in run["joints"]} >= {"shaft", "motor", "big_end", "small_end", "guide"}
    assert {"leg", "push"} <= {entry["name"] for entry in run["loads"] + run["joints"]}
    assert "no step was taken" in run["summary"]["interrupted"]
    # Nothing else is left behind.
    assert sorted(path.name for path in tmp_path.iterdir()) == ["crank.html", "crank.yaml"]


def test_models_without_a_simulation(buckens, tmp_path):
    text = re.sub(r"simulation: .*\n", "", model(LAWS))
    (tmp_path / "crank.yaml").write_text(text.split("output:")[0])
    buckens("check", "crank.yaml", "-o", "page.html", "--json").must(0)
    assert data_of(tmp_path / "page.html")["time"]["n"] == 1
    assert not (tmp_path / "crank.html").exists()


def test_a_model_that_does_not_close_gives_no_page(buckens, models, tmp_path):
    buckens("check", models / "gap.yaml", "--view").must(3)
    assert list(tmp_path.iterdir()) == []

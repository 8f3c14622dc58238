# SPDX-License-Identifier: Apache-2.0
"""`buckens sweep --shard` and `--merge`: a sweep in parts, as job arrays run it, is the sweep."""

import csv
import json
import os
import signal
import time

import pytest

RANGES = ("--vary", "gravity.1=[-9.81 m/s^2, -1.62 m/s^2, 0]", "--vary", "simulation.duration=[10 ms, 20 ms]")


def test_parts_make_the_table_of_the_whole(buckens, models, tmp_path):
    model = models / "pendulum.yaml"
    buckens("sweep", model, *RANGES, "-o", "whole", "-q").must(0)
    for shard in ("3/4", "1/4", "4/4", "2/4"):
        told = buckens("sweep", model, *RANGES, "-o", "parts", "--shard", shard, "--json").must(0)
        assert len(told.json["variants"]) in (1, 2)
        assert told.json["table"].endswith(f".parts/{shard.replace('/', '-of-')}.json")
    assert not (tmp_path / "parts" / "sweep.csv").exists()
    buckens("sweep", "--merge", "parts").must(0)
    whole = (tmp_path / "whole" / "sweep.csv").read_text()
    assert (tmp_path / "parts" / "sweep.csv").read_text() == whole
    # Everything again: nothing is computed twice, and the table is the same.
    for shard in ("1/4", "2/4", "3/4", "4/4"):
        told = buckens("sweep", model, *RANGES, "-o", "parts", "--shard", shard, "--json").must(0)
        assert {variant["status"] for variant in told.json["variants"]} == {"kept"}
    merged = buckens("sweep", "--merge", "parts", "--json").must(0).json
    assert [variant["name"] for variant in merged["variants"]] == [f"{k:03}" for k in range(1, 7)]
    assert (tmp_path / "parts" / "sweep.csv").read_text() == whole.replace(",done,", ",kept,")


def test_the_table_is_there_as_hdf5_too(buckens, models, tmp_path):
    h5py = pytest.importorskip("h5py")
    buckens("sweep", models / "pendulum.yaml", *RANGES, "-o", "out", "-q").must(0)
    rows = list(csv.DictReader((tmp_path / "out" / "sweep.csv").open()))
    with h5py.File(tmp_path / "out" / "sweep.h5") as file:
        columns = {data.attrs["column"]: data for data in file.values()}
        assert {key.decode() if isinstance(key, bytes) else key for key in columns} == set(rows[0])
        assert file["tip.x last"].attrs["unit"] in ("m", b"m")
        assert list(file["tip.x last"][:]) == [float(row["tip.x [m] last"]) for row in rows]
        assert [name.decode() for name in file["name"][:]] == [row["name"] for row in rows]


def test_variants_with_one_factor_share_a_shard(buckens, models, tmp_path):
    """The table alternates between two materials; each shard makes one factor."""
    ranges = ("--vary", "parameters.g=[9.81 m/s^2, 0, 1]", "--vary", "parameters.E=[1e8 Pa, 2e8 Pa]")
    names = []
    for shard in ("1/2", "2/2"):
        told = buckens("sweep", models / "soft_block.yaml", *ranges, "-o", "out", "--shard", shard, "--json").must(0)
        names.append([variant["name"] for variant in told.json["variants"]])
        assert told.json["factorisations"] == 1
    assert names == [["001", "003", "005"], ["002", "004", "006"]]


def test_reasons_of_failures_are_in_the_table(buckens, models, tmp_path):
    ranges = ("--vary", "bodies.beam.beam.elements=[2, -1, 4]")
    codes = [buckens("sweep", models / "beam.yaml", *ranges, "-o", "out", "--shard", f"{k}/3", "-q").code
             for k in (1, 2, 3)]
    assert sorted(codes) == [0, 0, 4]
    buckens("sweep", "--merge", "out").must(4)
    rows = list(csv.DictReader((tmp_path / "out" / "sweep.csv").open()))
    assert [row["status"] for row in rows] == ["done", "failed", "done"]
    assert "elements" in rows[1]["message"] and "-1" in rows[1]["message"]


def test_a_killed_shard_goes_on(buckens, start, models, tmp_path):
    steps = ("--vary", "gravity.1=[" + ", ".join(map(str, range(1, 31))) + "]", "--set", "simulation.step=20 us")
    call = ("sweep", models / "pendulum.yaml", *steps, "-o", "out", "--shard", "1/2", "--together", "1", "--json")
    process = start(*call)
    for _ in range(2000):
        if (tmp_path / "out" / "003" / "summary.json").exists():
            break
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    process.wait()
    buckens("sweep", "--merge", "out").must(2, "parts")
    again = buckens(*call).must(0).json
    statuses = [variant["status"] for variant in again["variants"]]
    assert len(statuses) == 15 and statuses[:2] == ["kept", "kept"] and set(statuses) <= {"kept", "done"}
    buckens("sweep", "--merge", "out").must(2, "1 of 2 shards", "2/2")


def test_status_tells_how_far_it_is(buckens, models, tmp_path):
    model = models / "pendulum.yaml"
    buckens("sweep", model, *RANGES, "-o", "out", "--shard", "1/2", "-q").must(0)
    told = buckens("sweep", "--status", "out", "--json").must(0).json
    first, second = told["shards"]
    assert (first["state"], second["state"]) == ("ended", "not begun")
    assert first["finished"] == first["variants"] == told["finished"] > 0 and told["failed"] == told["running"] == 0
    text = buckens("sweep", "--status", "out").must(0).out
    assert f"{first['variants']} of {first['variants']} variants finished, 0 failed, 0 running" in text
    assert "1/2" in text and "not begun" in text
    # As it looks while it runs: two have not ended; of the others nothing is known before the shard has begun.
    (tmp_path / "out" / ".parts" / "1-of-2.ended").unlink()
    runs = sorted(path.parent for path in (tmp_path / "out").glob("*/summary.json"))
    for run in runs[:2]:
        (run / "summary.json").write_text(json.dumps({"status": "running"}))
    told = buckens("sweep", "--status", "out", "--json").must(0).json
    assert told["shards"][0]["state"] == "begun"
    assert (told["finished"], told["failed"], told["running"]) == (first["variants"] - 2, 0, 2)
    assert told["slowest"] in [run.name for run in runs[:2]] and told["to_go"] > 0
    # A sweep that is not divided.
    buckens("sweep", model, "--vary", "gravity.1=[1, 2]", "-o", "whole", "-q").must(0)
    told = buckens("sweep", "--status", "whole", "--json").must(0).json
    assert told["finished"] == told["variants"] == 2 and told["shards"][0]["state"] == "ended"


def test_status_counts_failures_and_a_sweep_that_goes_on(buckens, start, models, tmp_path):
    ranges = ("--vary", "bodies.beam.beam.elements=[2, -1, 4]")
    buckens("sweep", models / "beam.yaml", *ranges, "-o", "out", "-q").must(4)
    told = buckens("sweep", "--status", "out", "--json").must(0).json
    assert (told["variants"], told["finished"], told["failed"]) == (3, 2, 1)
    assert told["to_go"] == 0 and told["shards"][0]["state"] == "ended"
    # Again while it is interrupted: what it had finished counts, what it has not begun does not run.
    steps = ("--vary", "gravity.1=[" + ", ".join(map(str, range(1, 31))) + "]", "--set", "simulation.step=20 us")
    process = start("sweep", models / "pendulum.yaml", *steps, "-o", "long", "--together", "1", "-q")
    for _ in range(2000):
        if (tmp_path / "long" / "003" / "summary.json").exists():
            break
        time.sleep(0.01)
    told = buckens("sweep", "--status", "long", "--json").must(0).json
    assert told["shards"][0]["state"] == "begun" and told["finished"] >= 2 and told["running"] <= 1
    assert 0 < told["to_go"] < 1000 * told["seconds"]
    process.send_signal(signal.SIGINT)
    process.wait()
    told = buckens("sweep", "--status", "long", "--json").must(0).json
    assert told["shards"][0]["state"] == "interrupted" and told["running"] == told["failed"] == 0
    assert 2 <= told["finished"] < 30


def test_status_says_what_is_wrong(buckens, models, tmp_path):
    model = models / "pendulum.yaml"
    buckens("sweep", "--status", "nowhere").must(2, "nowhere", "no sweep has begun here")
    buckens("sweep", model, "--status", "out").must(2, "--status OUT", "nothing but the directory")
    for shard in ("1/2", "2/3"):
        buckens("sweep", model, *RANGES, "-o", "out", "--shard", shard, "-q").must(0)
    buckens("sweep", "--status", "out").must(2, "2-of-3", "one of 3", "one of 2")
    (tmp_path / "out" / ".parts" / "2-of-3.begun").write_text("{}")
    buckens("sweep", "--status", "out").must(5, "2-of-3", "damaged", "start its shard again")


def test_says_what_is_wrong(buckens, models, tmp_path):
    model = models / "pendulum.yaml"
    for shard in ("0/4", "5/4", "half", "2"):
        buckens("sweep", model, *RANGES, "--shard", shard).must(2, "--shard", "3/8")
    (tmp_path / "empty").mkdir()
    buckens("sweep", "--merge", "empty").must(2, "no parts", "--shard I/N")
    buckens("sweep", "--merge", "nowhere").must(2, "no parts")
    buckens("sweep", model, "--merge", "out").must(2, "--merge OUT")
    buckens("sweep").must(2, "MODEL")
    (tmp_path / "table.csv").write_text("simulation.duration\n")
    buckens("sweep", model, "table.csv", "--shard", "1/2").must(2, "no variants")
    # More shards than variants: some have nothing to do.
    for k in range(1, 10):
        buckens("sweep", model, *RANGES, "-o", "many", "--shard", f"{k}/9", "-q").must(0)
    buckens("sweep", "--merge", "many", "-q").must(0)
    # Parts of another table.
    buckens("sweep", model, "--vary", "gravity.1=[1, 2]", "-o", "many", "--shard", "2/9", "-q").must(0)
    buckens("sweep", "--merge", "many").must(2, "2-of-9", "another model or table")
    part = tmp_path / "many" / ".parts" / "1-of-9.json"
    part.write_text(json.dumps({"shard": 1}))
    buckens("sweep", "--merge", "many").must(5, "1-of-9", "remove it")


def test_a_sweep_is_run_by_one_process(buckens, start, models, tmp_path):
    """A second one would find the variants of the first locked, and write a table that calls them failed."""
    steps = ("--vary", "gravity.1=[" + ", ".join(map(str, range(1, 31))) + "]", "--set", "simulation.step=20 us")
    for out, words, name in (("whole", (), "this sweep"), ("parts", ("--shard", "1/2"), "shard 1/2")):
        call = ("sweep", models / "pendulum.yaml", *steps, "-o", out, "--together", "1", "-q", *words)
        process = start(*call)
        for _ in range(2000):
            if list((tmp_path / out).glob("*/summary.json")):
                break
            time.sleep(0.01)
        buckens(*call).must(5, f"{out}: another process is running {name}", "Wait for its end")
        assert process.wait(timeout=60) == 0
        buckens(*call).must(0)


def test_mpirun_is_no_way_to_divide_a_sweep(buckens, models):
    """What mpirun says in the environment: one of its processes tells it, and none begins."""
    alone = {**os.environ, "OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": "0"}
    call = ("sweep", models / "pendulum.yaml", *RANGES, "-o", "out", "-q")
    buckens(*call, env=alone).must(2, "mpirun has started 2 processes", "--shard I/2")
    other = buckens(*call, env={**alone, "OMPI_COMM_WORLD_RANK": "1"}).must(2)
    assert other.err == "" and other.out == ""
    for rank in ("0", "1"):
        buckens(*call, "--shard", f"{int(rank) + 1}/2", env={**alone, "OMPI_COMM_WORLD_RANK": rank}).must(0)
    buckens("sweep", "--merge", "out", "-q", env=alone).must(0)

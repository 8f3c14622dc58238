# SPDX-License-Identifier: Apache-2.0
"""The page served by `buckens view --live`: to whom, and nothing else. What it shows: viewer/tests/live.spec.mjs."""

import http.client
import json
import os
import re
import signal
import stat
import time

import pytest


@pytest.fixture
def live(start, buckens, models, tmp_path):
    """A served run: its process, port and token."""
    buckens("run", models / "pendulum.yaml", "-q", "-o", "out").must(0)
    process = start("view", "out", "--live")
    address = process.stdout.readline()
    found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/\n", address)
    assert found, address
    return process, int(found[1]), found[2]


def get(port, path, method="GET", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
    try:
        connection.request(method, path, headers=headers)
        response = connection.getresponse()
        return response.status, response.read().decode(), response
    finally:
        connection.close()


def test_it_serves_the_page_to_those_who_know_the_token(live, tmp_path):
    process, port, token = live
    status, text, _ = get(port, f"/{token}/")
    assert status == 200 and "<iframe" not in text and "createElement('iframe')" in text
    status, text, response = get(port, f"/{token}/page")
    assert status == 200 and "Test pendulum" in text and "BUCKENS_DATA" in text
    assert response.getheader("Cache-Control") == "no-store"
    status, text, _ = get(port, f"/{token}/state")
    assert status == 200 and json.loads(text)["status"] == "finished"
    process.send_signal(signal.SIGINT)
    assert process.wait(30) == 0


def test_it_serves_nothing_else(live, tmp_path):
    _, port, token = live
    for path in ("/", "/page", "/state", f"/{token[:-1]}/", f"/{'0' * 32}/page", f"/{token}/model.yaml",
                 f"/{token}/../out/model.yaml", f"/{token}/results.h5", f"/{token}/%2e%2e/%2e%2e/etc/passwd"):
        assert get(port, path)[0] == 404, path
    for method in ("POST", "PUT", "DELETE", "OPTIONS"):
        assert get(port, f"/{token}/", method)[0] in (400, 404, 405), method
    # A name of another site that resolves to this machine.
    assert get(port, f"/{token}/", Host=f"buckens.example:{port}")[0] == 403


def test_it_listens_on_the_loopback_interface_only(live):
    _, port, _ = live
    with open("/proc/net/tcp") as table:
        places = [line.split()[1] for line in table.readlines()[1:] if line.split()[3] == "0A"]
    assert [place for place in places if place.endswith(f":{port:04X}")] == [f"0100007F:{port:04X}"]


def test_it_tells_what_is_wrong(buckens, models, tmp_path):
    buckens("view", "none", "--live").must(5, "none: not a run directory")
    buckens("run", models / "pendulum.yaml", "-q", "-o", "out").must(0)
    buckens("view", "out", "--live", "-o", "page.html").must(2, "leave out -o")


def test_open_calls_the_browser(buckens, models, tmp_path):
    buckens("run", models / "pendulum.yaml", "-q", "-o", "out").must(0)
    buckens("view", "out", "--open", env={**os.environ, "PATH": str(tmp_path)}).must(
        5, "--open: cannot start xdg-open", "xdg-utils")
    opener = tmp_path / "xdg-open"
    opener.write_text(f"#!/bin/sh\necho \"$1\" > {tmp_path}/opened\n")
    opener.chmod(opener.stat().st_mode | stat.S_IXUSR)
    buckens("view", "out", "--open", env={**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}).must(0)
    deadline = time.monotonic() + 30
    while not (tmp_path / "opened").exists() or not (tmp_path / "opened").read_text():
        assert time.monotonic() < deadline
        time.sleep(0.01)
    assert (tmp_path / "opened").read_text().strip() == str(tmp_path / "out" / "view.html")

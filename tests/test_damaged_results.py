# SPDX-License-Identifier: Apache-2.0
"""Results that another program has written or changed, or that a disk has damaged: every verb that reads them
reports what is wrong with which data set, and exits with the code of an unreadable file."""

import os
import shutil
import subprocess

import h5py
import numpy
import pytest

from conftest import PROGRAM, Result
from test_export import MODEL
from test_view import add_viewer

REFUSED = 5


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    """A run of solids, beams, a rigid body and a load, with fields, and a page to view it with."""
    place = tmp_path_factory.mktemp("good")
    (place / "model.yaml").write_text(MODEL)
    subprocess.run([PROGRAM, "run", "-q", "model.yaml", "-o", "run"], cwd=place, check=True)
    program = place / "prefix" / "bin" / "buckens"
    program.parent.mkdir(parents=True)
    shutil.copy(PROGRAM, program)
    add_viewer(program)
    return place


@pytest.fixture
def damaged(good, tmp_path):
    """Copies the run; returns its results.h5."""
    shutil.copytree(good / "run", tmp_path / "run")
    return tmp_path / "run" / "results.h5"


@pytest.fixture
def verbs(good, tmp_path):
    """Lets each verb read the run, or one of them by number."""

    every = [("view", "run"), ("export", "run", "--vtk", "--csv", "--glb"),
             ("plot", "run", "tip", "-o", "plot.svg"), ("compare", good / "run", "run")]

    def call(one=None):
        results = []
        for arguments in every if one is None else [every[one % len(every)]]:
            process = subprocess.run(
                [good / "prefix" / "bin" / "buckens", *map(str, arguments)], cwd=tmp_path,
                text=True, capture_output=True, timeout=300, check=False)
            results.append(Result(process))
        return results

    return call


@pytest.fixture
def read(verbs):
    """The same, and all results must be equal. Returns the common result."""

    def call():
        results = verbs()
        assert len({(one.code, one.err) for one in results}) == 1, \
            "\n".join(f"{one.code}: {one.err}" for one in results)
        return results[0]

    return call


def test_the_run_itself_can_be_read(damaged, read):
    with h5py.File(damaged) as file:
        assert len(file["time"]) == 11 and len(file["fields/time"]) == 6
    assert read().must(0).err == ""


def replaced(file, path, *arguments, **options):
    """Replaces a data set by another one, with its attributes."""
    attributes = dict(file[path].attrs)
    del file[path]
    created = file.create_dataset(path, *arguments, **options)
    for name, value in attributes.items():
        created.attrs[name] = value
    return created


def edit(path, index, value):
    """A fault that puts a value into a data set."""

    def apply(file):
        file[path][index] = value

    return apply


def swap(path, *arguments, **options):
    return lambda file: replaced(file, path, *arguments, **options)


def attribute(path, name, value):
    return lambda file: file[path].attrs.create(name, value)


def link(path, target):
    def apply(file):
        del file[path]
        file[path] = target

    return apply


def hard_loop(file):
    file["sensors/again"] = file["/sensors"]


def deep_groups(file):
    file.create_group("sensors" + "/deeper" * 2000)


def wide_loops(file):
    """Every group contains each of the others: a depth limit alone does not end this soon."""
    groups = [file.create_group(f"sensors/g{i}") for i in range(12)]
    for group in groups:
        for i, other in enumerate(groups):
            group[f"to{i}"] = other


def external_values(file):
    values = numpy.zeros(11)
    del file["energies/kinetic"]
    (file.filename and open(os.path.join(os.path.dirname(file.filename), "raw.bin"), "wb")
     ).write(values.tobytes())
    file.create_dataset("energies/kinetic", (11,), "f8", external=[("raw.bin", 0, 88)])


def virtual_values(file):
    layout = h5py.VirtualLayout((11,), "f8")
    layout[:] = h5py.VirtualSource("other.h5", "x", (11,))
    del file["energies/kinetic"]
    file.create_virtual_dataset("energies/kinetic", layout)


def strange_name(file):
    file["sensors"].id.links.create_soft  # noqa: B018 - the low level takes names of any bytes
    space = h5py.h5s.create_simple((11,), (11,))
    h5py.h5d.create(file["sensors"].id, b"caf\xe9", h5py.h5t.IEEE_F64LE, space)


BEAM, BLOCK = "geometry/bodies/beam", "geometry/bodies/block"
POSE = "bodies/beam/pose"
HUGE = 2**32 + 3  # as an int: 3
NO_NUMBER = numpy.full((1, 4), numpy.nan)

# A fault, and what the message says beside the name of the file.
FAULTS = {
    "time of two extents": (swap("time", (11, 3), "f8"), ["/time", "11 x 3"]),
    "time without extent": (swap("time", (), "f8"), ["/time"]),
    "time of texts": (swap("time", data=["1"] * 11), ["/time", "floating-point"]),
    "time of integers": (swap("time", data=numpy.arange(11)), ["/time", "floating-point"]),
    "time that is no number": (edit("time", 4, numpy.nan), ["/time", "nan", "number 5"]),
    "time that goes back": (edit("time", 4, -1.0), ["/time", "-1", "number 5"]),
    "time of fields beyond the run": (edit("fields/time", 5, 7.0), ["/fields/time", "t = 7"]),
    "no time": (lambda file: file.pop("time"), ["/time", "missing"]),
    "huge extent": (swap("sensors/tip", (11, HUGE), "f8", chunks=(1, 1024)),
                    ["/sensors/tip", str(HUGE)]),
    "huge product": (swap("sensors/tip", (11, 2**31 - 1, 2**31 - 1, 8), "f8", chunks=(1, 4, 4, 1)),
                     ["/sensors/tip", "2147483647 x 2147483647", "more than the file can hold"]),
    "rows without values": (swap("sensors/tip", (11, 2**24), "f8", chunks=(1, 1024)),
                            ["/sensors/tip", "more than the file can hold"]),
    "huge geometry": (swap(f"{BEAM}/nodes", (2**30, 3), "f8", chunks=(1024, 3)),
                      [f"/{BEAM}/nodes", "more than the file can hold"]),
    "extent of zero": (swap("sensors/tip", (11, 0), "f8"), ["/sensors/tip", "at least 1"]),
    "too few rows": (swap("sensors/tip", (4, 3), "f8"), ["/sensors/tip", "11 instants"]),
    "a single value": (swap("sensors/tip", (), "f8"), ["/sensors/tip", "11 instants"]),
    "records of texts": (swap("sensors/tip", data=["a"] * 11), ["/sensors/tip", "floating-point"]),
    "pose of three numbers": (swap(POSE, (11, 3), "f8"), [f"/{POSE}", "7 component"]),
    "displacements of other nodes": (swap("bodies/beam/displacement", (11, 2, 6), "f8"),
                                     ["/bodies/beam/displacement", "[2 x 6]", "[5 x 6]"]),
    "fields of other nodes": (swap("fields/bodies/block/nodes/von_mises", (6, 3), "f4"),
                              ["/fields/bodies/block/nodes/von_mises"]),
    "fields without place": (swap("fields/bodies/block/elements/von_mises", (6,), "f4"),
                             ["/fields/bodies/block/elements/von_mises", "2 places"]),
    "fewer names than components": (attribute("sensors/tip", "components", ["x"]),
                                    ["/sensors/tip", "1 component"]),
    "unit that is a number": (attribute("sensors/tip", "unit", 3.0), ["/sensors/tip", "texts"]),
    "unit without extent": (attribute("sensors/tip", "unit", h5py.Empty("f8")),
                            ["/sensors/tip", "texts"]),
    "unit of fixed length": (attribute("sensors/tip", "unit", numpy.bytes_("m")),
                             ["/sensors/tip", "texts"]),
    "unit of strange bytes": (attribute("sensors/tip", "unit", b"\xff\xfe"),
                              ["/sensors/tip", "UTF-8"]),
    "name of strange bytes": (strange_name, ["/sensors", "UTF-8"]),
    "symbolic link": (link("sensors/tip", h5py.SoftLink("/time")), ["/sensors/tip", "link"]),
    "link into nowhere": (link("sensors/tip", h5py.SoftLink("/nothing")), ["/sensors/tip", "link"]),
    "link to another file": (link("sensors/tip", h5py.ExternalLink("other.h5", "/x")),
                             ["/sensors/tip", "link"]),
    "geometry in another file": (link(BLOCK, h5py.ExternalLink("other.h5", "/x")),
                                 [f"/{BLOCK}", "link"]),
    "time in another file": (link("time", h5py.ExternalLink("other.h5", "/x")), ["/time", "link"]),
    "group that holds itself": (hard_loop, ["/sensors/again", "deep"]),
    "groups that hold one another": (wide_loops, ["/sensors/g0", "deep"]),
    "very deep groups": (deep_groups, ["/sensors/deeper", "deep"]),
    "values in another file": (external_values, ["/energies/kinetic", "other data sets or files"]),
    "values of another data set": (virtual_values,
                                   ["/energies/kinetic", "other data sets or files"]),
    "unknown packing": (swap("energies/kinetic", data=numpy.zeros(11), chunks=(11,),
                             compression="lzf"), ["/energies/kinetic", "packed"]),
    "no geometry": (lambda file: file.pop("geometry"), ["/geometry"]),
    "geometry that is a data set": (swap("geometry", (3,), "f8"), ["/geometry"]),
    "body without nodes": (lambda file: file.pop(f"{BEAM}/nodes"), [f"/{BEAM}/nodes", "missing"]),
    "body that is a data set": (swap(BEAM, (3,), "f8"), [f"/{BEAM}"]),
    "nodes of two coordinates": (swap(f"{BEAM}/nodes", (5, 2), "f8"),
                                 [f"/{BEAM}/nodes", "5 x 2", "3]"]),
    "element of a missing node": (edit(f"{BEAM}/elements", (0, 1), 5), [f"/{BEAM}"]),
    "element of a negative node": (edit(f"{BEAM}/elements", (0, 1), -1), [f"/{BEAM}"]),
    "elements of numbers": (swap(f"{BEAM}/elements", data=numpy.full((4, 2), numpy.nan)),
                            [f"/{BEAM}/elements", "integers"]),
    "elements of huge numbers": (swap(f"{BEAM}/elements", data=numpy.full((4, 2), 2**40)),
                                 [f"/{BEAM}"]),
    "face of a missing node": (edit(f"{BLOCK}/faces", (0, 0), 12), [f"/{BLOCK}"]),
    "face of a missing element": (edit(f"{BLOCK}/face_elements", 0, 2), [f"/{BLOCK}"]),
    "cell of a missing node": (edit(f"{BLOCK}/cell_nodes", 3, 12), [f"/{BLOCK}/cell_nodes"]),
    "cell of an unknown kind": (edit(f"{BLOCK}/cell_kinds", 1, 99), [f"/{BLOCK}/cell_kinds"]),
    "cells of fewer nodes": (swap(f"{BLOCK}/cell_nodes", (15,), "i4"), [f"/{BLOCK}"]),
    "field at a missing node": (edit(f"{BLOCK}/field_nodes", 0, 12), [f"/{BLOCK}/field_nodes"]),
    "field at a missing place": (edit(f"{BLOCK}/face_places", (0, 0), 16),
                                 [f"/{BLOCK}/face_places"]),
    "marker on a missing node": (edit(f"{BEAM}/marker_nodes", 0, 5), [f"/{BEAM}/marker_nodes"]),
    "joint of a missing body": (attribute("geometry/joints/grip", "bodies", ["beam", "nobody"]),
                                ["/geometry/joints/grip"]),
    "joint of one body": (attribute("geometry/joints/grip", "bodies", ["beam"]),
                          ["/geometry/joints/grip"]),
    "load on a missing body": (attribute("geometry/loads/push", "body", "nobody"),
                               ["/geometry/loads/push"]),
    "gravity of one number": (attribute("geometry", "gravity", [9.81]), ["/geometry"]),
}


@pytest.mark.parametrize("name", FAULTS)
def test_faults_are_refused(damaged, read, name):
    fault, words = FAULTS[name]
    with h5py.File(damaged, "r+", libver="latest") as file:
        fault(file)
    read().must(REFUSED, "run/results.h5", *words)


def test_more_than_we_write_does_no_harm(damaged, read):
    """Notes of a user, and a file that was packed: still a run."""
    with h5py.File(damaged, "r+", libver="latest") as file:
        file.attrs["note"] = "mine"
        file["sensors/tip"].attrs["colour"] = "red"
        tip = file["sensors/tip"][:]
        replaced(file, "sensors/tip", data=tip, compression="gzip", shuffle=True)
    read().must(0)


@pytest.mark.parametrize("content", [b"", b"not a file of this kind", b"\x89HDF\r\n\x1a\n" * 100])
def test_other_files(damaged, read, content):
    damaged.write_bytes(content)
    read().must(REFUSED, "run/results.h5")


def test_a_directory_in_place_of_the_results(damaged, read):
    damaged.unlink()
    damaged.mkdir()
    read().must(REFUSED, "run/results.h5")


def test_files_that_were_cut_off(damaged, read):
    whole = damaged.read_bytes()
    # The first 48 bytes are those that HDF5 polls until another process completes them.
    for size in (8, 30, 47, *(int(part * len(whole)) for part in (0.1, 0.9, 0.99))):
        damaged.write_bytes(whole[:size])
        read().must(REFUSED, "run/results.h5")


def test_bookkeeping_with_a_wrong_check_sum(damaged, read):
    """HDF5 waits for a writer to complete it; this program gives up soon and reports what is wrong."""
    whole = damaged.read_bytes()
    headers = [at for at in range(len(whole)) if whole.startswith(b"OHDR", at)]
    assert len(headers) > 20
    for at in headers[:3]:
        damaged.write_bytes(whole[:at + 6] + bytes([whole[at + 6] ^ 0xff]) + whole[at + 7:])
        read().must(REFUSED, "run/results.h5", "checksum")


def test_texts_of_a_wrong_length(damaged, read, verbs):
    """HDF5 copies as many bytes as the heap of the file says into room for as many as the reference
    says; both are bytes on the disk without check sum."""
    with h5py.File(damaged) as file:
        place = file[f"{BEAM}/marker_names"].id.get_offset()
    whole = damaged.read_bytes()
    assert int.from_bytes(whole[place:place + 4], "little") == len("start")
    heap = int.from_bytes(whole[place + 4:place + 12], "little")
    assert whole[heap:heap + 4] == b"GCOL"
    for number, at in enumerate([*range(place, place + 16, 3), *range(heap + 5, heap + 40, 5)]):
        # The highest byte of the length: 250 MB, as wrong as 2 GB, and copied in a tenth of the time.
        byte = b"\x0f" if at == place + 3 else b"\x7f"
        damaged.write_bytes(whole[:at] + byte + whole[at + 1:])
        # Whether the process that reads the texts survives is a matter of luck; this one must. All verbs
        # read in the same way, at up to a minute for all places: they take turns.
        for result in verbs(number):
            assert result.code in (0, REFUSED), (at - place, at - heap, result.code, result.err)
            assert result.code == 0 or "run/results.h5" in result.err
    # An entry of the heap that does not exist: no library survives that.
    damaged.write_bytes(whole[:place + 12] + b"\xff\xff\x7f\x7f" + whole[place + 16:])
    read().must(REFUSED, "run/results.h5", "damaged")


def test_a_damaged_summary(damaged, read):
    for text in ["", "{}", "[]", "null", '{"status": 3}', '{"program": "buckens"', "\xff"]:
        damaged.with_name("summary.json").write_text(text, encoding="latin-1")
        read().must(REFUSED, "summary.json")

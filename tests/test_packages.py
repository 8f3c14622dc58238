# SPDX-License-Identifier: Apache-2.0
"""The Debian packages that cpack makes. tests/packages/clean_root.sh installs and uses them in a fresh Debian."""

import pathlib
import re
import shutil
import subprocess
import sys

import pytest

from conftest import BINARY, SOURCE

VERSION = (SOURCE / "VERSION").read_text().split()[0]


def call(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=500, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def packages(tmp_path_factory):
    """File of each package by its name."""
    for tool in ("cpack", "dpkg-deb", "dpkg-shlibdeps"):
        if shutil.which(tool) is None:
            pytest.skip(f"{tool} is not installed")
    if not (BINARY / "lib" / "libbuckens.a").exists():
        pytest.skip("the library is not built")
    folder = tmp_path_factory.mktemp("packages")
    call("cpack", "-G", "DEB", "-B", folder, "-C", "Release", cwd=BINARY)
    return {path.name.split("_")[0]: path for path in folder.glob("*.deb")}


def files_of(package):
    """Mode and path of each file."""
    rows = [line.split(None, 5) for line in call("dpkg-deb", "-c", package).splitlines()]
    return {row[5][1:]: row[0] for row in rows if not row[0].startswith("d")}


def field(package, name):
    return call("dpkg-deb", "-f", package, name).strip()


def test_the_program_with_its_page(packages):
    files = files_of(packages["buckens"])
    assert files["/usr/bin/buckens"] == "-rwxr-xr-x"
    assert {"/usr/share/buckens/viewer.html", "/usr/share/buckens/schema/model.schema.json",
            "/usr/share/man/man1/buckens.1.gz", "/usr/share/doc/buckens/copyright",
            "/usr/share/doc/buckens/changelog.gz"} <= set(files)
    assert "/usr/share/buckens/examples/slider_crank/slider_crank.yaml" in files
    assert not [path for path in files if "/include/" in path or "/python" in path and path.endswith(".so")]
    needs = field(packages["buckens"], "Depends")
    assert "libcholmod3" in needs and "libhdf5" in needs and "gmsh" not in needs
    assert "libgmsh" in field(packages["buckens"], "Recommends")
    assert field(packages["buckens"], "Version") == f"{VERSION}-1"


def test_the_library_with_its_headers(packages):
    files = files_of(packages["libbuckens-dev"])
    assert {"/usr/lib/libbuckens.a", "/usr/include/buckens/buckens.h",
            "/usr/lib/cmake/buckens/buckensConfig.cmake"} <= set(files)
    # What the CMake package looks for is installed with it.
    needs = field(packages["libbuckens-dev"], "Depends").lower()
    for name in re.findall(r"find_dependency\((\w[\w-]*)", (SOURCE / "cmake" / "buckensConfig.cmake.in").read_text()):
        word = {"Eigen3": "eigen3", "HDF5Serial": "hdf5", "nlohmann_json": "nlohmann-json3", "ZLIB": "zlib1g",
                "Threads": ""}.get(name, name.lower())
        assert word in needs, name


def test_the_module_where_debian_looks(packages):
    if "python3-buckens" not in packages:
        pytest.skip("the Python module is not built")
    files = files_of(packages["python3-buckens"])
    place = "/usr/lib/python3/dist-packages/buckens/"
    assert {place + "__init__.py", place + "objects.py", place + "py.typed"} <= set(files)
    assert [path for path in files if re.fullmatch(place + r"_core\.cpython-\d+-\S+\.so", path)]
    assert all(path.startswith((place, "/usr/share/doc/")) for path in files)
    needs = field(packages["python3-buckens"], "Depends")
    major, minor = sys.version_info[:2]
    assert f"python3 (<< {major}.{minor + 1})" in needs and "python3-numpy" in needs


def test_every_package_says_what_debian_asks(packages):
    assert len(packages) >= 2
    for name, package in packages.items():
        documents = f"/usr/share/doc/{name}/"
        files = files_of(package)
        assert {documents + "copyright", documents + "changelog.Debian.gz"} <= set(files)
        assert all(mode[1:] in ("rw-r--r--", "rwxr-xr-x") for mode in files.values())
        assert "@" in field(package, "Maintainer")
        description = field(package, "Description").splitlines()
        assert len(description) > 3 and all(len(line) <= 80 for line in description)


def test_the_manual_page_knows_every_verb(buckens):
    verbs = re.findall(r"^  ([a-z][a-z-]*)  ", buckens("--help").must(0).out, re.MULTILINE)
    page = (SOURCE / "docs" / "man" / "buckens.1").read_text()
    described = re.findall(r"^\.TP\n\\fB([a-z\\-]+)\\fR", page, re.MULTILINE)
    assert sorted(name.replace("\\", "") for name in described) == sorted(verbs)
    codes = re.findall(r"^\.B (\d+)$", page, re.MULTILINE)
    text = pathlib.Path(SOURCE / "apps" / "cli" / "exit_code.h").read_text()
    assert codes == re.findall(r"= (\d+),", text)


def test_files_for_other_services_name_what_is_here():
    """Container file, recipe and workflow, as far as they can be checked without the services."""
    yaml = pytest.importorskip("yaml")
    workflow = yaml.safe_load((SOURCE / ".github" / "workflows" / "test.yaml").read_text())
    runs = [step["run"] for job in workflow["jobs"].values() for step in job["steps"] if "run" in step]
    scripts = [run.split()[0] for run in runs if "/" in run.split()[0]]
    assert {"./test.sh", "./packages.sh", "tests/packages/clean_root.sh"} == set(scripts)
    container = (SOURCE / "packaging" / "Containerfile").read_text()
    scripts += re.findall(r"\./\w+\.sh", container)
    assert "/source/build/release/packages/*.deb" in container
    for script in scripts:
        assert (SOURCE / script).stat().st_mode & 0o100, f"{script} cannot be executed"
    # The same library of Gmsh as the package recommends.
    assert "libgmsh4.8" in container
    recipe = (SOURCE / "packaging" / "conda" / "meta.yaml").read_text().lower()
    for name in re.findall(r"^find_package\((\w+)", (SOURCE / "cmake" / "BuckensDependencies.cmake").read_text(), re.MULTILINE):
        word = {"Eigen3": "eigen", "HDF5Serial": "hdf5", "OpenBLAS": "openblas", "Threads": ""}.get(name, name.lower())
        assert word.replace("-", "") in recipe.replace("-", ""), name
    # What is run while building is there.
    for option in re.findall(r"-D(BUCKENS_\w+)=", (SOURCE / "packaging" / "conda" / "build.sh").read_text()):
        assert any(option in path.read_text() for path in (SOURCE / "cmake").glob("*.cmake")), option


def test_the_packing_script_refuses_what_it_does_not_know():
    done = subprocess.run([SOURCE / "packages.sh", "--without-tests"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and "unknown argument --without-tests; usage: ./packages.sh" in done.stderr
    assert "Debian packages" in call(SOURCE / "packages.sh", "--help")

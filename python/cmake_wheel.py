# SPDX-License-Identifier: Apache-2.0
"""Build back end of `pip install .` (PEP 517): configures and builds with CMake, and packs a wheel.

BUCKENS_BUILD_DIR names a build directory to use, such as build/release; without it build/wheel is made.
"""

import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
SUMMARY = "Multibody dynamics with unreduced finite-element bodies"


def version():
    return (ROOT / "VERSION").read_text().split()[0]


def name_and_version():
    return f"buckens-{version()}"


def tag():
    cpython = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    return f"{cpython}-{cpython}-{platform}"


def metadata_files():
    return {
        "METADATA": f"Metadata-Version: 2.1\nName: buckens\nVersion: {version()}\nSummary: {SUMMARY}\n"
                    "License: Apache-2.0\nRequires-Python: >=3.9\nRequires-Dist: numpy\n"
                    "Provides-Extra: results\nRequires-Dist: h5py; extra == 'results'\n",
        "WHEEL": "Wheel-Version: 1.0\nGenerator: cmake_wheel\nRoot-Is-Purelib: false\n"
                 f"Tag: {tag()}\n",
    }


def build(directory):
    """Configures, unless that was done, and builds what a wheel holds."""
    if not (directory / "CMakeCache.txt").exists():
        subprocess.run(["cmake", "-S", ROOT, "-B", directory, "-G", "Ninja",
                        "-DCMAKE_BUILD_TYPE=Release", "-DBUCKENS_TESTS=OFF", "-DBUCKENS_UNITY=ON",
                        f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", directory, "--target", "buckens_python", "buckens_program",
                    "buckens_viewer"], check=True)


def contents(directory, stage):
    """Name in the wheel and file of everything that it holds, installed below `stage`."""
    subprocess.run(["cmake", "--install", directory, "--prefix", stage, "--strip", "--component",
                    "python"], check=True, stdout=subprocess.DEVNULL)
    package = next(pathlib.Path(stage).rglob("buckens/__init__.py")).parent
    out = {f"buckens/{file.name}": file for file in sorted(package.iterdir()) if file.is_file()}
    data = f"{name_and_version()}.data"
    out[f"{data}/scripts/buckens"] = directory / "bin" / "buckens"
    page = next(iter(sorted(directory.rglob("share/buckens/viewer.html"))), None)
    if page is not None:
        out[f"{data}/data/share/buckens/viewer.html"] = page
    return out


def pack(directory, wheel_directory):
    """Packs a finished build into a wheel and returns the wheel's name."""
    wheel = f"{name_and_version()}-{tag()}.whl"
    info = f"{name_and_version()}.dist-info"
    records = []
    with tempfile.TemporaryDirectory() as stage, zipfile.ZipFile(
            pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:

        def add(name, content, mode=0o644):
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = (0o100000 | mode) << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            records.append(f"{name},sha256={digest},{len(content)}\n")

        for name, file in contents(directory, stage).items():
            add(name, file.read_bytes(), 0o755 if "/scripts/" in name else 0o644)
        for name, text in metadata_files().items():
            add(f"{info}/{name}", text.encode())
        record = f"{info}/RECORD"
        archive.writestr(record, "".join(records) + f"{record},,\n")
    return wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Called by pip."""
    directory = pathlib.Path(os.environ.get("BUCKENS_BUILD_DIR", ROOT / "build" / "wheel")).resolve()
    build(directory)
    return pack(directory, wheel_directory)

# SPDX-License-Identifier: Apache-2.0
"""Reads run directories (docs/reference/run-directory.md) as arrays."""

from __future__ import annotations

import contextlib
import difflib
import html
import json
import os
import pathlib
import tempfile
from typing import Any, Dict, Iterator, List, Optional, Tuple

import numpy as np

from .curve import Curve
from .errors import InputError, IoError
from .live_records import flush_records
from .model import PathLike
from .other_packages import package
from .result_mesh import ResultMesh, placed, read_mesh
from .run_tables import RunTables
from .verbs import view as write_page

# So many names are listed in a message; of more the one that is most alike.
_FEW = 20


class RunPage(str):
    """The path of a page that shows a run. A notebook displays the page."""

    def _repr_html_(self) -> str:
        with open_text(pathlib.Path(self)) as file:
            text = file.read()
        return (f'<iframe srcdoc="{html.escape(text)}" width="100%" height="640" '
                'style="border:0"></iframe>')


class Results:
    """Results of a run, which may still be running.

    ``r["tip"]`` is a sensor, ``r["energies/total"]`` any quantity. Values are read on access, so that later access
    to a run in progress returns more of them.
    """

    def __init__(self, directory: PathLike) -> None:
        self.directory = pathlib.Path(directory)
        self._tables = RunTables()
        if not (self.directory / "results.h5").is_file():
            raise IoError(f"{self.directory}: there is no results.h5 in it; expected a directory that "
                          "`buckens run` or buckens.Simulation(model, out=...) has written")
        with self._file() as file:
            self.title = str(_text(file.attrs.get("title", "")))

    @contextlib.contextmanager
    def _file(self) -> Iterator[Any]:
        h5py = package("h5py", "to read results")
        path = self.directory / "results.h5"
        flush_records(self.directory)
        try:
            file = h5py.File(path, "r", swmr=True)
        except OSError as error:
            raise IoError(f"{path}: cannot be read: {error}") from None
        with file:
            yield file

    @property
    def summary(self) -> Dict[str, Any]:
        """The contents of summary.json."""
        try:
            with open_text(self.directory / "summary.json") as file:
                return dict(json.load(file))
        except (OSError, ValueError) as error:
            raise IoError(f"{self.directory / 'summary.json'}: cannot be read: {error}") from None

    @property
    def energy_account(self) -> Dict[str, Any]:
        """Energy account [J]: ``brought_in``, ``lost`` and ``kept``, each by kind and name
        (``["lost"]["joint-friction"]["pin"]``), and ``unexplained``. Empty if the run has no account."""
        return dict(self.summary.get("energy_account", {}))

    @property
    def status(self) -> str:
        """State of the run: "starting", "running", "finished" or "interrupted"."""
        return str(self.summary["status"])

    @property
    def time(self) -> Curve:
        """Times of the records [s]."""
        with self._file() as file:
            return Curve(file["time"][:], name="time", unit="s")

    @property
    def sensors(self) -> List[str]:
        """Names of the sensors."""
        with self._file() as file:
            return sorted(file["sensors"]) if "sensors" in file else []

    @property
    def quantities(self) -> List[str]:
        """Paths of everything recorded at each instant.

        Of rigid models of thousands of parts, all bodies are "motions" and all joints "reactions". Each has a path of
        its own as well, as in other runs: ``r["bodies/link_7/pose"]``.
        """
        with self._file() as file:
            return [path for path in _datasets(file) if _is_recorded(path)]

    def __getitem__(self, name: str) -> Curve:
        """Returns a sensor by name ("tip", "tip.x"), or any quantity by path ("energies/total").

        Returns
        -------
        Curve
            Array of shape (records, ...) with ``unit`` and ``components``.

        Raises
        ------
        InputError
            If there is no such quantity, suggesting the closest name.
        """
        with self._file() as file:
            rows = len(file["time"])
            path, data, component = self._find(file, name)
            components = [_text(text) for text in data.attrs.get("components", [])]
            values = data[:rows]
            if component:
                if component not in components:
                    raise InputError(f"{path.split('/')[-1]!r} has no component {component!r}; it has "
                                     f"{', '.join(components) or 'none'}")
                values, components = values[..., components.index(component)], []
            return Curve(values, name=name, unit=_text(data.attrs.get("unit", "1")),
                         components=components)

    # ---- fields over meshes
    @property
    def fields(self) -> List[str]:
        """Paths of fields over meshes, under ``fields/bodies``."""
        with self._file() as file:
            return [path for path in _datasets(file) if path.startswith("fields/bodies/")]

    @property
    def field_times(self) -> Curve:
        """Times of the fields [s]."""
        with self._file() as file:
            return Curve(file["fields/time"][:] if "fields/time" in file else np.empty(0),
                         name="fields/time", unit="s")

    def field(self, quantity: str, body: str, t: Optional[float] = None, on: str = "nodes") -> Curve:
        """Returns a field over the mesh of a body.

        Parameters
        ----------
        quantity
            Such as "von_mises", "stress" or "displacement"; the model file's "von-mises" is the same.
        body
            Name of the body.
        t
            Time [s]; the nearest recorded field is returned. None: the last one. A time outside the records is refused.
        on
            "nodes", "elements", "shells", "interfaces" or "loads".
        """
        quantity = quantity.replace("-", "_")
        path = f"fields/bodies/{body}/{on}/{quantity}"
        times = self.field_times
        with self._file() as file:
            if path not in file:
                known = [p for p in _datasets(file) if p.startswith("fields/bodies/")]
                raise InputError(f"there is no field {path!r}; " + (
                    f"the run has {', '.join(known)}" if known else
                    "the run has none: ask for them in `output: {fields: ...}` of the model"))
            data = file[path]
            row = len(times) - 1 if t is None else _row_at(t, np.asarray(times), "the fields")
            return Curve(data[row], name=quantity, unit=_text(data.attrs.get("unit", "1")),
                         components=[_text(c) for c in data.attrs.get("components", [])])

    def mesh(self, body: str, t: Optional[float] = None) -> ResultMesh:
        """Returns the mesh of a body.

        Parameters
        ----------
        body
            Name of the body.
        t
            Time [s]: the mesh is deformed as in the nearest record, in world axes. A time outside the records is
            refused. None: the mesh is undeformed, in body axes.
        """
        with self._file() as file:
            known = self._tables.rows(file, "bodies")
            if body not in known:
                hint = f"the run has {', '.join(known)}" if len(known) <= _FEW else _nearest(body, list(known))
                raise InputError(f"there is no body {body!r}; {hint}")
            mesh = read_mesh(file, body)
            if t is None:
                return mesh
            times = file["time"][:]
            if not len(times):
                raise InputError(f"{self.directory}: nothing is recorded yet")
            row = _row_at(t, times, "the records")
            path = f"bodies/{body}/displacement"
            displacement = file[path][row][:, :3] if path in file else np.zeros_like(mesh.points)
            pose = self._tables.find(file, f"bodies/{body}/pose")
            if pose is None:
                raise InputError(f"{self.directory}: no pose of {body!r} is recorded")
            return placed(mesh, pose[row], displacement)

    def _find(self, file: Any, name: str) -> Tuple[str, Any, str]:
        """The path of what is recorded as `name`, its values, and the component asked for or nothing."""
        stem, dot, component = name.rpartition(".")
        for whole, part in [(name, "")] + ([(stem, component)] if dot else []):
            for path in (f"sensors/{whole}", whole):
                data = self._tables.find(file, path)
                if data is not None:
                    return path, data, part
        known = [path[len("sensors/"):] if path.startswith("sensors/") else path
                 for path in _datasets(file) if _is_recorded(path)]
        raise InputError(f"nothing is recorded as {name!r}; {_nearest(name, known)}")

    # ---- to other packages
    def to_pandas(self, *names: str) -> Any:
        """Returns sensors over time as a pandas.DataFrame.

        Parameters
        ----------
        *names
            Such as "tip" or "energies/total"; by default all sensors. The index is the time [s], columns of vectors are
            "tip.x", "tip.y", "tip.z".
        """
        pandas = package("pandas", "to_pandas")

        columns = {}
        for name in names or self.sensors:
            curve = self[name]
            table = np.asarray(curve).reshape(len(curve), -1)
            labels = [f"{name}.{c}" for c in curve.components] if curve.components else (
                [name] if table.shape[1] == 1 else [f"{name}.{i}" for i in range(table.shape[1])])
            columns.update({label: table[:, i] for i, label in enumerate(labels)})
        return pandas.DataFrame(columns, index=pandas.Index(np.asarray(self.time), name="t"))

    def to_xarray(self) -> Any:
        """Returns an xarray.Dataset of the sensors over time, with units."""
        xarray = package("xarray", "to_xarray")
        out = xarray.Dataset(coords={"t": ("t", np.asarray(self.time), {"units": "s"})})
        for name in self.sensors:
            curve = self[name]
            extents = ["t"] + [f"{name}_{i}" for i in range(curve.ndim - 1)]
            out[name] = (extents, np.asarray(curve), {"units": curve.unit})
        return out

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Plots sensors over time with matplotlib and returns the axes.

        Parameters
        ----------
        *names
            As for :meth:`to_pandas`.
        axes
            Axes of matplotlib to draw into; by default those of a new figure.
        """
        if axes is None:
            axes = package("matplotlib.pyplot", "plot").subplots()[1]
        time = np.asarray(self.time)
        units = []
        for name in names or self.sensors:
            curve = self[name]
            units.append(curve.unit)
            table = np.asarray(curve).reshape(len(time), -1)
            for i in range(table.shape[1]):
                part = curve.components[i] if i < len(curve.components) else str(i)
                axes.plot(time, table[:, i], label=name if table.shape[1] == 1 else f"{name}.{part}")
        axes.set_xlabel("t [s]")
        axes.set_ylabel(", ".join(f"[{unit}]" for unit in dict.fromkeys(units)))
        axes.legend()
        axes.set_title(self.title)
        return axes

    def view(self) -> RunPage:
        """Writes a page that shows the run, or what it has recorded so far, and returns its path.

        A notebook displays the page below the cell.
        """
        return RunPage(write_page(self.directory)["page"])

    def _repr_html_(self) -> str:
        """Returns the page for display in a notebook; a text as long as nothing is recorded."""
        if not len(self.time):
            return html.escape(f"{self.title}: no records yet in {self.directory} ({self.status})")
        with tempfile.TemporaryDirectory(prefix="buckens-") as folder:
            page = os.path.join(folder, "view.html")
            write_page(self.directory, page)
            return RunPage(page)._repr_html_()

    def __repr__(self) -> str:
        return f"<buckens.Results {str(self.directory)!r}: {self.title!r}, {self.status}>"


def open(directory: PathLike) -> Results:  # noqa: A001 (the name says what it does)
    """Opens a run directory for reading.

    Parameters
    ----------
    directory
        The ``out`` of a :class:`buckens.Simulation`, of :func:`buckens.run` or of the program; the run may be in progress.

    Raises
    ------
    IoError
        If the directory has no results.
    """
    return Results(directory)


def open_text(path: pathlib.Path) -> Any:
    """Opens a file as UTF-8 text."""
    return path.open(encoding="utf-8")


def _text(value: Any) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _row_at(t: float, times: Any, what: str) -> int:
    """The row of the record next to a time, which lies at most half an interval outside of them."""
    if not len(times):
        raise InputError(f"t = {t:.9g} s: nothing is recorded yet")
    # A single record is found by its own time, to rounding.
    before, after = (0.5 * (times[1] - times[0]), 0.5 * (times[-1] - times[-2])) if len(times) > 1 else (0.0, 0.0)
    rounding = 1e-9 * abs(times[-1])
    if not times[0] - before - rounding <= t <= times[-1] + after + rounding:
        raise InputError(f"t = {t:.9g} s: {what} span t = {times[0]:.6g} s to {times[-1]:.6g} s; give a time between them")
    return int(np.argmin(np.abs(times - t)))


def _is_recorded(path: str) -> bool:
    return path != "time" and path.split("/")[0] not in ("fields", "extremes", "geometry")


def _is_dataset(item: Any) -> bool:
    return hasattr(item, "dtype")


def _datasets(file: Any) -> List[str]:
    out: List[str] = []
    file.visititems(lambda path, item: out.append(path) if _is_dataset(item) else None)
    return out


def _nearest(name: str, known: List[str]) -> str:
    """A hint at the name that is most alike, or all of them."""
    near = difflib.get_close_matches(name, known, 1)
    return f"did you mean {near[0]!r}?" if near else f"there are {', '.join(known)}"

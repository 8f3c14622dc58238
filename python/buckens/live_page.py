# SPDX-License-Identifier: Apache-2.0
"""A page that follows a running simulation, served by the program in a separate process."""

from __future__ import annotations

import json
import subprocess
import webbrowser
import weakref
from typing import Sequence

from .errors import Error, IoError
from .program import answer_of, find_program


class LivePage:
    """A page being served.

    Serving ends with :meth:`close`, at the end of a ``with`` block, when this object is deleted, when Python
    exits, or with Ctrl-C.

    Attributes
    ----------
    address : str
        URL for the browser. It contains a secret and is reachable from this machine only; nothing else is served.
    """

    def __init__(self, arguments: Sequence[str]) -> None:
        command = [find_program(), "view", *arguments, "--live", "--json"]
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                         stdin=subprocess.DEVNULL, text=True)
        self._end = weakref.finalize(self, _end, self._process)
        try:
            self.address = self._read_address()
        except BaseException:
            self.close()
            raise

    def _read_address(self) -> str:
        """What the program prints before it serves; its error if it does not come to that."""
        assert self._process.stdout is not None
        text = ""
        for line in self._process.stdout:
            text += line
            address = _address_in(text)
            if address:
                return address
        out, err = self._process.communicate()
        answer_of(self._process.returncode, text + out, err)
        raise Error(f"the program reported no address: {text}")

    @property
    def is_open(self) -> bool:
        """Whether the page is still served."""
        return self._process.poll() is None

    def open(self) -> None:
        """Opens the page in the browser.

        Raises
        ------
        IoError
            If no browser is available.
        """
        if not webbrowser.open(self.address):
            raise IoError(f"{self.address}: no browser could be started; open this address in one")

    def close(self) -> None:
        """Stops serving; further calls have no effect."""
        self._end()

    def __enter__(self) -> LivePage:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<buckens.LivePage {self.address if self.is_open else 'closed'}>"


def _address_in(text: str) -> str:
    """Empty as long as the text is not the whole answer, or if that is an error."""
    try:
        return str(json.loads(text).get("address", ""))
    except ValueError:
        return ""


def _end(process: subprocess.Popen[str]) -> None:
    """As Ctrl-C does: it completes what it answers; what cannot be ended so is killed."""
    if process.poll() is None:
        process.terminate()
    try:
        process.communicate(timeout=10)
    except (subprocess.TimeoutExpired, ValueError):
        process.kill()
        process.wait()

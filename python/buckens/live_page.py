# SPDX-License-Identifier: Apache-2.0
"""A page that follows a run while it goes on, served by the program in a process of its own."""

from __future__ import annotations

import json
import subprocess
import webbrowser
import weakref
from typing import Sequence

from .errors import Error, IoError
from .program import answer_of, find_program


class LivePage:
    """A served page. It ends with :meth:`close`, a ``with`` block, this object, Python, or Ctrl-C.

    Attributes
    ----------
    address : str
        For the browser. It holds a secret, reaches this machine only, and nothing else is served there.
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
        """Whether it is still served."""
        return self._process.poll() is None

    def open(self) -> None:
        """Opens it in the browser.

        Raises
        ------
        IoError
            If no browser can be started.
        """
        if not webbrowser.open(self.address):
            raise IoError(f"{self.address}: no browser could be started; open this address in one")

    def close(self) -> None:
        """Ends it; once more does nothing."""
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

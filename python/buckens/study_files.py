# SPDX-License-Identifier: Apache-2.0
"""Contents of files that only variants name, such as a mesh per variant: whether a result still belongs to them."""

from __future__ import annotations

from typing import Any, Dict, Optional

from . import _core


class FileContents:
    """Hashes of files by path, each as it was when first asked for."""

    def __init__(self) -> None:
        self._known: Dict[str, str] = {}

    def of(self, path: str) -> str:
        """Returns the hash of a file; an empty one if it cannot be read."""
        if path not in self._known:
            self._known[path] = _core.file_content(path)
        return self._known[path]

    def changed_since(self, row: Dict[str, Any]) -> Optional[str]:
        """Returns a file that had another content when a variant read it; None if there is none."""
        return next((path for path, content in row.get("files", {}).items() if self.of(path) != content), None)

# SPDX-License-Identifier: Apache-2.0
"""What the library says goes to the logger "buckens"."""

from __future__ import annotations

import logging

from . import _core

logger = logging.getLogger("buckens")
_LEVELS = (logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR)


def tell_messages() -> None:
    """Hands over what the library has said since the last call."""
    for level, text in _core.take_messages():
        logger.log(_LEVELS[level], text)

# SPDX-License-Identifier: Apache-2.0
"""Passes library messages to the logger "buckens"."""

from __future__ import annotations

import logging

from . import _core

logger = logging.getLogger("buckens")
_LEVELS = (logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR)


def tell_messages() -> None:
    """Logs the messages of the library since the last call."""
    for level, text in _core.take_messages():
        logger.log(_LEVELS[level], text)

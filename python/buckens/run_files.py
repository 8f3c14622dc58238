# SPDX-License-Identifier: Apache-2.0
"""Files in the directory of a run that Python writes or looks for."""

from __future__ import annotations

import os

from .errors import IoError
from .model import Model


def keep_files(model: Model, out: str) -> None:
    """Writes meshes and matrices given as arrays to the run directory, and their names to its model.yaml."""
    path = os.path.join(out, "model.yaml")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    with open(path, "w", encoding="utf-8") as file:
        file.write(model._files.write_beside(out, text, is_absolute=True))


def kept_text(model: Model, out: str) -> str:
    """Returns the model as text for a directory, which gets the meshes and matrices given as arrays."""
    return model._files.write_beside(out, model.to_yaml(), is_absolute=True)


def checkpoint_of(directory: str) -> str:
    """Returns the file from which a run goes on."""
    path = os.path.join(directory, "checkpoint.h5")
    if os.path.isfile(path):
        return path
    if not os.path.isfile(os.path.join(directory, "summary.json")):
        raise IoError(f"{directory}: not a run directory; expected a directory that buckens.Simulation(model, out=...), "
                      "buckens.run or the program has written")
    raise IoError(f"{directory}: there is no checkpoint to continue from: the run ended before its first one, or the model "
                  "says `checkpoint: off`. Run the model from the start; simulation.checkpoint is the time between checkpoints")

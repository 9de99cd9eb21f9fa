"""Values of a message with names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.recordings.bag import Bag


def named_values(bag: Bag, message: Any, given: Array, wanted: Sequence[str], finite: bool = True) -> Array:
    """Return the values of the ``wanted`` names, in their order, from those ``given`` for ``message.name``.

    Raises:
        FileError: a name is missing, the numbers of values and names differ, or a value is not finite but has to be.
    """
    if len(given) != len(message.name):
        raise FileError(bag.path, f"has a message with {len(given)} values for {len(message.name)} names")
    by_name = dict(zip(message.name, given, strict=True))
    for name in wanted:
        if name not in by_name:
            raise FileError(bag.path, f"holds no {name}; recorded with another arm? It has {list(message.name)}")
        if finite and not np.isfinite(by_name[name]):
            raise FileError(bag.path, f"has a message with {by_name[name]} for {name}")
    return np.array([by_name[name] for name in wanted], dtype=float)

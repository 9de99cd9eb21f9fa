"""Values of a message that names what they belong to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from continuum.arrays import Array
from continuum.errors import FileError
from continuum.recordings.bag import Bag


def named_values(bag: Bag, message: Any, given: Array, wanted: Sequence[str], finite: bool = True) -> Array:
    """Of the values ``given`` for ``message.name`` those of the names ``wanted``, in their order.

    Raises:
        FileError: a name is not there, or there are more or fewer values than names, or one is not finite where all
            have to be.
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

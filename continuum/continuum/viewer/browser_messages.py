"""Messages that a browser may send to the page; the server itself would accept others as well."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from typing import Annotated, Any

import msgspec

from continuum.errors import ContinuumError

LONGEST = 2**14
"""Largest size of a message [bytes]; the largest that a page sends, that of a camera, has about three hundred."""

_Text = Annotated[str, msgspec.Meta(max_length=200)]
_Vector = tuple[float, float, float]
_Quaternion = tuple[float, float, float, float]


class BrowserMessageError(ContinuumError):
    """A browser sent a message that no page sends."""


class _Form(msgspec.Struct, forbid_unknown_fields=True, tag_field="type"):
    """Message that has all of its fields and no others."""


class _Value(msgspec.Struct, forbid_unknown_fields=True):
    """Only the value of an input may be changed; the server would also let a browser remove the input."""

    value: bool | float | _Text


class _Input(_Form, tag="GuiUpdateMessage"):
    uuid: _Text
    updates: _Value


class _Camera(_Form, tag="ViewerCameraMessage"):
    wxyz: _Quaternion
    position: _Vector
    fov: float
    near: float
    far: float
    image_height: int
    image_width: int
    look_at: _Vector
    up_direction: _Vector


class _Target(_Form, tag="TransformControlsUpdateMessage"):
    name: _Text
    wxyz: _Quaternion
    position: _Vector
    owner: _Text = ""


class _DragStart(_Form, tag="TransformControlsDragStartMessage"):
    name: _Text
    owner: _Text = ""


class _DragEnd(_Form, tag="TransformControlsDragEndMessage"):
    name: _Text
    owner: _Text = ""


class _Command(_Form, tag="CommandTriggerMessage"):
    """A pressed key; the server identifies its commands by ``uuid``."""

    uuid: _Text


_DECODER = msgspec.msgpack.Decoder(_Input | _Camera | _Target | _DragStart | _DragEnd | _Command)


def check_browser_message(data: bytes | str, words: Collection[str]) -> None:
    """Check that a message has a permitted form, finite numbers, and words that the page offers.

    Args:
        data: the message.
        words: words that the page offers in its inputs.

    Raises:
        BrowserMessageError: the message is not permitted.
    """
    if isinstance(data, str):
        raise BrowserMessageError("text; allowed: MessagePack")
    try:
        message = _DECODER.decode(data)
    except msgspec.DecodeError as error:
        raise BrowserMessageError(str(error)) from error
    if isinstance(message, _Input) and isinstance(word := message.updates.value, str) and word not in words:
        raise BrowserMessageError(f"{word!r}; allowed: {', '.join(sorted(words))}")
    for number in _numbers(msgspec.to_builtins(message)):
        if not math.isfinite(number):
            raise BrowserMessageError(f"{type(message).__name__.strip('_').lower()}: {number}; allowed: finite numbers")


def _numbers(value: Any) -> Iterator[float]:
    if isinstance(value, float):
        yield value
    elif isinstance(value, dict):
        for part in value.values():
            yield from _numbers(part)
    elif isinstance(value, (tuple, list)):
        for part in value:
            yield from _numbers(part)

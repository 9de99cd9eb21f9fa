"""What a browser may say to the page: the forms of its messages, and nothing else of what the server would take."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from typing import Annotated, Any

import msgspec

from continuum.errors import ContinuumError

LONGEST = 2**14
"""Of a message [bytes]; the longest that a page sends, of a camera, has some three hundred."""

_Text = Annotated[str, msgspec.Meta(max_length=200)]
_Vector = tuple[float, float, float]
_Quaternion = tuple[float, float, float, float]


class BrowserMessageError(ContinuumError):
    """A message of a browser is none that a page sends."""


class _Form(msgspec.Struct, forbid_unknown_fields=True, tag_field="type"):
    """All fields of a message, and no others."""


class _Value(msgspec.Struct, forbid_unknown_fields=True):
    """What alone of an input may be changed; the server would let a browser remove it, too."""

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
    """Of a key; the server knows its commands by their identity."""

    uuid: _Text


_DECODER = msgspec.msgpack.Decoder(_Input | _Camera | _Target | _DragStart | _DragEnd | _Command)


def check_browser_message(data: bytes | str, words: Collection[str]) -> None:
    """See that a message has the form of one that a page sends, finite numbers, and words that there are to choose.

    Args:
        data: the message.
        words: that may be chosen anywhere on the page.

    Raises:
        BrowserMessageError: it has not.
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

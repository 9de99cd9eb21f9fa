"""Consistent overhead byte stuffing: encode bytes without zeros, so that a zero on the line always marks an end.

S. Cheshire and M. Baker, Consistent Overhead Byte Stuffing, IEEE/ACM Trans. Networking 7(2), 1999. The data are split
at their zeros. Each piece follows its length plus one; a piece of 254 bytes is not followed by a zero in the data.
"""

from __future__ import annotations

_LONGEST_PIECE = 254


def encoded(data: bytes) -> bytes:
    """Return ``data`` without zeros: one byte longer, plus one byte for each full 254 bytes without a zero."""
    coded = bytearray()
    pieces = data.split(b"\0")
    for piece in pieces[:-1]:
        coded += _full_pieces(piece)
        rest = piece[len(piece) - len(piece) % _LONGEST_PIECE :]
        coded.append(len(rest) + 1)
        coded += rest
    last = pieces[-1]
    coded += _full_pieces(last)
    rest = last[len(last) - len(last) % _LONGEST_PIECE :]
    if rest or not last:  # data that end with a full piece need no further byte
        coded.append(len(rest) + 1)
        coded += rest
    return bytes(coded)


def decoded(coded: bytes) -> bytes | None:
    """Return the decoded data; None if ``coded`` is not a result of `encoded`."""
    data = bytearray()
    at, size = 0, len(coded)
    if size == 0:
        return None
    while at < size:
        code = coded[at]
        end = at + code
        if code == 0 or end > size:
            return None
        data += coded[at + 1 : end]
        if code <= _LONGEST_PIECE and end < size:
            data.append(0)
        at = end
    return bytes(data) if b"\0" not in coded else None


def _full_pieces(piece: bytes) -> bytes:
    """Return the pieces of 254 bytes at the start of ``piece``, each after its length."""
    full = len(piece) // _LONGEST_PIECE
    return b"".join(b"\xff" + piece[k * _LONGEST_PIECE : (k + 1) * _LONGEST_PIECE] for k in range(full))

"""Title of the page in the browser; the page of viser has a fixed title in the HTML that it serves."""

from __future__ import annotations

import gzip
import html
import re
from collections.abc import Callable

from websockets.http11 import Response

_TITLE = re.compile(rb"<title>[^<]*</title>")


def titled(title: str) -> Callable[[Response | None], Response | None]:
    """Return a function that sets ``title`` in responses that are pages and leaves others unchanged.

    Modified pages are cached: they are the same for all browsers that accept the same compression.
    """
    element = f"<title>{html.escape(title)}</title>".encode()
    done: dict[bytes, bytes] = {}

    def put(response: Response | None) -> Response | None:
        if response is None or not response.headers.get("Content-Type", "").startswith("text/html"):
            return response
        body = bytes(response.body)
        if body not in done:
            zipped = response.headers.get("Content-Encoding") == "gzip"
            page = gzip.decompress(body) if zipped else body
            page = _TITLE.sub(lambda _: element, page, count=1)
            done[body] = gzip.compress(page) if zipped else page
        response.body = done[body]
        del response.headers["Content-Length"]
        response.headers["Content-Length"] = str(len(response.body))
        return response

    return put

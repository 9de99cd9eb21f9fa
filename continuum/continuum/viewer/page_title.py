"""The browser's title of the page: viser's page has its own in the text that it serves."""

from __future__ import annotations

import gzip
import html
import re
from collections.abc import Callable

from websockets.http11 import Response

_TITLE = re.compile(rb"<title>[^<]*</title>")


def titled(title: str) -> Callable[[Response | None], Response | None]:
    """Return a function that puts ``title`` into responses that are pages and leaves others as they are.

    The last page is remembered: it is the same for all browsers that take the same compression.
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

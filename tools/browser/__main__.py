"""``python3 -m tools.browser``: fetch what is missing; where that cannot be done, say why, and succeed all the same."""

from __future__ import annotations

import sys

from tools.browser.debian_chromium import NoChromiumError, fetch
from tools.browser.place import chromium


def main() -> int:
    """Fetch Chromium unless there is one."""
    if chromium() is None:
        try:
            fetch()
        except NoChromiumError as error:
            print(f"no Chromium ({error}): the browser tests are skipped", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())

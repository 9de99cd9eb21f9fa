"""`make prototype`: diagnose the real arm by the one run of it that was published; docs/prototype.md and its picture.

Overwrites these files, which are under version control, unless `--out` names another folder.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from continuum.cli.progress import progress_bar
from continuum.discovery.words import verdict_in_words
from continuum.whole_file import write_whole
from tools.one_line import in_one_line
from tools.prototype.account import account
from tools.prototype.page import page
from tools.prototype.picture import draw
from tools.small_png import shrink


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--out", type=Path, default=Path("docs"), help="folder of page and picture; default %(default)s"
    )
    options = parser.parse_args()
    with progress_bar() as tell:
        found = account(tell)
    picture = options.out / "pictures" / "prototype.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    draw(found, picture)
    shrink(picture)
    write_whole(options.out / "prototype.md", page(found))
    print(f"{verdict_in_words(found.diagnosis)}\n\nwritten: {options.out / 'prototype.md'}")


if __name__ == "__main__":
    sys.exit(in_one_line(main))

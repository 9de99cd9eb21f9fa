"""`make prototype`: diagnose the real arm from its only published run; docs/prototype.md and its picture.

Writes its record and overwrites these files, unless `--out` names another folder.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from continuum.cli.progress import progress_bar
from continuum.discovery.words import verdict_in_words
from continuum.whole_file import write_whole
from tools.benchmarks.prototype.account import account
from tools.benchmarks.prototype.figures import record_of
from tools.benchmarks.prototype.page import page
from tools.benchmarks.prototype.picture import draw
from tools.benchmarks.report import DOCS, publish
from tools.docs.small_png import shrink
from tools.one_line import in_one_line


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=DOCS, help="folder of page and picture; default %(default)s")
    options = parser.parse_args()
    with progress_bar() as tell:
        found = account(tell)
    picture = options.out / "pictures" / "prototype.png"
    picture.parent.mkdir(parents=True, exist_ok=True)
    draw(found, picture)
    shrink(picture)
    write_whole(options.out / "prototype.md", page(found))
    print(f"{verdict_in_words(found.diagnosis)}\n\nwritten: {options.out / 'prototype.md'}")
    publish(record_of(found), options.out)


if __name__ == "__main__":
    sys.exit(in_one_line(main))

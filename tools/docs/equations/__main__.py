"""`make equations`: look up the names in the rows, and write docs/equations.md.

Overwrites this file, which is under version control, unless `--out` names another.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from continuum.whole_file import write_whole
from tools.docs.equations.lookup import check_rows
from tools.docs.equations.page import page
from tools.docs.equations.rows import read_rows
from tools.one_line import in_one_line


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("docs/equations.md"), help="default: %(default)s")
    out: Path = parser.parse_args().out
    rows = read_rows()
    check_rows(rows)
    write_whole(out, page(rows))
    print(f"{len(rows)} rows; written: {out}")


if __name__ == "__main__":
    sys.exit(in_one_line(main))

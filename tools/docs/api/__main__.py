"""`make api`: write the reference of the library, and check its links."""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path

from tools.docs.api.links import problems
from tools.docs.api.reference import modules_of, write_reference


def main(arguments: list[str] | None = None) -> int:
    """Write the pages; return 1 if a link is broken or a page loads an external resource."""
    parser = argparse.ArgumentParser(prog="make api ARGS=...", description=__doc__)
    parser.add_argument("--package", default="continuum", metavar="NAME", help="default: %(default)s")
    parser.add_argument("--out", type=Path, default=Path("out/api"), metavar="FOLDER", help="default: %(default)s")
    options = parser.parse_args(arguments)
    shutil.rmtree(options.out, ignore_errors=True)
    modules = modules_of(options.package)
    write_reference(modules, options.out)
    found = problems(options.out)
    for line in found:
        print(f"api: {line}", file=sys.stderr)
    print(f"{len(modules)} modules; written: {options.out / 'index.html'}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

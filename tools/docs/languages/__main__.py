"""`make languages`: bring every catalogue up to date with the code, compile it, and name what is not translated yet."""

from __future__ import annotations

import sys

from continuum.whole_file import write_whole
from tools.docs.languages.catalogue import FOLDER, as_text, compiled, updated


def main() -> int:
    """Return 1 if a catalogue lacks a translation."""
    missing = 0
    for path in sorted(FOLDER.glob("*.po")):
        catalogue = updated(path)
        write_whole(path, as_text(catalogue))
        write_whole(path.with_suffix(".mo"), compiled(catalogue))
        absent = [one.id for one in catalogue if one.id and not (one.string and all(one.string))]
        missing += len(absent)
        print(f"{path.name}: {len(catalogue)} sentences, {len(absent)} without a translation")
        for one in absent:
            print(f"  {one if isinstance(one, str) else one[0]}")
    return int(missing > 0)


if __name__ == "__main__":
    sys.exit(main())

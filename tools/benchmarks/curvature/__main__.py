"""Coverage of the intervals of joint angles, and correctness of the nearer model; takes 3 minutes.

    PYTHONPATH="test:$PYTHONPATH" python3 -m tools.benchmarks.curvature

Writes its record, and overwrites the table of docs/curvature.md, unless another number of holds is given.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence

import numpy as np

from continuum.curvature.comparison import LEVEL, Nearer
from continuum.dynamics.model_file import load_model
from tools.benchmarks.curvature.plant_holds import PLANTS, KnownHold, known_holds
from tools.benchmarks.record import Figure, Record, Table
from tools.benchmarks.report import as_text, publish
from tools.one_line import in_one_line

HOLDS = 200
HEAD = ("plant, sensors", "holds", "true angle inside", "true difference inside", "right", "wrong", "undecided")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--holds", type=int, default=HOLDS, help="of each plant; default %(default)s")
    options = parser.parse_args()
    model = load_model("lamecc_prototype.yaml")
    found = {name: known_holds(name, model, options.holds) for name in PLANTS}
    record = record_of(found)
    print(as_text(record))
    if options.holds == HOLDS:
        publish(record)


def record_of(found: Mapping[str, Sequence[KnownHold]]) -> Record:
    """Return the record of the holds by plant."""
    rows = [row for name, holds in found.items() for row in rows_of(name, holds)]
    figures = [figure for name, holds in found.items() for figure in _figures(name, holds)]
    return Record("curvature", "make bench-curvature", tuple(figures), {"holds": Table.of(HEAD, rows)})


def _figures(name: str, holds: Sequence[KnownHold]) -> tuple[Figure, Figure]:
    inside = 100 * float(np.mean([hold.inside for hold in holds]))
    wrong = 100 * sum(hold.found.nearer not in (Nearer.UNDECIDED, _truly(hold)) for hold in holds) / len(holds)
    plant, n = f"holds of the plant {name}", len(holds)
    return (
        Figure(f"{plant}: true joint angle inside its 95 % interval", inside, "%", at_least=90, at_most=98, n=n),
        Figure(f"{plant}: the model called nearer is not", wrong, "%", at_most=2.5, n=n),
    )


def rows_of(name: str, holds: Sequence[KnownHold]) -> list[list[str]]:
    """Return rows for all holds of a plant, then for each level of noise, and for those before releases."""
    parts = {f"{name}, all": list(holds)}
    parts |= {f"{name}, {level} noise": [h for h in holds if h.level == level] for level in ("low", "ordinary", "high")}
    parts[f"{name}, before a release"] = [h for h in holds if h.released]
    return [_row(title, some) for title, some in parts.items() if some]


def _row(title: str, holds: Sequence[KnownHold]) -> list[str]:
    inside = np.mean([hold.inside for hold in holds])
    decided = [hold for hold in holds if hold.found.nearer is not Nearer.UNDECIDED]
    right = sum(hold.found.nearer is _truly(hold) for hold in decided)
    covered = np.mean([_difference_covered(hold) for hold in holds])
    counts = (right, len(decided) - right, len(holds) - len(decided))
    return [title, str(len(holds)), f"{100 * inside:.1f} %", f"{100 * covered:.1f} %", *map(str, counts)]


def _truly(hold: KnownHold) -> Nearer:
    return Nearer.DYNAMIC if hold.truly.difference[0] < 0 else Nearer.CONSTANT


def _difference_covered(hold: KnownHold) -> bool:
    """Return whether the true difference of the squared distances is in its interval."""
    found, sensitivities = hold.found.difference
    sd = float(np.sqrt(sensitivities @ hold.found.covariance @ sensitivities))
    return abs(found - hold.truly.difference[0]) <= LEVEL * sd


if __name__ == "__main__":
    sys.exit(in_one_line(main))

"""Recordings of the DFKI's double pendulum (../shared/data/double_pendulum) in the columns that `diagnose` reads.

    python3 -m tools.benchmarks.exams.double_pendulum_csv run_00.csv pendulum_00.csv
    python3 -m tools.benchmarks.exams.double_pendulum_csv run_00.csv pendulum_00.csv --torque measured commanded

Its tables have the time, angles and rates in the form that `diagnose` reads, and two torques of each joint:
``tau_commanded_1_Nm`` .. and ``tau_measured_1_Nm`` .., from the motors' currents. One of them becomes ``tau1_Nm`` ..,
unchanged, by default the measured one; ``--torque`` selects one for both joints, or one for each. The measured torque
has the sign of the command, positive towards positive angles, and lags by about 20 ms at joint 2. Its unit is newton
metres: a fit to 0.4 s windows of run_00.csv with a free scale of each torque gives 0.97 for both, with Coulomb friction
of 0.15 and 0.12 N m; the makers give 0.16 and 0.12.
"""

from __future__ import annotations

import argparse
import csv
import sys
from collections.abc import Sequence
from pathlib import Path

from continuum.errors import ContinuumError, FileError, InvalidValueError
from continuum.output_files import check_apart
from continuum.recordings.motion_columns import TIME, torque_column
from continuum.whole_file import write_table

JOINTS = (1, 2)
KEPT = (TIME, "q1_rad", "q2_rad", "dq1_rad_s", "dq2_rad_s")
TORQUES = ("measured", "commanded")


def convert(source: Path, target: Path, torques: Sequence[str] = TORQUES[:1]) -> None:
    """Write the table ``source`` as a recording.

    Args:
        source, target: files.
        torques: ``measured`` or ``commanded``, one for both joints or one for each.

    Raises:
        InvalidValueError: a torque is unknown, or their number matches no joints.
        FileError: the source cannot be read or lacks a column, or the target cannot be written.
    """
    if len(torques) not in (1, len(JOINTS)) or not set(torques) <= set(TORQUES):
        allowed = f"{' or '.join(TORQUES)}, one for both joints or one for each"
        raise InvalidValueError("torque", " ".join(torques), allowed)
    check_apart([target], [source])
    of_joints = torques if len(torques) > 1 else [*torques] * len(JOINTS)
    names = dict(zip(KEPT, KEPT, strict=True))
    names |= {f"tau_{torque}_{j}_Nm": torque_column(j) for j, torque in zip(JOINTS, of_joints, strict=True)}
    try:
        with source.open(newline="", encoding="utf-8-sig") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise FileError(source, f"cannot be read ({error})") from error
    known = list(rows[0]) if rows else []
    for name in names:
        if name not in known:
            raise FileError(source, f"has no column {name}; it has {', '.join(map(str, known)) or 'no rows'}")
    write_table(target, [names.values(), *([row[name] for name in names] for row in rows)])


def main(arguments: Sequence[str] | None = None) -> int:
    """Convert one table; return 2 if this is impossible."""
    parser = argparse.ArgumentParser(prog="python3 -m tools.benchmarks.exams.double_pendulum_csv", description=__doc__)
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.add_argument("source", type=Path, help="table of the double pendulum")
    parser.add_argument("target", type=Path, help="recording to be written")
    parser.add_argument(
        "--torque", choices=TORQUES, default=TORQUES[:1], nargs="+",
        help=f"which torques, one for both joints or one for each; default {TORQUES[0]}",
    )  # fmt: skip
    options = parser.parse_args(arguments)
    try:
        convert(options.source, options.target, options.torque)
    except ContinuumError as error:
        print(error, file=sys.stderr)
        return 2
    print(f"written: {options.target}")
    return 0


if __name__ == "__main__":
    sys.exit(main())

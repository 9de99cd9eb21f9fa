"""`cable_states` as a CSV table: time, lengths and rates of all cables."""

from __future__ import annotations

from pathlib import Path

from continuum.recordings.arm_recording import ArmRecording
from continuum.whole_file import write_table


def write_cable_table(recording: ArmRecording, path: str | Path) -> None:
    """Write ``t_s``, then ``<cable>_m`` and ``<cable>_m_s`` of every cable, one row for every stamp.

    Times count from the first stamp; an unknown rate is ``nan``.

    Raises:
        FileError: the file cannot be written.
    """
    names = recording.arm.cable_names
    times = (recording.lengths.stamps - recording.lengths.stamps[0]) * 1e-9
    head = ["t_s", *(f"{name}_m" for name in names), *(f"{name}_m_s" for name in names)]
    rows = zip(times, recording.lengths.values, recording.rates.values, strict=True)
    write_table(
        path, [head, *([f"{t:.9f}", *(f"{value:.9g}" for value in (*lengths, *rates))] for t, lengths, rates in rows)]
    )

"""Resource usage of a process, as counted by the kernel."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.arrays import Array


@dataclass(frozen=True)
class Usage:
    """Resource usage of a process so far.

    Attributes:
        at: monotonic time [s].
        seconds: processor time of all threads [s].
        memory: resident memory [KiB].
    """

    at: float
    seconds: float
    memory: int


def usage(process: int) -> Usage:
    """Return the usage of a process by its id."""
    fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    ticks = int(fields[11]) + int(fields[12])  # utime, stime
    status = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    memory = int(status.split("VmRSS:")[1].split()[0])
    return Usage(time.monotonic(), ticks / os.sysconf("SC_CLK_TCK"), memory)


def take_niceness(niceness: int) -> None:
    """Set the niceness, -20 to 19, of this process and its children, unless it is set already.

    Linux distributes processors among sessions first (autogroups), so the niceness is also set for the session.
    """
    if niceness == os.getpriority(os.PRIO_PROCESS, 0):
        return
    os.setpriority(os.PRIO_PROCESS, 0, niceness)
    group = Path("/proc/self/autogroup")
    if group.exists():
        group.write_text(str(niceness), encoding="ascii")


def core_share(before: Usage, after: Usage) -> float:
    """Return the fraction of one core used in between."""
    return (after.seconds - before.seconds) / (after.at - before.at)


def slope(times: Array, values: Array) -> float:
    """Return the slope of the least-squares line through values at times."""
    return float(np.polyfit(times - times[0], values, 1)[0])

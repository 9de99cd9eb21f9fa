"""What a process takes of the machine, as the kernel counts it."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from continuum.arrays import Array


@dataclass(frozen=True)
class Usage:
    """Up to now.

    Attributes:
        at: monotonic time [s].
        seconds: processor time, of all threads [s].
        memory: resident [KiB].
    """

    at: float
    seconds: float
    memory: int


def usage(process: int) -> Usage:
    """Of a process by its number."""
    fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    ticks = int(fields[11]) + int(fields[12])  # utime, stime
    status = Path(f"/proc/{process}/status").read_text(encoding="utf-8")
    memory = int(status.split("VmRSS:")[1].split()[0])
    return Usage(time.monotonic(), ticks / os.sysconf("SC_CLK_TCK"), memory)


def take_niceness(niceness: int) -> None:
    """Give this process, and so those that it will start, a niceness from -20 to 19, if it has not that already.

    Linux shares the processors out among sessions first (autogroups), so this one's session gets it too.
    """
    if niceness == os.getpriority(os.PRIO_PROCESS, 0):
        return
    os.setpriority(os.PRIO_PROCESS, 0, niceness)
    group = Path("/proc/self/autogroup")
    if group.exists():
        group.write_text(str(niceness), encoding="ascii")


def core_share(before: Usage, after: Usage) -> float:
    """Part of one core that was taken in between."""
    return (after.seconds - before.seconds) / (after.at - before.at)


def slope(times: Array, values: Array) -> float:
    """Of the straight line nearest to values at times."""
    return float(np.polyfit(times - times[0], values, 1)[0])

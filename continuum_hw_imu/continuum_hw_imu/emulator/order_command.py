"""`ros2 run continuum_hw_imu bench_order "unplug for=2"`: send orders to a running emulator. Needs no ROS."""

from __future__ import annotations

import argparse
import json
import socket
import sys
from collections.abc import Callable
from pathlib import Path

from continuum_hw_imu.emulator.orders import in_words

_CONTROL = Path("/tmp/continuum_bench_control")  # noqa: S108  (default of the launch file; nothing is written there)

_PATIENCE = 10.0
"""Longest wait for an answer [s]."""


def main() -> int:
    """Send each order and print its answer; return 0 if all were accepted, 1 if not, 2 without an emulator."""
    options = _parser().parse_args()
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as line:
            line.settimeout(_PATIENCE)
            line.connect(str(options.control))
            answers = line.makefile("r", encoding="utf-8")
            taken = [_given(order, line, answers.readline) for order in options.orders]
    except OSError as error:
        reason = error.strerror or "no answer"
        print(f"bench_order: error: {options.control}: {reason}; is the emulator running?", file=sys.stderr)
        return 2
    return 0 if all(taken) else 1


def _given(order: str, line: socket.socket, answer: Callable[[], str]) -> bool:
    line.sendall(f"{order}\n".encode())
    said = answer()
    print(said.strip())
    return bool(json.loads(said)["ok"]) if said else False


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="bench_order",
        description="Sends orders to a running bench_emulator and prints its answers.",
        epilog=f"orders:\n{in_words()}\nstatus: report the state\n",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("orders", nargs="+", metavar="ORDER", help='for example "unplug for=2"')
    parser.add_argument(
        "--control", type=Path, default=_CONTROL, metavar="PATH",
        help="the emulator's socket; default %(default)s, that of bench.launch.py",
    )  # fmt: skip
    return parser

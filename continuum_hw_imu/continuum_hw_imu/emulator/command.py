"""`ros2 run continuum_hw_imu bench_emulator`: options and main loop of the emulator. Needs no ROS."""

from __future__ import annotations

import argparse
import math
import select
import sys
import time
from collections.abc import Callable
from pathlib import Path

from continuum.dynamics.model_file import load_model
from continuum.errors import ContinuumError, FileError
from continuum.output_files import check_apart
from continuum_hw_imu.emulator.bench import Bench, BenchSettings
from continuum_hw_imu.emulator.control import ControlSocket
from continuum_hw_imu.emulator.emulator import Emulator, EmulatorSettings
from continuum_hw_imu.emulator.order_book import OrderBook
from continuum_hw_imu.emulator.orders import Order, in_words, read_orders
from continuum_hw_imu.protocol.messages import ReceiverLimits
from continuum_hw_imu.sensor_quality import SensorQuality
from continuum_manipulator.nodekit.run import BAD_START, StopRequest

_EPILOG = f"""\
orders for --faults FILE and --control PATH, one per line; a prefix "at SECONDS" sets the time since the start:
{in_words()}
The value after = is the default; ? must be given. "status" over the socket reports the state. For example:
  at 10 lose share=0.2 for=3        at 20 unplug for=2        at 30 hand bend=90 over=1 hold=2
"""


def main() -> int:
    """Run until SIGINT or SIGTERM, and return the exit code."""
    with StopRequest() as stop:
        arguments = sys.argv[1:]
        if "--ros-args" in arguments:  # which a launch file adds
            arguments = arguments[: arguments.index("--ros-args")]
        options = _parser().parse_args(arguments)
        try:
            _run(options, stop)
        except ContinuumError as error:
            print(f"bench_emulator: error: {error}", file=sys.stderr)
            return int(BAD_START)
    return 0


def _run(options: argparse.Namespace, stop: StopRequest) -> None:
    check_apart((options.truth, options.sent), (options.faults, options.model))
    orders = _script(options.faults)
    bench = Bench(load_model(options.model), _bench_settings(options))
    now = time.monotonic()
    emulator = Emulator(bench, _emulator_settings(options), now)
    control = None
    try:
        book = OrderBook(emulator)
        for order in orders:
            book.add(order)
        if options.control:
            control = ControlSocket(options.control, lambda line: book.answer(line, time.monotonic()))
        print(f"port {options.link or emulator.port.name}", flush=True)
        while not stop:
            _go_on(emulator, book, control)
            if bench.failed is not None:
                print(f"bench_emulator: {bench.failed.value}; the arm was brought to rest", file=sys.stderr)
                bench.failed = None
    finally:
        emulator.close()
        if control is not None:
            control.close()


def _go_on(emulator: Emulator, book: OrderBook, control: ControlSocket | None) -> None:
    """Wait until something is due or has arrived, and process it."""
    wake = min(emulator.wake_at, book.wake_at)
    port = emulator.port.fileno()
    files = [] if control is None else control.files
    if port is not None and emulator.port.open:  # a port without a host is always ready, with nothing
        files = [*files, port]
    try:
        select.select(files, [], [], max(0.0, wake - time.monotonic()))
    except InterruptedError:
        return
    if control is not None:
        control.serve()
    emulator.hear()
    now = time.monotonic()
    book.step(now)
    emulator.step(now)


def _script(path: Path | None) -> list[Order]:
    if path is None:
        return []
    try:
        return read_orders(path.read_text(encoding="utf-8").splitlines())
    except (OSError, UnicodeDecodeError) as error:
        raise FileError(path, f"cannot be read: {error}") from None


def _bench_settings(options: argparse.Namespace) -> BenchSettings:
    quality = SensorQuality()
    defaults = ReceiverLimits()
    return BenchSettings(
        sample_rate=options.rate,
        bend=math.radians(options.bend),
        limits=ReceiverLimits(
            max_tension=options.max_tension,
            max_rate=options.max_rate,
            command_timeout=defaults.command_timeout,
            heartbeat_timeout=defaults.heartbeat_timeout,
            slack_time=defaults.slack_time,
        ),
        quality=quality.perfect() if options.perfect_sensors else quality,
        seed=options.seed,
    )


def _emulator_settings(options: argparse.Namespace) -> EmulatorSettings:
    return EmulatorSettings(
        link=options.link,
        truth=options.truth,
        sent=options.sent,
        baud=options.baud,
        clock_start=options.clock_start,
        sees_hang_up=not options.no_hang_up,
        seed=options.seed,
    )


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="bench_emulator",
        description="Emulates a bench with inertial sensors and cables: speaks the protocol of docs/bench-protocol.md "
        "on a pseudo-terminal and simulates the arm. Prints the port in one line.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    limits = ReceiverLimits()
    add = parser.add_argument
    add("--link", type=Path, metavar="PATH", help="keep a symbolic link to the port while it exists")
    add("--model", default="lamecc_prototype.yaml", help="model file, or name of a model in the library")
    add("--bend", type=_number(-270, 270), default=0.0, metavar="DEG", help="bend of the whole arm at the start")
    add("--truth", type=Path, metavar="FILE", help="write the true motion, CSV, one row per sample")
    add("--sent", type=Path, metavar="FILE", help="write the send time of each sensor frame, CSV")
    add("--faults", type=Path, metavar="FILE", help="carry out the orders in a file")
    add("--control", type=Path, metavar="PATH", help="listen for orders on a UNIX socket")
    add("--rate", type=_number(1, 1000), default=60.0, metavar="HZ", help="samples per second; default 60")
    add("--baud", type=_number(0, 1e8), default=0.0, help="speed of the line [bit/s]; default 0, no transmission time")
    add("--max-tension", type=_number(0, 327), default=limits.max_tension, metavar="N", help="limit of the receiver")
    add("--max-rate", type=_number(0.1, 6500), default=limits.max_rate, metavar="N/S", help="limit of the receiver")
    add("--perfect-sensors", action="store_true", help="sensors without any error")
    add("--clock-start", type=int, default=0, metavar="US", help="reading of the controller's clock at the start")
    add("--no-hang-up", action="store_true", help="the controller does not detect that the host closes the port")
    add("--seed", type=int, default=0, help="seed of all random numbers")
    return parser


def _number(lower: float, upper: float) -> Callable[[str], float]:
    """Return a type for argparse: a number within bounds."""

    def number(text: str) -> float:
        value = float(text)
        if not lower <= value <= upper:
            raise argparse.ArgumentTypeError(f"{text} is not from {lower:g} to {upper:g}")
        return value

    return number

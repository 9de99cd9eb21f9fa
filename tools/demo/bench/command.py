"""The command line of the demo, and its sequence from the start to the diagnosis."""

from __future__ import annotations

import argparse
import math
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np

import tools.demo.bench
from continuum.cli import main as continuum
from continuum.cli.diagnose import EXIT_CODES
from continuum.dynamics.model_file import load_model, save_model
from continuum.errors import ContinuumError
from tools.demo.bench.answer import answer, with_hidden_effect
from tools.demo.bench.conductor import Conductor, side_by_side
from tools.demo.bench.runs import BEND, RUNS, Run
from tools.demo.bench.truth import error_of_angles, rms_degrees
from tools.demo.domain import domain_for_demo
from tools.demo.errors import DemoError
from tools.demo.folder import claimed
from tools.demo.nodes import checker, launched

TOPICS = ("/joint_states", "/cable_states", "/cable_tension_cmd", "/simulated/joint_states", "/simulated/cable_states",
          "/diagnostics", *(f"/imu_{k}/data_raw" for k in range(1, 6)))  # fmt: skip

RESULTS = (*(run.name for run in RUNS), "nodes.log", "recorder.log", "arm.yaml", "sensors.yaml", "truth.csv",
           "verdict.json", "diagnosis.html", "better.yaml")  # fmt: skip

TRIES = 5
"""Most attempts at a run."""

GAP = 0.25
"""Longest time without joint states in a run [s]: `continuum diagnose` refuses recordings with longer gaps."""

TOO_BUSY = "the machine is too busy for a bench"


def main(arguments: list[str] | None = None) -> int:
    """Run the demo; return 0 if all of it was completed and a hidden effect was found, 1 if not."""
    parser = argparse.ArgumentParser(prog="make bench-demo ARGS=...", description=tools.demo.bench.__doc__)
    parser.add_argument("--port", default="", help="serial port of a real bench; default: an emulated one")
    parser.add_argument("--out", type=Path, default=Path("out/bench_demo"), metavar="FOLDER",
                        help="default: %(default)s")  # fmt: skip
    parser.add_argument("--no-diagnosis", action="store_true", help="end with the recordings")
    options = parser.parse_args(arguments)
    try:
        record_runs(options.port, options.out)
        status = 0 if options.no_diagnosis else diagnosed(options.out)
        if options.port or options.no_diagnosis or status:
            return status
        lines, found = answer(options.out / "verdict.json")
        print("\n".join(lines))
        return 0 if found else 1
    except ContinuumError as error:
        print(f"bench-demo: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print(f"bench-demo: interrupted; what was recorded until then is in {options.out}", file=sys.stderr)
        raise


def record_runs(port: str, out: Path) -> None:
    """Calibrate, pull and release, and write a recording of each run to ``out``.

    Raises:
        ContinuumError: a node died, or did not carry out a request.
    """
    with domain_for_demo() as domain, claimed(out, RESULTS):
        log_file = out / "nodes.log"
        with (
            log_file.open("w", encoding="utf-8") as log,
            launched(_launch_command(port, out.resolve()), domain, log.fileno()) as launch,
            Conductor(domain, checker(launch, log_file)) as conductor,
        ):
            _calibrate(conductor, by_hand=bool(port))
            for run in RUNS:
                _until_whole(conductor, run.name, partial(_record, run, out / run.name, domain, conductor))
                _report(run, conductor, None if port else out / "truth.csv")


def _record(run: Run, folder: Path, domain: int, conductor: Conductor) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    with recorder(folder, domain, conductor):
        conductor.place_simulated_arm()
        conductor.listen(0.5)
        conductor.wait_for_states()
        conductor.carry_out(run)


def _until_whole(conductor: Conductor, what: str, act: Callable[[], None]) -> None:
    """Carry out something with an active bridge; again if it became inactive or left out angles, on a busy machine.

    Raises:
        DemoError: it did so every time, or something else failed.
    """
    for _ in range(TRIES):
        conductor.activate()
        try:
            act()
        except DemoError:
            if conductor.is_active:
                raise
        gap = conductor.largest_gap if conductor.is_active else math.inf
        if gap <= GAP:
            return
        why = f"joint states are missing for {gap:.1f} s" if math.isfinite(gap) else "the bridge became inactive"
        print(f"{what}, once more: {why}; nodes.log may have the reason", flush=True)
    raise DemoError(f"{what}: {why}, the last of {TRIES} times; {TOO_BUSY}")


def diagnosed(out: Path) -> int:
    """Run `continuum diagnose` on the recordings; return 0 for any verdict."""
    files = ["--json", out / "verdict.json", "--report", out / "diagnosis.html", "--extended", out / "better.yaml"]
    words = ["diagnose", *(out / run.name for run in RUNS), *files]
    print(f"continuum {' '.join(str(word) for word in words)}", flush=True)
    status = continuum([str(word) for word in words])
    return 0 if status in EXIT_CODES.values() else 1


def _launch_command(port: str, out: Path) -> list[str]:
    """Return the launch command of bridge and simulated arm, and without a port of an emulated bench."""
    words = ["ros2", "launch", "continuum_hw_imu", "bench.launch.py", "simulated:=true"]
    words.append(f"calibration:={out / 'sensors.yaml'}")
    if port:
        return [*words, f"port:={port}"]  # no cable of a real arm is pulled before its angles are known
    words.append("allow_uncalibrated:=true")  # its axes are found from a bend by a cable
    save_model(with_hidden_effect(load_model("lamecc_prototype.yaml")), out / "arm.yaml")
    return [
        *words,
        f"emulated_model:={out / 'arm.yaml'}",
        f"emulator_link:={out / 'port'}",
        f"emulator_control:={out / 'control'}",
        f"emulator_truth:={out / 'truth.csv'}",
    ]


def _calibrate(conductor: Conductor, by_hand: bool) -> None:
    """Calibrate the sensors; the arm is bent by hand or, without a calibration, by a cable."""
    print("calibration: bias and zero at rest, axes from a bend towards cable 1 and back", flush=True)
    conductor.trigger("bench_bridge/calibrate_bias", patient=True)
    conductor.trigger("bench_bridge/zero", patient=True)
    if by_hand:
        _wait_for_enter(
            "within a minute from now, bend the arm by hand towards cable 1, by 30 degrees or more, and back; "
            "then press Enter"
        )
    else:
        _until_whole(conductor, BEND.name, partial(conductor.carry_out, BEND))
    print(f"  {conductor.trigger('bench_bridge/find_axes', patient=True)}", flush=True)
    if by_hand:
        most = max(run.pull(t).max() for run in RUNS for t in np.linspace(0.0, run.pulled, 100))
        _wait_for_enter(f"hands off: the cables will pull with up to {most:g} N; press Enter to start")
    conductor.activate()
    conductor.wait_for_states()


def _wait_for_enter(prompt: str) -> None:
    """Ask the user to do something.

    Raises:
        DemoError: nobody can answer.
    """
    try:
        input(f"{prompt} ")
    except EOFError:
        raise DemoError("a real bench needs somebody at the terminal, who bends the arm and presses Enter") from None


def _report(run: Run, conductor: Conductor, truth: Path | None) -> None:
    times, measured, simulated = side_by_side(conductor.received)
    line = (
        f"{run.name}: {times[-1]:.1f} s, {len(times)} joint states, bent by up to "
        f"{abs(measured.sum(axis=1)).max() * 57.29578:.0f} degrees; the simulation errs by "
        f"{rms_degrees(simulated - measured):.1f} degrees RMS"
    )
    if truth is not None:
        off = rms_degrees(error_of_angles(conductor.received["measured"], truth))
        line += f"; the measured angles err by {off:.2f} degrees RMS"
    print(line, flush=True)


@contextmanager
def recorder(folder: Path, domain: int, conductor: Conductor) -> Iterator[None]:
    """Record the run's topics into ``folder`` during the block.

    Raises:
        DemoError: the recorder does not start.
    """
    log_file = folder.parent / "recorder.log"
    topics = ", ".join(TOPICS)
    words = ["ros2", "run", "continuum_manipulator", "recorder", "--ros-args", "-p", f"output:={folder}"]
    with log_file.open("a", encoding="utf-8") as log:
        before = log_file.read_text(encoding="utf-8")
        with launched([*words, "-p", f"topics:=[{topics}]"], domain, log.fileno()) as process:

            def recording() -> bool:
                if process.poll() is not None:
                    raise DemoError(f"the recorder ended; see {log_file}")
                text = log_file.read_text(encoding="utf-8").removeprefix(before)
                return f"recording {len(TOPICS)} topics" in text

            conductor.wait_until(recording, "the recorder")
            yield

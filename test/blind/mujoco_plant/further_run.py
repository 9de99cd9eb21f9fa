"""One more recording of a case's arm, of a motion that somebody chose."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from blind.mujoco_plant.case import Builder, Truth, file_of
from blind.mujoco_plant.machine import RATE, STEPS, Machine
from blind.mujoco_plant.parameters import JOINTS
from blind.mujoco_plant.regimes import RELEASE_ROWS, Run
from blind.mujoco_plant.sensors import NOISES, Noise, Reading

HELD = 5  # rows before a release


@dataclass(frozen=True)
class Wanted:
    """A motion.

    Attributes:
        bend: in all, from which the arm is let go [rad]; None where cables are driven.
        command: tensions, (rows, 2) at 120 Hz [N]; None for a release.
        zeroed: whether zeros of the sensors are set by hand before it.
    """

    bend: float | None = None
    command: np.ndarray | None = None
    zeroed: bool = False


def further_run(
    truth: Truth,
    wanted: Wanted,
    seed: int,
    machine: Builder = Machine,
    noises: Mapping[str, Noise] = NOISES,
    rates: bool = True,
    steps: int = STEPS,
) -> bytes:
    """The recording's file.

    Args:
        truth: of the case.
        wanted: what the arm does.
        seed: of the noise, and of what effects draw in each recording.
        machine, noises, rates, steps: of the plant, as `make_case` takes them.
    """
    drawn, sensing, noisy = np.random.default_rng([truth.seed, seed]).spawn(3)
    rows = RELEASE_ROWS if wanted.command is None else len(wanted.command)
    built = machine(truth.parameters, truth.effects, drawn, steps, (rows - 1) / RATE)
    if wanted.command is None:
        command = np.zeros((rows, 2))
        command[:HELD] = built.pull_to(float(wanted.bend or 0.0))
        run = Run("further", built.record(command, let_go_at=HELD), command)
    else:
        built.settle(wanted.command[0])
        run = Run("further", built.record(wanted.command), wanted.command)
    reading = Reading(JOINTS, truth.effects, sensing)
    if wanted.zeroed:
        reading.joint_offset = 0 * reading.joint_offset
    return file_of(run, *reading.take(run.motion, noises[truth.noise], noisy), rates, True)

"""From a URDF to a verdict by commands alone, with recordings of the same arm with a payload that the URDF lacks.

MuJoCo simulates the arm from the URDF with the payload added. `continuum model from-urdf` writes the model, and the
recordings contain the model's angles according to the lines that the command prints.
"""

from __future__ import annotations

import re
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees, radians
from pathlib import Path
from typing import Final

import numpy as np

from continuum.arrays import Array
from continuum.discovery import Diagnosis, diagnose
from continuum.discovery.decision import Kind
from continuum.discovery.result import Cause, is_named
from continuum.discovery.words import estimate_in_words
from continuum.dynamics.model_file import load_model
from continuum.identification.estimate import Estimate
from continuum.recordings.motion_columns import TIME, angle_column, torque_column
from continuum.recordings.recording_csv import read_recording_csv
from continuum.whole_file import write_table
from tools.benchmarks.exams import payload_arm
from tools.benchmarks.exams.exam_section import Section
from tools.benchmarks.record import Figure
from tools.docs.markdown import paragraph, table

SEEDS: Final = range(8)
RUNS, DURATION, NOISE = 4, 2.0, 0.1  # s, degrees
SHARES: Final = (0.2, 0.3)  # range of the payload, as a fraction of the last link's mass
_LINE: Final = re.compile(r"q(?P<number>\d+) = (?P<sign>-?)(?P<joint>\w+)(?: (?P<way>[+-]) (?P<zero>\S+) deg)?")


@dataclass(frozen=True)
class Convention:
    """Model angles as functions of URDF angles: signs times these plus zeros, (n,) each [rad]."""

    signs: Array
    zeros: Array

    def angles(self, urdf: Array) -> Array:
        """Return the angles of the model, (rows, n) [rad]."""
        return self.signs * urdf + self.zeros

    def torques(self, urdf: Array) -> Array:
        """Return the torques of the model, (rows, n) [N m]."""
        return self.signs * urdf


def model_by_command(urdf: Path, out: Path) -> Convention:
    """Let the command write the model of a URDF, and return the convention that it prints.

    Raises:
        subprocess.CalledProcessError: the command failed.
    """
    command = ["continuum", "model", "from-urdf", str(urdf), "--out", str(out)]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    found = list(map(_LINE.fullmatch, printed.splitlines()))
    lines = [one for one in found if one is not None]
    signs = [-1.0 if one["sign"] else 1.0 for one in lines]
    zeros = [float(f"{one['way']}{one['zero']}") if one["way"] else 0.0 for one in lines]
    return Convention(np.array(signs), np.radians(zeros))


@dataclass(frozen=True)
class Answer:
    """A diagnosis, and the hidden payload [kg], 0 for none."""

    seed: int
    payload: float
    result: Diagnosis

    @property
    def payloads(self) -> list[Cause]:
        """The payload of every named set that has no other effect."""
        sets = self.result.sets if is_named(self.result.verdict.kind) else ()
        return [causes[0] for causes in sets if [c.effect for c in causes] == ["tip_payload"]]

    @property
    def is_right(self) -> bool:
        """Whether the payload is named, alone or in a possible set; without one, whether the model is adequate."""
        return bool(self.payloads) if self.payload else self.result.verdict.kind is Kind.ADEQUATE

    @property
    def mass(self) -> Estimate | None:
        """Estimate of the payload's mass if it is named, else None."""
        return self.payloads[0].estimates[0] if self.payloads else None


def examine(seed: int, *, loaded: bool = True) -> Answer:
    """Run the whole workflow once, with a payload, motions and noise from a seed."""
    random = np.random.default_rng(seed)
    share = float(random.uniform(*SHARES))
    payload = share * payload_arm.LAST_MASS if loaded else 0.0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "arm.urdf").write_text(payload_arm.urdf(), encoding="utf-8")
        convention = model_by_command(folder / "arm.urdf", folder / "arm.yaml")
        files = [folder / f"run_{number}.csv" for number in range(1, RUNS + 1)]
        for file in files:
            _record(file, convention, payload, random)
        return Answer(seed, payload, diagnose(list(map(read_recording_csv, files)), load_model(folder / "arm.yaml")))


def _record(file: Path, convention: Convention, payload: float, random: np.random.Generator) -> None:
    """Write a table of noisy angles and of torques."""
    torque = payload_arm.torques(random, round(DURATION * payload_arm.RATE) + 1)
    angles = convention.angles(payload_arm.motion(payload_arm.urdf(payload), torque))
    seen = np.degrees(angles + random.normal(scale=radians(NOISE), size=angles.shape))
    joints = range(1, angles.shape[1] + 1)
    times = np.arange(len(torque))[:, None] / payload_arm.RATE
    columns = np.concatenate([times, seen, convention.torques(torque)], axis=1)
    write_table(file, [[TIME, *map(angle_column, joints), *map(torque_column, joints)], *columns.tolist()])


def section(seeds: Sequence[int] = SEEDS) -> Section:
    """Examine every seed, and one arm without a payload."""
    answers = [examine(seed) for seed in seeds]
    bare = examine(seeds[0], loaded=False)
    right = sum(one.is_right for one in answers)
    alone = sum(one.is_right and len(one.result.sets) == 1 for one in answers)
    masses = [(one.payload, one.mass) for one in answers if one.mass is not None]
    held = sum(mass.low <= truth <= mass.high for truth, mass in masses)
    more = sum(not one.result.verdict.complete for one in answers)
    parts = [
        "## From a URDF to a verdict, with a hidden payload",
        paragraph(
            "An arm of three joints is drawn as a URDF, with its elbow bent and one axis reversed.",
            f"`continuum model from-urdf` writes its model. MuJoCo simulates {RUNS} recordings of {DURATION:g} s from",
            f"the same URDF, with a payload at the tip of {100 * SHARES[0]:.0f} to {100 * SHARES[1]:.0f} % of the last",
            "link's mass, dry friction and damping as the URDF has them, other torques in each, and noise of",
            f"{NOISE:g} degrees; `continuum diagnose` gets the tables.",
        ),
        paragraph(
            f"The payload is named in {right} of {len(answers)} cases, alone in {alone}. The 95 % interval holds the",
            f"true mass in {held} of {len(masses)}. In {more} of {len(answers)} the diagnosis says that something",
            "more is missing (last column but one), though nothing else is hidden. The last row is the arm of",
            "the first seed without a payload. Times are the processor's; the first has what is compiled or loaded",
            "once. Errors are those of open-loop simulations of half a second, of the refitted and the extended model.",
        ),
        table(
            ("seed", "payload [g]", "verdict", "sets (relative fit)", "mass found", "error [deg]", "more", "time [s]"),
            map(_row, [*answers, bare]),
        ),
    ]
    what = "payload hidden on an arm from a URDF"
    figures = [Figure(f"{what}: named", 100 * right / len(answers), "%", n=len(answers))]
    if masses:
        figures.append(Figure(f"{what}: mass inside its 95 % interval", 100 * held / len(masses), "%", n=len(masses)))
    return Section("\n\n".join(parts), tuple(figures))


def _row(one: Answer) -> tuple[object, ...]:
    result = one.result
    sets = zip(result.sets, result.verdict.relative_fits, strict=False)
    named = "; ".join(f"{' + '.join(c.label for c in causes) or 'nothing'} ({p:.2f})" for causes, p in sets)
    error = " -> ".join(f"{degrees(model.of_segments):.2f}" for model in (result.before, result.after))
    mass = "" if one.mass is None else estimate_in_words(one.mass)
    hidden = f"{1e3 * one.payload:.1f}" if one.payload else "none"
    more = "no" if result.verdict.complete else "yes"
    return (one.seed, hidden, result.verdict.kind.value, named, mass, error, more, f"{result.seconds:.1f}")

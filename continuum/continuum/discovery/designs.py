"""Runs that a laboratory can make: releases from a posture, commands, and measurements by hand.

Amplitudes are those at which the arm was moved before, so that no run loads it more.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.joint_torques import JointTorques, no_torques
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.pulled_posture import pulled_posture
from continuum.dynamics.tensions import LET_GO, Tensions, slack
from continuum.errors import InvalidValueError
from continuum.languages import Message
from continuum.recordings.recording import Recording
from continuum.significant_digits import rounded

RATE = 120.0  # readings per second, as on the prototype
_SECONDS = 3.0
_OF_A_RELEASE = 1.5  # s, after which an arm rests: segments at rest carry little information
_SINES = np.geomspace(0.3, 3.5, 6)  # Hz, from slower to faster than an arm swings


@dataclass(frozen=True)
class Design:
    """A run.

    Attributes:
        name: a few words.
        instruction: what to do, for a mechanic.
        posture: where the arm rests initially, (n,) [rad].
        times: of the readings, (n_times,) [s].
        inputs: what drives it.
        zeroed: whether the sensors' zeros are set by hand before it.
    """

    name: str
    instruction: str
    posture: Array
    times: Array
    inputs: InputSignal
    zeroed: bool = False


def designs(model: Model, recordings: Sequence[Recording]) -> list[Design]:
    """Return runs for an arm, given its recordings."""
    hanging = np.zeros(model.n_joints)
    times = np.arange(round(_SECONDS * RATE) + 1) / RATE
    let_go = times[times <= _OF_A_RELEASE]
    release = _release(model, recordings, let_go)
    found = [
        release,
        Design(
            Message("release with zeros by protractor"),
            Message(
                "Measure the angle of each joint at rest with a protractor and set the sensors' zeros to match. Then "
                "bend the arm and let it go. Diagnose all recordings again, with --zeroed and the name of this one."
            ),
            release.posture, let_go, release.inputs, zeroed=True,
        ),
    ]  # fmt: skip
    driven = _driven(model, recordings, times)
    return found + [Design(name, text, hanging, times, inputs) for name, text, inputs in driven]


def _release(model: Model, recordings: Sequence[Recording], times: Array) -> Design:
    """Return a release from the side opposite to the largest bend, with the same bend."""
    bends = np.concatenate([np.sum(one.theta, axis=1) for one in recordings])
    far, most = float(np.max(np.abs(bends))), bends[np.argmax(np.abs(bends))]
    side = -1.0 if most > 0 else 1.0
    posture = np.full(model.n_joints, side * far / model.n_joints)
    if model.inputs is InputKind.CABLES:
        with contextlib.suppress(InvalidValueError):  # no cable holds it there, but hands do
            posture = pulled_posture(model, side * far).theta
    name, bend = Message("release from the other side"), {"angle": np.degrees(far), "side": _side(side)}
    if model.inputs is InputKind.CABLES:
        text = Message(
            "Bend the arm by {angle:.0f} degrees in total to the {side} side with one cable, and let it go.", **bend
        )
        return Design(name, text, posture, times, slack())
    text = Message(
        "Bend the arm by {angle:.0f} degrees in total to the {side} side by hand with the drives off, and let it go.",
        **bend,
    )
    return Design(name, text, posture, times, no_torques(model.n_joints))


def _side(sign: float) -> Message:
    return Message("positive") if sign > 0 else Message("negative")


def _driven(model: Model, recordings: Sequence[Recording], times: Array) -> Iterator[tuple[str, str, InputSignal]]:
    """Yield commands that hold from row to row; none if no safe load of the arm is known."""
    most, n = _largest(model, recordings), model.n_inputs
    if not np.any(most > 0):
        return
    share = times / times[-1]
    triangle = np.interp(share, [0, 0.25, 0.5, 0.75, 1], [0, 1, 0, -1, 0])
    wave = np.sum(np.sin(2 * np.pi * np.outer(times, _SINES) + np.arange(_SINES.size) ** 2), axis=1)
    wave *= np.minimum(1, times / 0.2) / np.max(np.abs(wave))
    if model.inputs is InputKind.CABLES:
        top = float(np.max(most))
        pair = np.column_stack([np.maximum(triangle, 0), np.maximum(-triangle, 0)])
        yield (
            Message("slow pull of one cable, then of the other"),
            Message(
                "Pull cable 1 slowly to {tension:.0f} N and slacken it again, then cable 2, {time:.0f} s in total.",
                tension=top,
                time=times[-1],
            ),
            Tensions(times, top * pair, held=True),
        )
        both = np.interp(share, [0, 0.5, 1], [0.07, 0.67, 0.07])[:, None] + np.column_stack([wave, -wave]) / 3
        yield (
            Message("co-contraction"),
            Message(
                "Tighten both cables together and slacken them again while their difference swings, up to "
                "{tension:.0f} N.",
                tension=top,
            ),
            Tensions(times, top * np.maximum(both, 0.0), held=True),
        )
        yield (
            Message("multisine"),
            Message(
                "Drive the cables in turn with a sum of sines from 0.3 to 3.5 Hz up to {tension:.0f} N.", tension=top
            ),
            Tensions(times, top * np.column_stack([np.maximum(wave, 0), np.maximum(-wave, 0)]), held=True),
        )
        return
    turns = np.column_stack([np.interp(n * share - j, [0, 0.25, 0.5, 0.75, 1], [0, 1, 0, -1, 0]) for j in range(n)])
    waves = np.column_stack([np.roll(wave, 7 * j) for j in range(n)])
    limits = ", ".join(rounded(torque, 2) for torque in most)
    yield (
        Message("slow torque at one joint after another"),
        Message(
            "Raise and lower the torque of one joint after another slowly, to both sides, up to {torques} N m.",
            torques=limits,
        ),
        JointTorques(times, most * turns, held=True),
    )
    yield (
        Message("multisine of all drives"),
        Message("Drive all joints at once with sums of sines from 0.3 to 3.5 Hz up to {torques} N m.", torques=limits),
        JointTorques(times, most * waves, held=True),
    )


def _largest(model: Model, recordings: Sequence[Recording]) -> Array:
    """Return the largest input of each cable or joint so far, (n_inputs,) [N or N m].

    If no cable's tension was recorded, it is the tension that holds the arm at its largest bend.
    """
    most = np.max([np.max(np.abs(one.inputs_for(model).values), axis=0) for one in recordings], axis=0)
    if model.inputs is not InputKind.CABLES or np.any(most > -LET_GO):
        return np.asarray(most)
    far = max((float(np.max(np.abs(np.sum(one.theta, axis=1)))) for one in recordings), default=0.0)
    try:
        return pulled_posture(model, far).tension
    except InvalidValueError:
        return np.zeros(model.n_inputs)

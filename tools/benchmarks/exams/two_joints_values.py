"""Section of the page on values that the diagnoses find for the arm with two joints, compared with known values."""

from __future__ import annotations

from math import degrees

import numpy as np

from continuum.discovery.result import Diagnosis
from continuum.discovery.words import estimate_in_words
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.planar.rigid_body import gravity_torque
from continuum.identification.estimate import Estimate
from tools.benchmarks.exams.pendulum_runs import GIVEN, MAKERS_FRICTION
from tools.benchmarks.exams.two_joints import ALTERED, LAG, TURN
from tools.docs.markdown import paragraph, table

FRICTION, OFFSET, DELAY, INERTIA = "joint_friction", "angle_offset", "sensor_delay", "inertia"
COULOMB = "coulomb_friction"


def friction(first: Diagnosis) -> str:
    """Describe the friction that the model file lacks, and other results of the given runs."""
    named = sum(any(cause.effect == FRICTION for cause in causes) for causes in first.sets)
    cables = sorted({c.label for causes in first.sets for c in causes if effect_named(c.effect).uses_cables})
    found = {(number, e.joint): e for number, e in estimates(first, FRICTION) if e.name == COULOMB}
    rows = []
    for joint, truth in enumerate(MAKERS_FRICTION):
        values = [found.get((number, joint)) for number in range(1, len(first.sets) + 1)]
        rows.append([joint + 1, f"{truth:g} N m", *("" if e is None else _compared(e, truth) for e in values)])
    parts = [
        "### Friction that the model file lacks",
        paragraph(
            f"`{FRICTION}` is in {named} of {len(first.sets)} sets.",
            f"Acting on cables: {', '.join(cables)}." if cables else "No effect of any set acts on cables.",
            "Coulomb friction as its makers identified it elsewhere, and as each set has it, with a 95 % interval that",
            "holds or misses it:",
        ),
        table(("joint", "its makers'", *(f"set {number}" for number in range(1, len(first.sets) + 1))), rows),
        _near_rest(first),
        "All values:",
        _values(first),
        _beginning(first),
    ]
    return "\n\n".join(part for part in parts if part)


def _compared(one: Estimate, truth: float) -> str:
    """Describe whether the interval contains the known value."""
    return f"{estimate_in_words(one)}, {'holds' if one.low <= truth <= one.high else 'misses'} it"


def _near_rest(first: Diagnosis) -> str:
    p = first.extended_model.changed_parameters
    if not np.any(p.stribeck_gain * p.coulomb_friction):
        return ""
    near = " and ".join(f"{value:.3f}" for value in p.coulomb_friction * (1 + p.stribeck_gain))
    return paragraph(f"Set 1 has Stribeck's torque too: near rest its dry friction is {near} N m.")


def _beginning(first: Diagnosis) -> str:
    """Describe whether friction could hold the arm in the initial postures that follow from the offsets."""
    p, found = first.extended_model.changed_parameters, [e for number, e in estimates(first, OFFSET) if number == 1]
    if not found:
        return ""
    lines, can = [], True
    for run in first.recordings:
        offsets = {e.joint: e.value for e in found if e.recording == run.name}
        angles = run.theta[0] - [offsets.get(joint, 0.0) for joint in range(p.n_joints)]
        torque = np.abs(gravity_torque(np.cumsum(angles), p))
        can = can and bool(np.all(torque <= p.coulomb_friction))
        lines.append(f"{' and '.join(f'{value:.3f}' for value in torque)} N m in {run.name}")
    read = max(float(np.max(np.abs(run.theta[0]))) for run in first.recordings)
    return paragraph(
        f"All given runs begin with readings within {degrees(read):.2f} degrees of zero, as sensors do that are zeroed",
        "where the arm rests. By the offsets of set 1 it did not hang straight down: gravity turned its joints with",
        f"{', '.join(lines)}. {'Each is less' if can else 'Not each is less'} than the Coulomb friction of that set,",
        "which may have held the arm there." if can else "so that friction alone does not explain these offsets.",
    )


def halved(one: Diagnosis) -> str:
    """Describe the recovery of half of the last link's mass."""
    p = one.refitted_model.parameters
    last = p.n_joints - 1
    masses = [(n, e) for n, e in estimates(one, INERTIA) if e.name == f"{INERTIA}.mass" and e.joint in (last, None)]
    found = [f"Set {number}: {_compared(e, 1.0)}." for number, e in masses]
    text = paragraph(
        "The rotor's inertia of the extended model becomes a parameter, and half of the last link's mass is taken",
        f"away. `{INERTIA}.mass[{last + 1}]`, the missing mass over the model's, should be 1.",
        *(found or ["It is in no set."]),
        f"The last link's centre of mass lies at {p.center_of_mass[last]:g} of {p.tip[0]:g} m, so that this arm hardly",
        "tells a payload at its tip from mass at that centre.",
    )
    return "\n\n".join(["### Half of the last link's mass", text, _values(one)])


def turned(first: Diagnosis, altered: Diagnosis) -> str:
    """Describe the change of an offset after an angle was added to readings."""
    before, after = (_offset(one) for one in (first, altered))
    text = f"The offset of q{ALTERED + 1} in {GIVEN[0]} is not in both first sets."
    if before is not None and after is not None:
        text = paragraph(
            f"`{OFFSET}` at joint {ALTERED + 1} of {GIVEN[0]} is {estimate_in_words(after)}. In set 1 of the first",
            f"diagnosis, of unaltered readings, it is {estimate_in_words(before)}. It moves by",
            f"{degrees(after.value - before.value):.2f} degrees.",
        )
    return "\n\n".join([f"### {TURN:g} degrees added to an angle", text, _values(altered)])


def _offset(one: Diagnosis) -> Estimate | None:
    """Return the offset of the altered sensor in the altered run, from the first set."""
    where = (ALTERED, GIVEN[0])
    found = (e for number, e in estimates(one, OFFSET) if number == 1 and (e.joint, e.recording) == where)
    return next(found, None)


def late(one: Diagnosis) -> str:
    """Describe the delay of one sensor."""
    found = [f"Set {n}: {_compared(e, LAG)}." for n, e in estimates(one, DELAY) if e.joint == ALTERED]
    text = paragraph(
        f"q{ALTERED + 1} of both runs is read {1e3 * LAG:g} ms later, interpolated; rates stay as they are.",
        f"`{DELAY}.lag[{ALTERED + 1}]` should be {LAG:g} s.",
        *(found or ["It is in no set."]),
    )
    return "\n\n".join(["### One late sensor", text, _values(one)])


def estimates(one: Diagnosis, effect: str) -> list[tuple[int, Estimate]]:
    """Estimates of an effect, each with the number of the set, from 1."""
    causes = [(number, cause) for number, causes in enumerate(one.sets, 1) for cause in causes]
    return [(number, e) for number, cause in causes if cause.effect == effect for e in cause.estimates]


def _values(one: Diagnosis) -> str:
    """Values of every set, side by side."""
    columns = [{str(e): estimate_in_words(e) for cause in causes for e in cause.estimates} for causes in one.sets]
    names = dict.fromkeys(name for column in columns for name in column)
    heads = [
        f"set {number}: {' + '.join(cause.label for cause in causes)}" for number, causes in enumerate(one.sets, 1)
    ]
    return table(
        ("value, 95 % interval", *heads),
        [(f"`{name}`", *(column.get(name, "") for column in columns)) for name in names],
    )

"""The answer in words."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.curvature.comparison import LEVEL, Comparison, Distance, Nearer, Overall


def nearer_in_words(one: Comparison) -> str:
    """Say which model is nearer to one posture, and by how much, with the uncertainty of the measurement."""
    if not one.resolved:
        apart = f"The models are {np.degrees(one.models_apart):.2f} degrees rms from each other"
        return f"Which model is nearer cannot be decided. {apart}, which is less than the measurement resolves."
    distances = one.angles_to_constant.value, one.angles_to_dynamic.value
    return f"{_which(one.nearer, distances, one.closer_by)}. {friction_in_words(one)}"


def overall_in_words(found: Overall) -> str:
    """Say the same over several postures."""
    n, dynamic, constant = sum(found.counts.values()), found.counts[Nearer.DYNAMIC], found.counts[Nearer.CONSTANT]
    alone = f"Taken singly, {dynamic} of them are nearer to the dynamic model, {constant} to constant curvature"
    if dynamic and constant:
        against = _against((found.to_constant, found.to_dynamic))
        return f"The {n} holds contradict each other. {alone}. Distances over all: {against}."
    text = _which(found.nearer, (found.to_constant, found.to_dynamic), found.closer_by)
    return f"Over {n} holds: {text[0].lower()}{text[1:]}. {alone}."


def friction_in_words(one: Comparison) -> str:
    """Say whether the dynamic model's dry friction could hold the measured joint angles."""
    beyond = one.beyond_friction + 1
    if np.any(np.isnan([one.held.zone.lower, one.held.zone.upper])):
        return "The range that dry friction holds in the dynamic model was not found at every joint."
    if beyond.size == 0:
        return "Every joint angle is one that dry friction holds in the dynamic model."
    if beyond.size == 1:
        return f"Joint {beyond[0]} is bent further than dry friction can hold it in the dynamic model."
    names = f"{', '.join(map(str, beyond[:-1]))} and {beyond[-1]}"
    return f"Joints {names} are bent further than dry friction can hold them in the dynamic model."


def tension_in_words(one: Comparison, recorded: Array | None) -> str:
    """Say which tensions hold the dynamic model's posture, and why not the recorded ones."""
    held = one.held
    needed = _tensions(held.load.tension)
    if recorded is None:
        return f"No tension was recorded; the dynamic model holds this bend with {needed}."
    if np.array_equal(held.load.tension, recorded):
        return f"The dynamic model holds this bend with {needed}, as recorded."
    recorded_ones = f"With {_tensions(recorded)}, as recorded, the dynamic model"
    if held.known is None or np.any(np.isnan(held.known)):
        return f"{recorded_ones} does not hold this bend; it needs {needed}."
    low, high = np.degrees(held.known)
    bend = np.degrees(one.theta.sum())
    return f"{recorded_ones} holds {low:.1f} to {high:.1f} degrees in total; for {bend:.1f} it needs {needed}."


def _tensions(tension: Array) -> str:
    """List the tensions of the cables that pull."""
    pulls = [f"{value:.1f} N of cable {cable + 1}" for cable, value in enumerate(tension) if value > 0]
    return " and ".join(pulls) or "no tension"


def _which(nearer: Nearer, distances: tuple[float, float], by: Distance) -> str:
    amount = f"{np.degrees(by.value):.2f} +- {np.degrees(LEVEL * by.sd):.2f} degrees (95 %)"
    against = _against(distances)
    if nearer is Nearer.UNDECIDED:
        return f"Which model is nearer cannot be decided: {against}, a difference of {amount}"
    name = "The dynamic model" if nearer is Nearer.DYNAMIC else "Constant curvature"
    return f"{name} is nearer by {amount}: {against}"


def _against(distances: tuple[float, float]) -> str:
    constant, dynamic = np.degrees(distances)
    return f"constant curvature {constant:.2f}, the dynamic model {dynamic:.2f} degrees rms"

"""The answer in words."""

from __future__ import annotations

import numpy as np

from continuum.arrays import Array
from continuum.curvature.comparison import LEVEL, Comparison, Distance, Nearer, Overall
from continuum.languages import ENGLISH, Translator


def nearer_in_words(one: Comparison, tr: Translator = ENGLISH) -> str:
    """Say which model is nearer to one posture, and by how much, with the uncertainty of the measurement."""
    if not one.resolved:
        return tr(
            "Which model is nearer cannot be decided. The models are {distance:.2f} degrees rms from each other, which "
            "is less than the measurement resolves.",
            distance=np.degrees(one.models_apart),
        )
    distances = one.angles_to_constant.value, one.angles_to_dynamic.value
    return f"{_which(one.nearer, distances, one.closer_by, tr)}. {friction_in_words(one, tr)}"


def overall_in_words(found: Overall, tr: Translator = ENGLISH) -> str:
    """Say the same over several postures."""
    n, dynamic, constant = sum(found.counts.values()), found.counts[Nearer.DYNAMIC], found.counts[Nearer.CONSTANT]
    distances = found.to_constant, found.to_dynamic
    alone = tr.plural(
        "Taken singly, {dynamic} of them are nearer to the dynamic model, {constant} to constant curvature",
        "Taken singly, {dynamic} of them are nearer to the dynamic model, {constant} to constant curvature",
        dynamic, dynamic=dynamic, constant=constant,
    )  # fmt: skip
    if dynamic and constant:
        return tr(
            "The {count} holds contradict each other. {alone}. Distances over all: {distances}.",
            count=n, alone=alone, distances=_against(distances, tr),
        )  # fmt: skip
    text = _which(found.nearer, distances, found.closer_by, tr)
    small = text[0].lower() + text[1:]
    return tr("Over {count} holds: {nearer}. {alone}.", count=n, nearer=small, alone=alone)


def friction_in_words(one: Comparison, tr: Translator = ENGLISH) -> str:
    """Say whether the dynamic model's dry friction could hold the measured joint angles."""
    beyond = one.beyond_friction + 1
    if np.any(np.isnan([one.held.zone.lower, one.held.zone.upper])):
        return tr("The range that dry friction holds in the dynamic model was not found at every joint.")
    if beyond.size == 0:
        return tr("In the dynamic model, dry friction can hold the arm at every measured joint angle.")
    if beyond.size == 1:
        return tr("Joint {joint} is bent further than dry friction can hold it in the dynamic model.", joint=beyond[0])
    return tr(
        "Joints {joints} and {last} are bent further than dry friction can hold them in the dynamic model.",
        joints=", ".join(map(str, beyond[:-1])), last=beyond[-1],
    )  # fmt: skip


def tension_in_words(one: Comparison, recorded: Array | None, tr: Translator = ENGLISH) -> str:
    """Say which tensions hold the dynamic model's posture, and why not the recorded ones."""
    held = one.held
    needed = _tensions(held.load.tension, tr)
    if recorded is None:
        return tr("No tension was recorded; the dynamic model holds this bend with {tensions}.", tensions=needed)
    if np.array_equal(held.load.tension, recorded):
        return tr("The dynamic model holds this bend with {tensions}, as recorded.", tensions=needed)
    values = {"recorded": _tensions(recorded, tr), "needed": needed}
    if held.known is None or np.any(np.isnan(held.known)):
        return tr(
            "With {recorded}, as recorded, the dynamic model does not hold this bend; it needs {needed}.", **values
        )
    low, high = np.degrees(held.known)
    return tr(
        "With {recorded}, as recorded, the dynamic model holds {low:.1f} to {high:.1f} degrees in total; for "
        "{bend:.1f} it needs {needed}.",
        low=low, high=high, bend=np.degrees(one.theta.sum()), **values,
    )  # fmt: skip


def _tensions(tension: Array, tr: Translator) -> str:
    """List the tensions of the cables that pull."""
    pulls = [
        tr("{tension:.1f} N of cable {cable}", tension=value, cable=cable + 1)
        for cable, value in enumerate(tension)
        if value > 0
    ]
    return tr(" and ").join(pulls) or tr("no tension")


def _which(nearer: Nearer, distances: tuple[float, float], by: Distance, tr: Translator) -> str:
    amount = tr(
        "{value:.2f} +- {error:.2f} degrees (95 %)", value=np.degrees(by.value), error=np.degrees(LEVEL * by.sd)
    )
    values = {"amount": amount, "distances": _against(distances, tr)}
    match nearer:
        case Nearer.UNDECIDED:
            return tr("Which model is nearer cannot be decided: {distances}, a difference of {amount}", **values)
        case Nearer.DYNAMIC:
            return tr("The dynamic model is nearer by {amount}: {distances}", **values)
        case _:
            return tr("Constant curvature is nearer by {amount}: {distances}", **values)


def _against(distances: tuple[float, float], tr: Translator) -> str:
    constant, dynamic = np.degrees(distances)
    return tr(
        "constant curvature {constant:.2f}, the dynamic model {dynamic:.2f} degrees rms",
        constant=constant,
        dynamic=dynamic,
    )

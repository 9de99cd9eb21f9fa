"""What an effect of ``blind.mujoco_plant.effects`` adds to the mechanism of this plant.

Effects that change the arm's parameters or its sensors alone are what they are in the other plant.
"""

from collections.abc import Callable

import numpy as np

from blind.moreau_plant.mechanism import Mechanism
from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.effects.sensors import about


def realise(effect: Effect, m: Mechanism, rng: np.random.Generator, duration: float) -> Mechanism:
    """The mechanism with an effect.

    Args:
        effect: with an amount that is not zero.
        m: without it.
        rng: of what the effect draws for each recording.
        duration: of the recording [s].

    Raises:
        ValueError: this plant does not know it.
    """
    if effect.name in FIELDS:
        return m._replace(**{FIELDS[effect.name]: float(effect.amount)})
    if effect.name in FIELDS_OF_JOINTS and effect.joint is not None:
        return m.at(FIELDS_OF_JOINTS[effect.name], effect.joint, effect.amount)
    if effect.name in DRAWN:
        return DRAWN[effect.name](effect, m, rng, duration)
    if any(getattr(type(effect), hook) is not getattr(Effect, hook) for hook in ("build", "pull", "act")):
        raise ValueError(f"this plant does not know the effect {effect.name}")
    return m


def remounted_base(effect: Effect, m: Mechanism, rng: np.random.Generator, _: float) -> Mechanism:
    (turned,) = about(effect.amount, rng, 1)
    return m._replace(base_tilt=m.base_tilt + float(turned))


def dropping_load(effect: Effect, m: Mechanism, rng: np.random.Generator, duration: float) -> Mechanism:
    return m._replace(dropping=float(effect.amount), drop_at=duration * rng.uniform(0.25, 0.5))


def shaken_base(effect: Effect, m: Mechanism, rng: np.random.Generator, _: float) -> Mechanism:
    rate, phase = 2 * np.pi * rng.uniform(4, 7), rng.uniform(0, 2 * np.pi)
    return m._replace(shake=float(effect.amount), shake_rate=rate, shake_phase=phase)


def tension_scale(effect: Effect, m: Mechanism, _: np.random.Generator, __: float) -> Mechanism:
    return m._replace(shown=m.shown * np.array([1 + effect.amount, 1 + effect.amount / 2]))


FIELDS = {
    "hardening_spring": "hardening",
    "tip_payload": "load",
    "base_compliance": "base_compliance",
    "presliding": "presliding",
    "load_friction": "load_friction",
    "quadratic_drag": "drag",
    "sensor_cable": "strap",
    "elastic_cable": "compliance",
    "slack_cable": "sag",
    "actuator_lag": "lag",
}
FIELDS_OF_JOINTS = {"backlash": "clearance", "magnet": "magnet", "rubbing_disc": "rubbing", "kinked_spring": "kink"}
DRAWN: dict[str, Callable[[Effect, Mechanism, np.random.Generator, float], Mechanism]] = {
    "remounted_base": remounted_base,
    "dropping_load": dropping_load,
    "shaken_base": shaken_base,
    "tension_scale": tension_scale,
}

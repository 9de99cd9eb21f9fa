"""Names of effects and of their values for people; model files and code know them by ids."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final, NamedTuple

from continuum.languages import ENGLISH, Message, Translator


class _Name(NamedTuple):
    """Of an effect of the whole arm, of one joint or link, of several, and of all."""

    whole: Message
    one: str = ""
    several: str = ""
    every: str = ""


_NAMES: Final = {
    "actuator_lag": _Name(Message("late motors")),
    "angle_offset": _Name(
        Message("wrong zeros of sensors"), Message("wrong sensor zero of joint {joints}"),
        Message("wrong sensor zeros of joints {joints}"), Message("wrong sensor zeros of all joints"),
    ),
    "backlash": _Name(
        Message("play in joints"), Message("play in joint {joints}"), Message("play in joints {joints}"),
        Message("play in all joints"),
    ),
    "base_compliance": _Name(Message("soft mount of the base plate")),
    "base_tilt": _Name(Message("base plate out of level")),
    "capstan": _Name(Message("friction of the cables in their holes")),
    "elastic_cable": _Name(Message("stretching cables")),
    "gyro_drift": _Name(
        Message("drifting gyros"), Message("drifting gyro of joint {joints}"),
        Message("drifting gyros of joints {joints}"), Message("drifting gyros of all joints"),
    ),
    "hardening_spring": _Name(Message("springs that stiffen when bent far")),
    "held_cable": _Name(Message("slack cable that goes taut")),
    "inertia": _Name(
        Message("weight of links"), Message("weight of link {joints}"), Message("weight of links {joints}"),
        Message("weight of all links"),
    ),
    "joint_friction": _Name(
        Message("friction of joints"), Message("friction of joint {joints}"), Message("friction of joints {joints}"),
        Message("friction of all joints"),
    ),
    "joint_stiffness": _Name(
        Message("springs of joints"), Message("spring of joint {joints}"), Message("springs of joints {joints}"),
        Message("springs of all joints"),
    ),
    "load_friction": _Name(Message("joint friction that grows with the load")),
    "presliding": _Name(Message("give of joints that stick")),
    "quadratic_drag": _Name(Message("drag that grows with the square of speed")),
    "remounted_base": _Name(Message("base plate hung differently in every run")),
    "rest_angle": _Name(
        Message("rest angles of springs"), Message("rest angle of joint {joints}"),
        Message("rest angles of joints {joints}"), Message("rest angles of all joints"),
    ),
    "rotor_inertia": _Name(
        Message("rotors of drives"), Message("rotor of the drive of joint {joints}"),
        Message("rotors of the drives of joints {joints}"), Message("rotors of the drives of all joints"),
    ),
    "sensor_cable": _Name(Message("charging cable of the sensors")),
    "sensor_delay": _Name(
        Message("late sensors"), Message("late sensor of joint {joints}"), Message("late sensors of joints {joints}"),
        Message("late sensors of all joints"),
    ),
    "sensor_scale": _Name(
        Message("wrong scale of sensors"), Message("wrong scale of sensor {joints}"),
        Message("wrong scale of sensors {joints}"), Message("wrong scale of all sensors"),
    ),
    "slack_cable": _Name(Message("loose cables")),
    "tension_scale": _Name(Message("wrong scale of the recorded cable pull")),
    "tip_payload": _Name(Message("weight at the tip")),
}  # fmt: skip
_VALUE = re.compile(r"(?:(?P<effect>\w+)\.)?(?P<parameter>\w+)(?:\[(?P<joint>\d+)\])?")


def effect_in_words(
    effect: str, joints: Sequence[int] | None = None, n_joints: int | None = None, tr: Translator = ENGLISH
) -> str:
    """An effect's name and where it acts, as "spring of joint 3".

    An effect that another package brings is called by its id without underscores.

    Args:
        effect: id.
        joints: at which it acts, from 0; None where it belongs to the whole arm.
        n_joints: of the arm; where it acts at all of them, these are not counted one by one.
    """
    name = _NAMES.get(effect, _Name(Message(effect.replace("_", " "))))
    if joints is None:
        return tr(name.whole)
    numbers = [str(joint + 1) for joint in joints]
    if not name.one:
        values = {"effect": name.whole, "joints": listed(numbers, tr)}
        return tr.plural("{effect} at joint {joints}", "{effect} at joints {joints}", len(numbers), **values)
    if len(numbers) == 1:
        return tr(name.one, joints=numbers[0])
    if len(numbers) == n_joints:
        return tr(name.every)
    return tr(name.several, joints=listed(numbers, tr))


def sets_in_words(
    sets: Sequence[Sequence[str]], n_joints: int | None = None, tr: Translator = ENGLISH
) -> tuple[list[str], str]:
    """Names of what is in each set besides what is in all, and of what is in all.

    Args:
        sets: labels as `Cause.label` writes them.
        n_joints: of the arm.
    """
    common = [label for label in sets[0] if len(sets) > 1 and all(label in one for one in sets)] if sets else []
    if any(len(one) == len(common) for one in sets):
        common = []
    params = [[label for label in one if label not in common] for one in sets]
    together = [
        tr(" with ").join(label_in_words(label, n_joints, tr) for label in one) or tr("nothing") for one in params
    ]
    return together, listed([label_in_words(label, n_joints, tr) for label in common], tr)


def label_in_words(label: str, n_joints: int | None = None, tr: Translator = ENGLISH) -> str:
    """The name for a label as `Cause.label` writes it: "joint_stiffness@1,2" is "springs of joints 1 and 2"."""
    effect, _, where = label.partition("@")
    joints = [int(number) - 1 for number in where.split(",")] if where else None
    return effect_in_words(effect, joints, n_joints, tr)


def value_in_words(name: str, tr: Translator = ENGLISH) -> str:
    """The name for a value as `Diagnosis.correlation` has it: "inertia.mass[2]" is "weight of link 2, mass"."""
    found = _VALUE.fullmatch(name)
    if found is None:
        return name
    joint = int(found["joint"]) - 1 if found["joint"] else None
    if found["effect"]:
        where = None if joint is None else [joint]
        return f"{effect_in_words(found['effect'], where, tr=tr)}, {parameter_in_words(found['parameter'], tr=tr)}"
    return parameter_in_words(found["parameter"], joint, tr)


def parameter_in_words(name: str, joint: int | None = None, tr: Translator = ENGLISH) -> str:
    """A parameter's name and its joint, from 0: "viscous friction of joint 2"."""
    words = tr(name.replace("_", " "))
    return words if joint is None else tr("{parameter} of joint {joint}", parameter=words, joint=joint + 1)


def with_names(text: str, tr: Translator = ENGLISH) -> str:
    """A text with the name before each effect's id; ids that are plain words stay as they are."""
    return re.sub(r"\w+", lambda found: _named(found[0], tr), text)


def _named(word: str, tr: Translator) -> str:
    return f"{tr(_NAMES[word].whole)} ({word})" if "_" in word and word in _NAMES else word


def listed(words: Sequence[str], tr: Translator = ENGLISH) -> str:
    """Words with commas and one "and" between them."""
    if len(words) < 2:
        return "".join(words)
    return tr("{others} and {last}", others=", ".join(words[:-1]), last=words[-1])


def capital(text: str) -> str:
    """With a large first letter."""
    return text[:1].upper() + text[1:]


def small(text: str) -> str:
    """With a small first letter."""
    return text[:1].lower() + text[1:]

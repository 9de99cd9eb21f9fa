"""Names of effects and of their values for people; model files and code know them by ids."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final, NamedTuple


class _Name(NamedTuple):
    """Of an effect of the whole arm, of one joint or link, and of several."""

    whole: str
    one: str = ""
    several: str = ""


_NAMES: Final = {
    "actuator_lag": _Name("late motors"),
    "angle_offset": _Name("wrong zeros of sensors", "wrong sensor zero of joint {}", "wrong sensor zeros of joints {}"),
    "backlash": _Name("play in joints", "play in joint {}", "play in joints {}"),
    "base_compliance": _Name("soft mount of the base plate"),
    "base_tilt": _Name("base plate out of level"),
    "capstan": _Name("friction of the cables in their holes"),
    "elastic_cable": _Name("stretching cables"),
    "gyro_drift": _Name("drifting gyros", "drifting gyro of joint {}", "drifting gyros of joints {}"),
    "hardening_spring": _Name("springs that stiffen when bent far"),
    "held_cable": _Name("slack cable that goes taut"),
    "inertia": _Name("weight of links", "weight of link {}", "weight of links {}"),
    "joint_friction": _Name("friction of joints", "friction of joint {}", "friction of joints {}"),
    "joint_stiffness": _Name("springs of joints", "spring of joint {}", "springs of joints {}"),
    "load_friction": _Name("joint friction that grows with the load"),
    "presliding": _Name("give of joints that stick"),
    "quadratic_drag": _Name("drag that grows with the square of speed"),
    "remounted_base": _Name("base plate hung differently in every run"),
    "rest_angle": _Name("rest angles of springs", "rest angle of joint {}", "rest angles of joints {}"),
    "rotor_inertia": _Name("rotors of drives", "rotor of the drive of joint {}", "rotors of the drives of joints {}"),
    "sensor_cable": _Name("charging cable of the sensors"),
    "sensor_delay": _Name("late sensors", "late sensor of joint {}", "late sensors of joints {}"),
    "sensor_scale": _Name("wrong scale of sensors", "wrong scale of sensor {}", "wrong scale of sensors {}"),
    "slack_cable": _Name("loose cables"),
    "tension_scale": _Name("wrong scale of the recorded cable pull"),
    "tip_payload": _Name("weight at the tip"),
}
_VALUE = re.compile(r"(?:(?P<effect>\w+)\.)?(?P<parameter>\w+)(?:\[(?P<joint>\d+)\])?")


def effect_in_words(effect: str, joints: Sequence[int] | None = None, n_joints: int | None = None) -> str:
    """An effect's name and where it acts, as "spring of joint 3".

    An effect that another package brings is called by its id without underscores.

    Args:
        effect: id.
        joints: at which it acts, from 0; None where it belongs to the whole arm.
        n_joints: of the arm; where it acts at all of them, these are not counted one by one.
    """
    name = _NAMES.get(effect, _Name(effect.replace("_", " ")))
    if joints is None:
        return name.whole
    numbers = [str(joint + 1) for joint in joints]
    if not name.one:
        return f"{name.whole} at joint{'s' * (len(numbers) > 1)} {listed(numbers)}"
    if len(numbers) == 1:
        return name.one.format(*numbers)
    if len(numbers) == n_joints:
        return re.sub(r"(\w+) \{\}", r"all \1", name.several)
    return name.several.format(listed(numbers))


def sets_in_words(sets: Sequence[Sequence[str]], n_joints: int | None = None) -> tuple[list[str], str]:
    """Names of what is in each set besides what is in all, and of what is in all.

    Args:
        sets: labels as `Cause.label` writes them.
        n_joints: of the arm.
    """
    common = [label for label in sets[0] if len(sets) > 1 and all(label in one for one in sets)] if sets else []
    if any(len(one) == len(common) for one in sets):
        common = []
    params = [[label for label in one if label not in common] for one in sets]
    together = [" with ".join(label_in_words(label, n_joints) for label in one) or "nothing" for one in params]
    return together, listed([label_in_words(label, n_joints) for label in common])


def label_in_words(label: str, n_joints: int | None = None) -> str:
    """The name for a label as `Cause.label` writes it: "joint_stiffness@1,2" is "springs of joints 1 and 2"."""
    effect, _, where = label.partition("@")
    joints = [int(number) - 1 for number in where.split(",")] if where else None
    return effect_in_words(effect, joints, n_joints)


def value_in_words(name: str) -> str:
    """The name for a value as `Diagnosis.correlation` has it: "inertia.mass[2]" is "weight of link 2, mass"."""
    found = _VALUE.fullmatch(name)
    if found is None:
        return name
    parameter = found["parameter"].replace("_", " ")
    joints = [int(found["joint"]) - 1] if found["joint"] else None
    if found["effect"]:
        return f"{effect_in_words(found['effect'], joints)}, {parameter}"
    return parameter + (f" of joint {found['joint']}" if joints else "")


def with_names(text: str) -> str:
    """A text with the name before each effect's id; ids that are plain words stay as they are."""
    return re.sub(r"\w+", lambda found: _named(found[0]), text)


def _named(word: str) -> str:
    return f"{_NAMES[word].whole} ({word})" if "_" in word and word in _NAMES else word


def listed(words: Sequence[str], last: str = "and") -> str:
    """Words with commas and one "and" between them."""
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} {last} {words[-1]}"


def capital(text: str) -> str:
    """With a large first letter."""
    return text[:1].upper() + text[1:]


def small(text: str) -> str:
    """With a small first letter."""
    return text[:1].lower() + text[1:]

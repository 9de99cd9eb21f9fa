"""Effects hidden in the data of two independent plants are found, and none that is not there.

The diagnosis is handed files only. Each case hides a large effect of another kind, a pair, one from outside of the
library, or nothing. `make bench-discovery` measures how often the diagnosis is right over all effects and sizes.
"""

import pytest

from tools.benchmarks.discovery.answer import Answer, answer, label
from tools.benchmarks.discovery.cases import run_case
from tools.benchmarks.discovery.plans import Plan

pytestmark = pytest.mark.hidden_effects

FIRST_SEED = 8000
FOUND = (Answer.RIGHT, Answer.SET)

HIDDEN = (
    (("joint_stiffness",), FOUND),
    (("joint_friction",), FOUND),
    (("capstan",), FOUND),
    (("elastic_cable",), FOUND),
    (("slack_cable",), FOUND),
    (("tip_payload",), FOUND),
    (("sensor_scale",), FOUND),
    (("angle_offset",), FOUND),
    (("actuator_lag",), FOUND),
    (("quadratic_drag",), FOUND),
    (("backlash",), FOUND),
    (("base_tilt",), FOUND),
    ((), (Answer.RIGHT,)),
    ((), (Answer.RIGHT,)),
    (("rubbing_disc",), (Answer.RIGHT,)),
    (("shaken_base",), (Answer.RIGHT,)),
    (("rest_angle", "joint_friction"), (*FOUND, Answer.PART)),
    (("tip_payload", "sensor_delay"), (*FOUND, Answer.PART)),
)
"""What is hidden, in one plant and the other by turns, and which answers are right."""

CASES = [
    (Plan(("mujoco", "moreau")[i % 2], effects, "large", "mixed", 2, "low", FIRST_SEED + i), right)
    for i, (effects, right) in enumerate(HIDDEN)
]


@pytest.mark.parametrize(
    ("plan", "right"), CASES, ids=[f"{'+'.join(plan.effects) or 'nothing'}-{plan.plant}" for plan, _ in CASES]
)
def test_what_is_hidden_is_found(plan: Plan, right: tuple[Answer, ...]) -> None:
    case = run_case(plan, "", limit=0)  # however busy the machine is
    named = "" if case.verdict is None else "; ".join(label(one["effects"]) for one in case.verdict["sets"])
    said = case.failure if case.verdict is None else f"{case.verdict['verdict']} {named}"
    assert answer(case.hidden, case.verdict) in right, f"{plan}: hidden {case.hidden}, said: {said}"

"""Arms that joint torques drive: friction that the model file lacks, rotors, one late sensor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pytest

from continuum.discovery import diagnose
from continuum.discovery.result import Diagnosis
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.recordings.recording import Recording

TIMES, NOISE = np.arange(0, 3, 1 / 120), np.deg2rad(0.1)


def pendulum(**values: object) -> Model:
    return load_model("double_pendulum.yaml").with_values(values)


def swings(model: Model, late: float = 0.0) -> list[Recording]:
    """Two runs under sines of torque; the second angle is read late [s]."""
    random, found = np.random.default_rng(5), list[Recording]()
    for number in range(2):
        frequency, phase = random.uniform(0.4, 2.0, (2, 3)), random.uniform(0, 6, (2, 3))
        wave = np.sin(2 * np.pi * frequency[:, :, None] * TIMES + phase[:, :, None]).sum(axis=1).T
        torques = JointTorques(TIMES, wave * [1.0, 0.4])
        moved = Simulator(model).run(np.zeros(4), TIMES, torques)
        theta = moved.theta.copy()
        theta[:, 1] = np.interp(TIMES - late, TIMES, theta[:, 1])
        read = theta + NOISE * random.standard_normal(theta.shape)
        found.append(Recording(f"run {number}", TIMES, read, torques=torques))
    return found


def answer(recordings: Sequence[Recording], model: Model, *effects: str) -> tuple[Diagnosis, Mapping[str, float]]:
    result = diagnose(recordings, model, effects, with_power=False)
    return result, {str(one): one.value for cause in result.causes for one in cause.estimates}


def labels(result: Diagnosis) -> list[list[str]]:
    return [[cause.label for cause in causes] for causes in result.sets]


RUBBING = {"coulomb_friction": [0.16, 0.09], "viscous_friction": [0.02, 0.01]}


def test_friction_that_a_file_lacks_is_named_at_each_joint_with_its_values() -> None:
    result, values = answer(swings(pendulum(**RUBBING)), pendulum(), "inertia", "angle_offset")
    assert labels(result) == [["joint_friction@1,2"]]
    for cause in result.causes:
        for one in cause.estimates:
            truth = RUBBING[one.name][one.joint or 0]
            assert one.low < truth < one.high, str(one)
    assert values["coulomb_friction[1]"] > 1.3 * values["coulomb_friction[2]"]
    extended = result.extended_model
    np.testing.assert_allclose(extended.values()["coulomb_friction"], RUBBING["coulomb_friction"], rtol=0.15)
    assert not np.any(result.refitted_model.values()["coulomb_friction"])
    assert not extended.effects


def test_friction_is_not_named_where_neither_file_nor_arm_has_it() -> None:
    result, _ = answer(swings(pendulum()), pendulum(), "inertia", "angle_offset")
    assert result.verdict.kind.value == "adequate"


def test_friction_of_the_file_is_refitted_and_not_named() -> None:
    given = pendulum(coulomb_friction=[0.08, 0.045], viscous_friction=[0.02, 0.01])
    result, _ = answer(swings(pendulum(**RUBBING)), given, "inertia", "angle_offset")
    assert result.verdict.kind.value == "adequate"


@pytest.mark.parametrize("joint", [1])
def test_a_rotor_is_reported_from_a_heavier_link_beyond_the_first_joint(joint: int) -> None:
    rotor = np.where(np.arange(2) == joint, 0.004, 0.0)
    result, values = answer(
        swings(pendulum(**RUBBING, rotor_inertia=rotor)), pendulum(**RUBBING), "inertia", "rotor_inertia"
    )
    assert labels(result) == [[f"rotor_inertia@{joint + 1}"]]
    p = pendulum().parameters
    of_link = float(p.inertia[joint] + p.mass[joint] * p.center_of_mass[joint] ** 2)
    assert values[f"rotor_inertia.ratio[{joint + 1}]"] * of_link == pytest.approx(0.004, rel=0.1)


def test_one_late_sensor_is_named_at_its_joint() -> None:
    model = pendulum(**RUBBING)
    result, values = answer(swings(model, late=0.01), model, "angle_offset", "gyro_drift", "sensor_delay")
    assert labels(result) == [["sensor_delay@2"]]
    assert values["sensor_delay.lag[2]"] == pytest.approx(0.01, rel=0.15)


@pytest.mark.parametrize(
    "values",
    [
        {"coulomb_friction": [0.16, 0.0], "viscous_friction": [0.02, 0.0]},
        {"coulomb_friction": 0.0, "viscous_friction": [0.03, 0.0]},
        {"stiffness": [0.0, 0.5], **RUBBING},
    ],
    ids=["friction at one joint", "viscous friction at one joint", "a spring at one joint"],
)
def test_a_file_that_is_right_is_adequate_whatever_its_joints_lack(values: dict[str, object]) -> None:
    model = pendulum(**values)
    result, _ = answer(swings(model), model, "inertia", "sensor_cable", "joint_friction")
    assert result.verdict.kind.value == "adequate"


def test_of_two_joints_one_rubs_more_or_the_other_less() -> None:
    """After releases of two joints, common friction three times as large with a third at joint 1 is the same."""
    given = pendulum(coulomb_friction=[0.04, 0.04], viscous_friction=[0.01, 0.01])
    stiff = given.with_values({"coulomb_friction": [0.04, 0.12], "viscous_friction": [0.01, 0.03]})
    random, recordings = np.random.default_rng(3), list[Recording]()
    for number, start in enumerate(([0.9, 0.3], [-0.5, 0.8], [0.4, -1.0])):
        moved = Simulator(stiff).run(np.array(start), TIMES)
        recordings.append(Recording(f"run {number}", TIMES, moved.theta + NOISE * random.standard_normal((360, 2))))
    result, _ = answer(recordings, given, "joint_friction", "inertia")
    assert sorted(labels(result)) == [["joint_friction@1"], ["joint_friction@2"]]


def test_a_last_link_that_is_a_lighter_point_mass_is_named() -> None:
    """A weight at its tip would be the same, but weighs more than nothing."""
    given = pendulum(mass=[0.5, 0.3], center_of_mass=[0.3, 0.2], inertia=[1e-4, 0.0], **RUBBING)
    result, values = answer(
        swings(given.with_values({"mass": [0.5, 0.24]})), given, "inertia", "tip_payload", "rotor_inertia"
    )
    assert ["inertia@2"] in labels(result)
    assert values["inertia.mass[2]"] == pytest.approx(-0.2, abs=0.03)

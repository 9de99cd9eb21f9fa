"""Models that joint torques drive: their files and inputs, and all that needs cables refuses them in one line."""

from pathlib import Path

import numpy as np
import pytest
from dynamics_laws import random_model

from continuum.dynamics.balance import balance
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.joint_torques import JointTorques, no_torques
from continuum.dynamics.live.live_arm import LiveArm
from continuum.dynamics.model import ActiveEffect, InputKind, Model
from continuum.dynamics.model_file import load_model, model_from_mapping, save_model
from continuum.dynamics.model_inputs import undriven
from continuum.dynamics.parameters import PARAMETERS
from continuum.dynamics.planar.rigid_body import coriolis_matrix, gravity_torque, inertia_matrix
from continuum.dynamics.pulled_posture import pulled_posture
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.statics.resting_arm import RestingArm
from continuum.dynamics.tensions import LET_GO, Tensions, slack
from continuum.errors import InvalidValueError

PENDULUM = load_model("double_pendulum.yaml")
ON_CABLES = {"actuator_lag", "capstan", "elastic_cable", "held_cable", "slack_cable", "tension_scale"}
STILL, SHORT = np.zeros(2), np.array([0.0, 0.01])


def with_torques(model: Model) -> Model:
    return Model(model.parameters, model.effects, inputs=InputKind.JOINT_TORQUES)


def defaults(name: str, n: int) -> ActiveEffect:
    effect = effect_named(name)
    sizes = {key: n if spec.per_joint else 1 for key, spec in effect.parameters.items()}
    return ActiveEffect(effect, {key: np.full(sizes[key], effect.parameters[key].default) for key in sizes})


def test_torques_stand_on_the_right_of_eq_12_and_cables_are_let_go() -> None:
    cables = random_model(61, 3)
    x, v, torque = (np.random.default_rng(k).normal(size=size) for k, size in enumerate((6, 3, 3)))
    loose = balance(cables, x, v, np.full(2, LET_GO))
    np.testing.assert_allclose(balance(with_torques(cables), x, v, torque), loose - torque, rtol=1e-12)


def test_the_model_of_the_double_pendulum_is_its_makers() -> None:
    """Their own closed form, of inertias about the joints."""
    m, d, c, about_joint = (0.559, 0.604), (0.3, 0.2), (0.3, 0.184), (0.0535, 0.0239)
    p = PENDULUM.parameters
    assert np.all(p.inertia > 0)
    np.testing.assert_allclose(p.inertia + p.mass * p.center_of_mass**2, about_joint, rtol=1e-12)
    np.testing.assert_array_equal(p.joint_spacing, d)
    assert (PENDULUM.inputs, PENDULUM.n_inputs, p.has_cables) == (InputKind.JOINT_TORQUES, 2, False)
    assert set(PENDULUM.sources) >= {"mass", "inertia", "center_of_mass", "link_length", "rotor_inertia"}
    for q, w in np.random.default_rng(3).normal(size=(5, 2, 2)):
        h, both = m[1] * d[0] * c[1], about_joint[1] + m[1] * d[0] * c[1] * np.cos(q[1])
        whole = about_joint[0] + about_joint[1] + m[1] * d[0] ** 2 + 2 * h * np.cos(q[1])
        M = np.array([[whole, both], [both, about_joint[1]]])
        C = h * np.sin(q[1]) * np.array([[-2 * w[1], -w[1]], [w[0], 0.0]])
        beyond = m[1] * c[1] * np.sin(q.sum())
        G = 9.81 * np.array([(m[0] * c[0] + m[1] * d[0]) * np.sin(q[0]) + beyond, beyond])
        angle = np.cumsum(q)
        np.testing.assert_allclose(inertia_matrix(angle, p), M, rtol=1e-12)
        np.testing.assert_allclose(coriolis_matrix(angle, np.cumsum(w), p) @ w, C @ w, rtol=1e-10, atol=1e-14)
        np.testing.assert_allclose(gravity_torque(angle, p), G, rtol=1e-12)


def test_files_say_what_drives_the_arm(tmp_path: Path) -> None:
    for model in (PENDULUM, with_torques(random_model(62, 2)), random_model(62, 2)):
        save_model(model, tmp_path / "model.yaml")
        found = load_model(tmp_path / "model.yaml")
        assert (found.inputs, found.n_inputs) == (model.inputs, 2)
        assert list(found.values()) == list(model.values())
        for name, value in model.values().items():
            np.testing.assert_array_equal(found.values()[name], value)
    assert load_model("lamecc_prototype.yaml").inputs is InputKind.CABLES


def block(**more: object) -> dict[str, object]:
    values = {"mass": 0.5, "inertia": 0.003, "center_of_mass": 0.1, "link_length": 0.3}
    given = {name: {"value": value, "unit": PARAMETERS[name].unit} for name, value in values.items()}
    return {"n_joints": 2, "parameters": given, **more}


def test_a_chain_without_cables_is_driven_by_torques_unless_its_file_says_otherwise() -> None:
    assert model_from_mapping(block()).inputs is InputKind.JOINT_TORQUES
    with pytest.raises(InvalidValueError, match=r"^parameters\.half_spacing is None; .* inputs are joint_torques"):
        model_from_mapping(block(inputs="cables"))
    forgotten = block()
    forgotten["parameters"]["half_spacing"] = {"value": 0.02, "unit": "m"}  # type: ignore[index]
    with pytest.raises(InvalidValueError, match=r"^parameters\.hole_radius is None"):
        model_from_mapping(forgotten)
    for wrong in ("torques", 1, ["cables"], True):
        with pytest.raises(InvalidValueError, match=r"^inputs is .*; allowed: cables or joint_torques$"):
            model_from_mapping(block(inputs=wrong))


def test_effects_on_cables_are_refused_and_all_others_taken() -> None:
    """One that is taken can be simulated on a chain that has neither discs nor cables."""
    refused = set()
    for name in effect_names():
        effects = (defaults(name, 2),)
        try:
            model = Model(PENDULUM.parameters, effects, inputs=InputKind.JOINT_TORQUES)
        except InvalidValueError:
            refused.add(name)
            continue
        x = np.concatenate([[0.3, -0.2, 0.5, 0.1], np.zeros(model.n_states)])
        v, u = np.zeros(2 + model.n_states), np.array([0.2, -0.1])
        np.testing.assert_allclose(balance(model, x, v, u)[:2], balance(PENDULUM, x[:4], v[:2], u), atol=1e-3)
    assert refused == ON_CABLES
    with pytest.raises(InvalidValueError, match=r"^effect is 'capstan'; allowed: .*joint_torques$"):
        model_from_mapping(block(effects={"capstan": {}}))


def test_what_pulls_cables_refuses_a_model_with_torques() -> None:
    model = with_torques(random_model(63, 2))
    for use in (RestingArm, lambda given: LiveArm(given, STILL), lambda given: pulled_posture(given, 0.3)):
        with pytest.raises(InvalidValueError, match="input of the model is 'joint_torques'; allowed: cables, which"):
            use(model)  # type: ignore[operator]


def test_inputs_of_another_kind_or_number_are_refused() -> None:
    cables, pulls = random_model(64, 2), Tensions([0.0], [[1.0, 0.0]])
    with pytest.raises(InvalidValueError, match="kind of inputs is 'tensions of cables'; allowed: joint torques"):
        Simulator(PENDULUM).run(STILL, SHORT, pulls)
    with pytest.raises(InvalidValueError, match="kind of inputs is 'joint torques'; allowed: tensions of cables"):
        Simulator(cables).run(STILL, SHORT, no_torques(2))
    with pytest.raises(InvalidValueError, match="number of joint torques is 3; allowed: 2"):
        Simulator(PENDULUM).run(STILL, SHORT, no_torques(3))
    np.testing.assert_array_equal(undriven(cables).values, slack().values)
    np.testing.assert_array_equal(undriven(PENDULUM).values, [[0.0, 0.0]])


def test_torques_may_be_negative_and_must_be_finite() -> None:
    found = JointTorques([0.0, 1.0], [[-1.0, 2.0, 0.0], [3.0, 2.0, -4.0]])
    np.testing.assert_array_equal(found.at(0.5), [1.0, 2.0, -2.0])
    np.testing.assert_array_equal(found.later(1.0).at(1.5), found.at(0.5))
    for values in ([[np.nan, 0.0], [0.0, 0.0]], [[0.0, 0.0]], [0.0, 0.0], [["much", 0.0], [0.0, 0.0]]):
        with pytest.raises(InvalidValueError, match="allowed"):
            JointTorques([0.0, 1.0], values)


def test_compiled_equations_serve_only_models_of_the_same_structure() -> None:
    simulator = Simulator(PENDULUM)
    heavier = PENDULUM.with_values({"mass": 1.0})
    assert simulator.around(heavier).run(STILL, SHORT).states.shape == (2, 4)
    with pytest.raises(InvalidValueError, match="same joints and inputs"):
        simulator.around(PENDULUM.with_values({"half_spacing": 0.1}))

"""An arm file in space: its geometry is that of the kinematics, and one section in its plane is the planar model."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.arm import load_arm
from continuum.dynamics.spatial.arm_model import load_arm_model
from continuum.dynamics.spatial.simulation import CableCommands, path_lengths, simulate_arm, tip_poses
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import FileError, InvalidValueError
from continuum.kinematics.discs import arm_disc_poses, even_bends
from continuum.kinematics.routing import tangle

THREE = load_arm_model("three_sections.yaml")
ARM = load_arm("three_sections.yaml")
PLAIN = {"n_joints": 2, "b": 0.02, "a": 0.03, "mass": 0.1, "inertia": 1e-5, "bend_limit": 1.0}


def arm_file(folder, sections, **others) -> str:
    names = list(sections)
    blocks = "\n".join(f"  {name}: {dict(values)}" for name, values in sections.items())
    path = folder / "arm.yaml"
    path.write_text(f"arm:\n  sections: {names}\n{blocks}\n".replace("'", ""))
    return str(path)


UNLIKE = {
    "one": {"n_joints": 2, "b": 0.02, "a": 0.03, "twist": 0.4, "cable_azimuths": [0.2, 2.3, 4.4]},
    "two": {"n_joints": 3, "b": 0.015, "a": 0.025, "twist": -0.7, "cable_azimuths": [0.0, 1.5, 3.0, 4.5]},
    "tip": {"n_joints": 1, "b": 0.01, "a": 0.02, "twist": 0.3, "bend_limit": 0.5},
}
OTHERS = {"mass": 0.1, "inertia": 1e-5, "bend_limit": 1.0, "dynamics": {"center_of_mass": 0.01, "stiffness": 0.5}}


@pytest.fixture
def unlike(tmp_path):
    """An arm whose sections differ in everything."""
    path = arm_file(tmp_path, {name: {**OTHERS, **values} for name, values in UNLIKE.items()})
    return load_arm_model(path), load_arm(path)


@pytest.mark.parametrize("w", [[[0.4, 0.0], [0.0, -0.7], [0.3, 0.0]], [[0.0, 0.8], [0.8, 0.0], [0.0, 0.3]]])
def test_the_geometry_of_unlike_sections_is_that_of_the_kinematics(unlike, w):
    model, arm = unlike
    w = np.array(w)
    q = model.bent(w)[None]
    bends = [even_bends(bend, section) for bend, section in zip(w, arm.sections, strict=True)]
    position, rotation = tip_poses(model, q)
    np.testing.assert_allclose(position[0], arm_disc_poses(bends, arm)[-1][-1][:3, 3], atol=1e-12)
    np.testing.assert_allclose(rotation[0], arm_disc_poses(bends, arm)[-1][-1][:3, :3], atol=1e-12)
    np.testing.assert_allclose(path_lengths(model, q)[0], tangle(w, arm), atol=1e-12)


@given(st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6))
def test_an_arm_that_bends_in_any_direction_is_where_the_kinematics_have_it(w):
    """All but its roll about its own axis, which a universal joint adds."""
    w = np.reshape(w, (3, 2))
    bends = [even_bends(bend, section) for bend, section in zip(w, ARM.sections, strict=True)]
    pose = arm_disc_poses(bends, ARM)[-1][-1]
    position, rotation = tip_poses(THREE, THREE.bent(w)[None])
    np.testing.assert_allclose(position[0], pose[:3, 3], atol=1e-12)
    np.testing.assert_allclose(rotation[0][:, 2], pose[:3, 2], atol=1e-12)
    found = THREE.bends(THREE.bent(w)[None])[0]
    np.testing.assert_allclose(np.hypot(*found.T), np.hypot(*w.T), atol=1e-7)
    np.testing.assert_allclose(found[0], w[0], atol=1e-7)


@pytest.mark.parametrize("w", [[[0.4, 0.0], [0.0, -0.7], [0.9, 0.0]], [[0.0, 1.2], [0.8, 0.0], [0.0, 0.3]]])
def test_poses_and_cable_lengths_are_those_of_the_kinematics(w):
    """Exactly where each section bends about one of its axes."""
    w = np.array(w)
    q = THREE.bent(w)[None]
    pose = arm_disc_poses([even_bends(bend, section) for bend, section in zip(w, ARM.sections, strict=True)], ARM)[-1][
        -1
    ]
    position, rotation = tip_poses(THREE, q)
    np.testing.assert_allclose(position[0], pose[:3, 3], atol=1e-12)
    np.testing.assert_allclose(rotation[0], pose[:3, :3], atol=1e-12)
    np.testing.assert_allclose(path_lengths(THREE, q)[0], tangle(w, ARM), atol=1e-12)


@pytest.mark.parametrize("n_joints", [10, 20, 40])
def test_a_long_arm_that_is_let_go_moves(tmp_path, n_joints):
    """All joints stick at first, and any of them may break loose."""
    module = {"n_joints": n_joints, "b": 0.01925, "a": 0.032, "mass": 0.22257, "inertia": 79e-6, "bend_limit": 1.0}
    module["dynamics"] = {"center_of_mass": 0.01925, "stiffness": 1.2379, "viscous_friction": 0.0314}
    module["dynamics"] |= {"coulomb_friction": 0.0413, "stribeck_gain": 0.75, "capstan_friction": 0.2}
    model = load_arm_model(arm_file(tmp_path, {"one": module, "two": module, "tip": module}))
    commands = CableCommands(np.zeros(1), np.linspace(0.0, 5.0, 12)[None])
    motion = simulate_arm(model, model.bent([[0.3, 0.0], [0.0, 0.3], [-0.2, 0.2]]), np.array([0.0, 0.05]), commands)
    assert motion.status is SimulationStatus.COMPLETE
    assert np.abs(motion.v[-1]).max() > 0.1


def test_the_error_is_estimated_at_any_rate_of_output():
    q0 = THREE.bent([[0.3, 0.0], [0.0, 0.3], [-0.2, 0.2]])
    for rate in (10, 120, 5000):
        motion = simulate_arm(THREE, q0, np.arange(rate // 10 + 1) / rate)
        assert motion.error > 1e-9
        assert motion.step <= 5e-4 * (1.0 + 1e-9)


def test_a_spring_at_rest_and_gravity_bend_towards_cable_1(tmp_path):
    section = {**PLAIN, "cable_azimuths": [1.0, 3.0, 5.0]}
    dynamics = {"center_of_mass": 0.02, "stiffness": 5.0, "viscous_friction": 0.05}
    for extra in ({"rest_angle": 0.2, "gravity": 0.0}, {"hang_angle": -2.0}):
        path = arm_file(tmp_path, {"one": {**section, "dynamics": {**dynamics, **extra}}, "tip": {**section,
                        "dynamics": dynamics}})  # fmt: skip
        model = load_arm_model(path)
        end = simulate_arm(model, np.zeros(model.n), np.array([0.0, 3.0])).q[-1:]
        x, y, _ = tip_poses(model, end)[0][0]
        assert np.arctan2(y, x) == pytest.approx(1.0, abs=0.02)  # u and v of a joint are no rotation vector


def test_a_pull_bends_towards_the_cable_and_all_sections_before_it():
    times = np.array([0.0, 2.0])
    for cable in range(3):
        tensions = np.full(12, 2.0)
        tensions[8 + cable] = 12.0
        motion = simulate_arm(THREE, np.zeros(30), times, CableCommands(np.zeros(1), tensions[None]))
        azimuth = sum(section.twist for section in ARM.sections) + ARM.sections[2].cable_azimuths[cable]
        x, y, _ = tip_poses(THREE, motion.q[-1:])[0][0]
        assert motion.status is SimulationStatus.COMPLETE
        assert np.hypot(x, y) > 0.02
        assert abs(np.angle((x + 1j * y) / np.exp(1j * azimuth))) < 0.3


def test_commanded_tensions_change_between_the_rows_of_a_table():
    """The same commands in a table with more rows, and in other output times, give the same motion."""
    times = np.linspace(0.0, 0.3, 4)
    values = np.zeros((2, 12))
    values[1, 0] = 20.0
    coarse = CableCommands(np.array([0.05, 0.25]), values)
    at = np.array([0.05, 0.1, 0.15, 0.25])
    fine = CableCommands(at, coarse.over(at))
    one, other = (simulate_arm(THREE, np.zeros(30), times, commands) for commands in (coarse, fine))
    np.testing.assert_allclose(one.q, other.q, atol=2e-3)
    np.testing.assert_allclose(simulate_arm(THREE, np.zeros(30), times[[0, 3]], coarse).q[-1], one.q[-1], atol=2e-3)
    held = CableCommands(np.array([0.0, 0.1]), values, held=True)
    assert not simulate_arm(THREE, np.zeros(30), np.array([0.0, 0.1]), held).q.any()


def test_what_a_simulation_cannot_use_is_refused_in_one_line(tmp_path):
    dynamics = {"center_of_mass": 0.02, "stiffness": 1.0}
    with pytest.raises(FileError, match="block `dynamics:`"):
        load_arm_model(arm_file(tmp_path, {"one": PLAIN, "two": PLAIN}))
    with pytest.raises(InvalidValueError, match=r"arm\.two\.dynamics"):
        load_arm_model(arm_file(tmp_path, {"one": {**PLAIN, "dynamics": dynamics}, "two": PLAIN}))
    hanging = {**PLAIN, "dynamics": dynamics}
    upright = {**PLAIN, "dynamics": {**dynamics, "hang_angle": 3.0}}
    with pytest.raises(
        InvalidValueError, match=r"two\.dynamics\.hang_angle is 3\.0; allowed: left out, or 0 rad, as of one"
    ):
        load_arm_model(arm_file(tmp_path, {"one": hanging, "two": upright}))
    for commands, name in ((np.zeros((1, 3)), "number of commands"), (np.full((1, 12), -1.0), "command of a cable")):
        with pytest.raises(InvalidValueError, match=name):
            simulate_arm(THREE, np.zeros(30), np.array([0.0, 0.1]), CableCommands(np.zeros(1), commands))
    for step in (0.0, 1e-22, np.nan):
        with pytest.raises(InvalidValueError, match="step"):
            simulate_arm(THREE, np.zeros(30), np.array([0.0, 0.1]), step=step)
    for angles in (np.zeros(30), np.zeros((1, 6)), np.zeros((1, 31))):
        for function in (tip_poses, path_lengths):
            with pytest.raises(InvalidValueError, match=r"shape of the angles"):
                function(THREE, angles)
    with pytest.raises(InvalidValueError, match="initial angles"):
        simulate_arm(THREE, np.zeros(29), np.array([0.0, 0.1]))

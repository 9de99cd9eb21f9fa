"""An arm file in space: its geometry is that of the kinematics, and one section in its plane is the planar model."""

import numpy as np
import pytest

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
    with pytest.raises(InvalidValueError, match=r"arm\.two\.dynamics\.hang_angle is 3\.0; allowed: 0, as of one"):
        load_arm_model(arm_file(tmp_path, {"one": hanging, "two": upright}))
    for commands, name in ((np.zeros((1, 3)), "number of commands"), (np.full((1, 12), -1.0), "command of a cable")):
        with pytest.raises(InvalidValueError, match=name):
            simulate_arm(THREE, np.zeros(30), np.array([0.0, 0.1]), CableCommands(np.zeros(1), commands))
    with pytest.raises(InvalidValueError, match="step"):
        simulate_arm(THREE, np.zeros(30), np.array([0.0, 0.1]), step=0.0)
    with pytest.raises(InvalidValueError, match="initial angles"):
        simulate_arm(THREE, np.zeros(29), np.array([0.0, 0.1]))

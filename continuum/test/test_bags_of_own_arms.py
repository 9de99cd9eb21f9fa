"""Bags of other writers, with joints of any name: read by the model's names or by options, or refused by name."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import Captured, code, refused
from csv_runs import text_of
from hypothesis import given, settings
from hypothesis import strategies as st
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from continuum.cli import main
from continuum.discovery import diagnose
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import InputKind, Model, NamedJoint
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.simulator import Simulator
from continuum.errors import FileError
from continuum.recordings.read_recording import read_recording

STORE = get_typestore(Stores.ROS2_JAZZY)
JOINT_STATE = "sensor_msgs/msg/JointState"
BEGIN = 1_800_000_000_250_000_000
ROWS, RATE = 150, 100
FEW = 40  # rows that are enough to be read
T = np.arange(ROWS) / RATE


def joint_state(stamp: int, names: Sequence[str], **values: np.ndarray) -> Any:
    kind = STORE.types
    header = kind["std_msgs/msg/Header"](
        stamp=kind["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9), frame_id=""
    )
    fields = {
        field: np.ascontiguousarray(values.get(field, np.zeros(0)), dtype=float)
        for field in ("position", "velocity", "effort")
    }
    return kind[JOINT_STATE](header=header, name=list(names), **fields)


def bag(
    folder: Path,
    messages: Sequence[Any],
    topic: str = "/joint_states",
    others: Sequence[tuple[str, str]] = (),
    storage: StoragePlugin = StoragePlugin.MCAP,
) -> Path:
    """A recording by the writer of rosbags, with further topics that nobody spoke on."""
    with Writer(folder, version=9, storage_plugin=storage) as writer:
        for other, kind in others:
            writer.add_connection(other, kind, typestore=STORE)
        place = writer.add_connection(topic, JOINT_STATE, typestore=STORE)
        for number, one in enumerate(messages):
            writer.write(place, BEGIN + number, STORE.serialize_cdr(one, JOINT_STATE))
    return folder


def stamps(times: np.ndarray) -> list[int]:
    return [BEGIN + round(1e9 * one) for one in times]


def arm(n_joints: int, joints: Sequence[NamedJoint] = ()) -> Model:
    """A hanging chain with drives."""
    values = {"mass": 0.6, "inertia": 3e-3, "center_of_mass": 0.1, "link_length": 0.2, "viscous_friction": 0.05,
              "coulomb_friction": 0.02}  # fmt: skip
    parameters = Parameters(**{name: np.full(n_joints, value) for name, value in values.items()})
    return Model(parameters, inputs=InputKind.JOINT_TORQUES, joints=tuple(joints))


def swing(n_joints: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angles, rates and torques, (ROWS, n_joints) each."""
    phase = 5 * T[:, None] + np.arange(n_joints)
    return 0.4 * np.cos(phase), -2.0 * np.sin(phase), 0.3 * np.sin(3 * phase)


@settings(max_examples=20)
@given(st.data())
def test_readings_become_the_models_angles_by_name_sign_and_zero(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    """In any order, beside joints of a gripper."""
    n = data.draw(st.integers(1, 4))
    draws = st.tuples(st.sampled_from([1, -1]), st.floats(-3, 3))
    joints = [NamedJoint(f"axis {k}/left", *data.draw(draws)) for k in range(n)]
    order = data.draw(st.permutations(range(n + 1)))
    theta, rates, torques = (one[:FEW] for one in swing(n))
    sign, zero = (np.array([getattr(one, name) for one in joints]) for name in ("sign", "zero"))
    sent = {"position": sign * (theta - zero), "velocity": sign * rates, "effort": sign * torques}
    names = np.array([*(one.name for one in joints), "finger"])[order]
    columns = {field: np.column_stack([values, np.ones(FEW)])[:, order] for field, values in sent.items()}
    messages = [
        joint_state(stamp, names, **{field: values[row] for field, values in columns.items()})
        for row, stamp in enumerate(stamps(T[:FEW]))
    ]
    folder = bag(tmp_path_factory.mktemp("bags") / "run", messages)
    found = read_recording(folder, arm(n, joints))
    np.testing.assert_allclose(found.theta, theta, atol=1e-12)
    np.testing.assert_allclose(found.theta_rate, rates, atol=1e-12)
    np.testing.assert_allclose(found.torques.values, torques, atol=1e-12)
    np.testing.assert_allclose(found.times, T[:FEW], atol=1e-8)
    turned = [one.name for one in joints if (one.sign, one.zero) != (1, 0)]
    assert all(any(name in note for note in found.notes) for name in turned)
    plain = read_recording(folder, replace(arm(n, joints), joints=()), [one.name for one in joints])
    turns = np.round(sent["position"][0] / (2 * np.pi))  # a joint begins within half a turn of zero
    np.testing.assert_allclose(plain.theta, sent["position"] - 2 * np.pi * turns, atol=1e-12)


def test_a_model_whose_joints_are_partly_missing_is_not_read_by_the_workspaces_names(tmp_path: Path) -> None:
    """Their signs and zeros would be lost."""
    folder = bag(tmp_path / "run", plain(["section_1_theta_1", "section_1_theta_2"]))
    named = [NamedJoint("section_1_theta_1", -1.0, 0.5), NamedJoint("elbow")]
    with pytest.raises(FileError, match="and not elbow; the model file names section_1_theta_1, elbow"):
        read_recording(folder, arm(2, named))
    others = [NamedJoint("shoulder"), NamedJoint("elbow")]
    np.testing.assert_array_equal(read_recording(folder, arm(2, others)).theta, swing(2)[0])


@pytest.mark.parametrize("storage", list(StoragePlugin))
@pytest.mark.parametrize("topic", ["/joint_states", "/my/arm/joints"])
def test_a_bag_of_another_writer_is_its_table_and_has_its_verdict(
    tmp_path: Path, storage: StoragePlugin, topic: str
) -> None:
    decides = topic == "/joint_states" and storage is StoragePlugin.MCAP  # the verdict follows from the recording
    n, random = 7 if decides else 2, np.random.default_rng(7)
    true = arm(n).with_values({"viscous_friction": 0.09})
    runs = []
    for k in range(2):
        torques = JointTorques(T, 0.5 * np.sin(2 * np.pi * (1.0 + 0.4 * k) * T[:, None] + np.arange(n)))
        motion = Simulator(true).run(np.resize([0.6, -0.3], n) * (-1) ** k, T, torques)
        theta = motion.theta + 1e-3 * random.standard_normal((ROWS, n))
        names = [f"joint{j + 1}" for j in range(n)]
        folder = bag(
            tmp_path / f"run_{k}",
            [
                joint_state(stamp, names, position=theta[row], effort=torques.values[row])
                for row, stamp in enumerate(stamps(T))
            ],
            topic,
            storage=storage,
        )
        columns = {"t_s": T} | {f"q{j + 1}_rad": theta[:, j] for j in range(n)}
        columns |= {f"tau{j + 1}_Nm": torques.values[:, j] for j in range(n)}
        table = tmp_path / f"run_{k}.csv"
        table.write_text(text_of({name: [repr(float(one)) for one in values] for name, values in columns.items()}))
        runs.append((read_recording(folder, arm(n), names, topic), read_recording(table, arm(n))))
    for of_bag, of_table in runs:
        assert of_bag.name == of_table.name
        np.testing.assert_array_equal(of_bag.theta, of_table.theta)
        np.testing.assert_array_equal(of_bag.torques.values, of_table.torques.values)
        np.testing.assert_allclose(of_bag.times, of_table.times, atol=1e-9)
    if not decides:
        return
    of_bags, of_tables = (diagnose(each, arm(n), ["backlash"], with_power=False) for each in zip(*runs, strict=True))
    assert (of_bags.verdict.kind, of_bags.causes) == (of_tables.verdict.kind, of_tables.causes)
    for one, other in zip(of_bags.estimates, of_tables.estimates, strict=True):
        assert (one.name, one.value) == (other.name, pytest.approx(other.value, rel=0.01))


def plain(names: Sequence[str]) -> list[Any]:
    theta, rates, torques = swing(len(names))
    return [
        joint_state(stamp, names, position=theta[row], velocity=rates[row], effort=torques[row])
        for row, stamp in enumerate(stamps(T))
    ]


SEVEN = [f"joint{number}" for number in range(1, 8)]


def test_joints_without_known_names_are_listed_with_the_option_for_them(tmp_path: Path, capsys: Captured) -> None:
    folder, model = bag(tmp_path / "run", plain(SEVEN)), tmp_path / "arm.yaml"
    save_model(arm(7), model)
    line = refused(capsys, "diagnose", folder, "--model", model)
    for what in ("/joint_states", *SEVEN, f"--joints {','.join(SEVEN)}", "`joints:`"):
        assert what in line
    for words in ((), ("--model", model)):
        assert f"--joints {','.join(SEVEN)}" in refused(capsys, "view", folder, *words)
    save_model(arm(7, [NamedJoint(f"axis{number}") for number in range(1, 8)]), model)
    line = refused(capsys, "diagnose", folder, "--model", model)
    for what in (*SEVEN, "axis1", "axis7", "--joints"):
        assert what in line


def test_topics_are_listed_with_their_types_and_the_option_for_them(tmp_path: Path, capsys: Captured) -> None:
    others = [("/camera", "sensor_msgs/msg/Image"), ("/odom", "nav_msgs/msg/Odometry")]
    folder, model = bag(tmp_path / "run", plain(SEVEN), "/left/joint_states", others), tmp_path / "arm.yaml"
    save_model(arm(7), model)
    for words in ([], ["--topic", "/joint_states"], ["--topic", "/camera"]):
        line = refused(capsys, "identify", folder, "--model", model, *words)
        for what in ("/camera (sensor_msgs/msg/Image)", f"/left/joint_states ({JOINT_STATE})", "/odom"):
            assert what in line
        assert "--topic /left/joint_states" in line
    found = read_recording(folder, arm(7), SEVEN, "left/joint_states")
    np.testing.assert_array_equal(found.theta, swing(7)[0])


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["--joints", "joint1,joint2"], "7 different names"),
        (["--joints", ",".join([*SEVEN[:-1], "joint1"])], "7 different names"),
        (["--joints", ",".join([*SEVEN[:-1], "wrist"])], "not wrist"),
    ],
)
def test_names_that_do_not_fit_are_refused(tmp_path: Path, capsys: Captured, words: list[str], what: str) -> None:
    folder, model = bag(tmp_path / "run", plain(SEVEN)), tmp_path / "arm.yaml"
    save_model(arm(7), model)
    assert what in refused(capsys, "diagnose", folder, "--model", model, *words)


@pytest.mark.parametrize("words", [["--joints", "a,b"], ["--topic", "/joint_states"]])
def test_a_table_has_neither_names_nor_topics(tmp_path: Path, capsys: Captured, words: list[str]) -> None:
    table = tmp_path / "run.csv"
    table.write_text("t_s,q1_rad,q2_rad\n" + "".join(f"{t},{np.cos(5 * t)},0.3\n" for t in T))
    for command in ("diagnose", "identify", "view"):
        line = refused(capsys, command, table, "--model", "double_pendulum", *words)
        assert line.startswith(words[0])
        assert "rosbag2" in line


def test_names_of_the_workspace_are_still_read_where_a_model_has_others(tmp_path: Path) -> None:
    names = ["section_1_phi", "section_1_theta_1", "section_1_theta_2"]
    messages = plain(names)
    for one in messages:
        one.position[0] = one.velocity[0] = 0.0
    folder = bag(tmp_path / "run", messages)
    found = read_recording(folder, arm(2, [NamedJoint("hip"), NamedJoint("knee")]))
    np.testing.assert_array_equal(found.theta, swing(3)[0][:, 1:])
    with pytest.raises(FileError, match="hip"):
        read_recording(folder, arm(2), ["hip", "knee"])


def test_two_publishers_of_named_joints_are_refused_and_others_left_out(tmp_path: Path) -> None:
    mine, gripper = plain(["hip", "knee"]), plain(["finger"])
    mixed = [one for both in zip(mine, gripper, strict=True) for one in both]
    found = read_recording(bag(tmp_path / "mixed", mixed), arm(2), ["hip", "knee"])
    np.testing.assert_array_equal(found.theta, swing(2)[0])
    assert [note for note in found.notes if "finger" in note and str(ROWS) in note]
    twice = [one for one in mine for _ in range(2)]
    twice[1::2] = [joint_state(stamp + 1000, ["hip", "knee"], position=np.zeros(2)) for stamp in stamps(T)]
    with pytest.raises(FileError, match="two nodes"):
        read_recording(bag(tmp_path / "twice", twice), arm(2), ["hip", "knee"])


def test_a_model_of_a_description_reads_its_bags(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """From the URDF to the page of the recording, by names alone; the command of a diagnosis shows the same."""
    urdf = tmp_path / "arm.urdf"
    inertia = 'ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.001"'
    inertial = f'<inertial><origin xyz="0 0 -0.1"/><mass value="0.5"/><inertia {inertia}/></inertial>'
    joint = '<joint name="{}" type="continuous"><parent link="{}"/><child link="{}"/>'
    joint += '<origin xyz="{}"/><axis xyz="{}"/></joint>'
    urdf.write_text(
        f'<robot name="a"><link name="base"/><link name="upper">{inertial}</link><link name="lower">{inertial}</link>'
        + joint.format("shoulder", "base", "upper", "0 0 0", "0 1 0")
        + joint.format("elbow", "upper", "lower", "0 0 -0.2", "0 -1 0")
        + "</robot>"
    )
    model = tmp_path / "arm.yaml"
    assert main(["model", "from-urdf", str(urdf), "--out", str(model)]) == 0
    folder = bag(tmp_path / "run", plain(["elbow", "shoulder"]))
    found = read_recording(folder, load_model(model))
    theta = swing(2)[0]
    np.testing.assert_allclose(found.theta, np.stack([theta[:, 1], -theta[:, 0]], axis=1), atol=1e-12)
    shown: list[Any] = []

    def page(_arm: object, source: object, *_: object, **__: object) -> None:
        shown.append(source)
        raise FileError("page", "no page in this test")

    monkeypatch.setattr("continuum.viewer.page.Page", page)
    assert code("view", folder, "--model", model) == 2
    assert len(shown) == 1

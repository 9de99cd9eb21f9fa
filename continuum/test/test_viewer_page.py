"""The page: its address, its controls and what they say, without a browser."""

import csv
import socket

import numpy as np
import pytest

from continuum.errors import FileError, InvalidValueError
from continuum.kinematics.chain import arm_pose
from continuum.viewer import status_table
from continuum.viewer.hands import Hands
from continuum.viewer.page import Page
from continuum.viewer.remote_arm import RemoteArm
from continuum.viewer.section_angles import joints_of
from continuum.viewer.seen import Status
from continuum.viewer.tracks import Track, read_tracks
from continuum.viewer.usual_arm import usual_arm

ARM = usual_arm(2)


@pytest.fixture
def opened():
    pages = []

    def open_page(source):
        pages.append(Page(ARM, source, port=0))
        return pages[-1]

    yield open_page
    for page in pages:
        page.close()


def test_port_that_is_taken_is_refused():
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        with pytest.raises(InvalidValueError, match=f"127.0.0.1:{port}"):
            Page(ARM, Hands(ARM), port=port)


@pytest.mark.parametrize(("host", "port"), [("198.51.100.1", 0), ("127.0.0.1", 65536), ("no such host", 0)])
def test_address_that_is_none_of_this_machine_is_refused(host, port):
    with pytest.raises(InvalidValueError, match="allowed"):
        Page(ARM, Hands(ARM), host, port)


def test_target_leads_the_sliders_and_sliders_the_target(opened):
    source = Hands(ARM)
    page = opened(source)
    page.draw()
    controls = source._controls
    wanted = arm_pose(np.array([[0.3, -0.2], [0.5, 0.4]]), ARM)[:3, 3]
    controls._gizmo.position = wanted
    page.draw()
    np.testing.assert_allclose(arm_pose(controls.w, ARM)[:3, 3], wanted, atol=1e-5)
    np.testing.assert_allclose(page._scene.tip, wanted, atol=1e-5)
    controls._sliders[0].theta.value = 20.0
    page.draw()
    np.testing.assert_allclose(controls._gizmo.position, page._scene.tip, atol=1e-5)
    assert np.hypot(*controls.w[0]) == pytest.approx(np.radians(20.0))


def test_state_of_others_is_shown_and_nothing_asked_of_them(opened):
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    w = np.array([[0.1, 0.2], [-0.3, 0.1]])
    remote.tell(joints=joints_of(w, ARM), time=1.0)
    page.draw()
    np.testing.assert_allclose(page._scene.tip, arm_pose(w, ARM)[:3, 3], atol=1e-9)
    assert remote.target is None
    assert remote.posture is None
    assert set(remote.tensions.wanted().values()) == {0.0}


def test_measured_arm_is_the_ghost_of_the_simulated_one(opened):
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    simulated, measured = np.array([[0.1, 0.2], [-0.3, 0.1]]), np.array([[0.2, 0.2], [-0.3, 0.2]])
    remote.tell(joints=joints_of(measured, ARM), simulated=joints_of(simulated, ARM))
    page.draw()
    np.testing.assert_allclose(page._scene.tip, arm_pose(simulated, ARM)[:3, 3], atol=1e-9)
    np.testing.assert_allclose(page._ghost.poses[-1, :3, 3], arm_pose(measured, ARM)[:3, 3], atol=1e-9)


def test_cables_are_pulled_while_control_is_taken_and_slack_after(opened):
    remote = RemoteArm(ARM, 30.0)
    opened(remote)
    tensions, cable = remote.tensions, ARM.cable_names[0]
    tensions._sliders[cable].value = 12.0
    assert tensions.wanted()[cable] == 0.0
    tensions._taken.value = True
    assert tensions.wanted()[cable] == 0.0  # what was set before does not pull at once
    tensions._sliders[cable].value = 12.0
    assert tensions.wanted()[cable] == 12.0
    remote.let_go()
    assert not tensions.taken
    assert tensions.wanted()[cable] == 0.0


def test_words_of_others_are_text():
    table = status_table._table([Status("<script>alert(1)</script>", 9, "a < b")])
    assert "<script>" not in table
    assert "a &lt; b" in table


def test_values_hold_until_the_next():
    track = Track(np.array([0.0, 1.0]), ("a",), np.array([[1.0], [2.0]]))
    assert [track.at(t) for t in (-0.1, 0.0, 0.9, 1.0, 9.0)] == [{}, {"a": 1.0}, {"a": 1.0}, {"a": 2.0}, {"a": 2.0}]


def test_table_of_joint_angles_is_a_recording(tmp_path):
    path = tmp_path / "run.csv"
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["t_s", "q1_deg", "q2_deg"])
        writer.writerows([5.0 + 0.01 * k, k, -k] for k in range(50))
    tracks = read_tracks(path)
    assert tracks.duration == pytest.approx(0.49)
    assert tracks.joints.at(0.1) == pytest.approx(
        {"section_1_theta_1": np.radians(10.0), "section_1_theta_2": np.radians(-10.0)}
    )


def test_what_is_no_recording_is_told_in_one_line(tmp_path):
    with pytest.raises(FileError, match="metadata"):
        read_tracks(tmp_path)
    with pytest.raises(FileError, match="cannot be read"):
        read_tracks(tmp_path / "none.csv")


def test_trail_begins_anew_after_a_leap(opened):
    trail = opened(Hands(ARM))._tip_trail
    for x in np.arange(0.0, 0.1, 0.001):
        trail.follow(np.array([x, 0.0, 0.0]))
    pieces = trail._line.points
    np.testing.assert_allclose(pieces[1:, 0], pieces[:-1, 1])
    assert np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1).min() >= trail._step * 0.999
    trail.follow(np.array([0.0, 1.0, 0.0]))
    assert not trail._line.visible

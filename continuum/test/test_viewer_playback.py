"""A recording on the viewer's page: all of it that is to be seen, at the instant that the time slider says."""

import csv
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import recorded_runs as runs

from continuum.errors import FileError
from continuum.joint_names import theta_joints
from continuum.kinematics.chain import arm_pose
from continuum.viewer import playback, player
from continuum.viewer.default_arm import arm_of_joints
from continuum.viewer.motion_csv import motion_csv
from continuum.viewer.page import Page
from continuum.viewer.plot_data import LENGTHS, TENSIONS
from continuum.viewer.section_angles import configuration_of_joints, joints_of
from continuum.viewer.tracks import NOTHING, Track, read_tracks

pytestmark = pytest.mark.slow

SIMULATED = "/simulated/joint_states"
BENT = np.array([[0.2, 0.1], [0.3, -0.1]])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A run with a simulated arm at rest; tensions are published now and then; two messages are out of order."""
    topics = runs.run()
    topics[SIMULATED] = [runs.joint_state(stamp, BENT) for stamp in runs.STAMPS]
    names, tensions = list(runs.ARM.cable_names), np.arange(1.0, 1.0 + len(runs.ARM.cable_names))
    tension = [
        runs.message(runs.TYPES["/cable_states"], stamp, name=names, effort=tensions) for stamp in runs.STAMPS[::10]
    ]
    topics["/cable_states"] += tension
    joints = topics["/joint_states"]
    joints[30], joints[31] = joints[31], joints[30]
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(runs.TYPES, SIMULATED, runs.TYPES["/joint_states"])
        return runs.write(tmp_path_factory.mktemp("playback") / "run", topics)


def test_all_of_a_recording_is_found(folder):
    tracks = read_tracks(folder)
    assert tracks.duration == pytest.approx((runs.N - 1) / runs.RATE, abs=1e-6)
    w, row = runs.postures()[0], 30
    now = (row + 0.5) / runs.RATE
    np.testing.assert_allclose(configuration_of_joints(tracks.joints.at(now), runs.ARM), w[row], atol=1e-9)
    np.testing.assert_allclose(configuration_of_joints(tracks.simulated.at(now), runs.ARM), BENT, atol=1e-9)
    np.testing.assert_allclose(list(tracks.lengths.at(now).values()), runs.tangle(w[row], runs.ARM))
    np.testing.assert_allclose(list(tracks.tensions.at(now).values()), 1.0 + np.arange(len(runs.ARM.cable_names)))
    np.testing.assert_allclose(list(tracks.target.at(now).values()), runs.tips()[row])


class Shown:
    """The page of the recording, at a time of the machine that the test says."""

    def __init__(self, folder, monkeypatch, overlays=None):
        self._now = 100.0
        monkeypatch.setattr(player.time, "monotonic", lambda: self._now)
        self.source = playback.Playback(runs.ARM, read_tracks(folder), "run", overlays)
        self.page = Page(runs.ARM, self.source, port=0)
        self.player = self.source.player
        self.page.draw()

    def after(self, seconds):
        """The slider's time then [s]."""
        self._now += seconds
        self.page.draw()
        return self.player._slider.value


@pytest.fixture
def shown(folder, monkeypatch):
    shown = Shown(folder, monkeypatch)
    yield shown
    shown.page.close()


def test_what_was_recorded_is_shown(shown):
    assert shown.after(0.305) == pytest.approx(0.305)
    page, w = shown.page, runs.postures()[0][30]
    np.testing.assert_allclose(page._scene.tip, arm_pose(BENT, runs.ARM)[:3, 3], atol=1e-6)
    assert page._ghosts["/ghost"].visible
    np.testing.assert_allclose(page._ghosts["/ghost"].poses[-1, :3, 3], arm_pose(w, runs.ARM)[:3, 3], atol=1e-6)
    np.testing.assert_allclose(page._target.position, runs.tips()[30], atol=1e-6)
    own = len(runs.ARM.sections[0].cable_names)
    for title, values in ((LENGTHS, 1e3 * runs.tangle(w, runs.ARM)[:own]), (TENSIONS, 1.0 + np.arange(own))):
        times, *lines, cursor = shown.source._plots.plots.plot(title).plot.data
        np.testing.assert_allclose(np.diff(times).min(), 0.0)
        now = np.argmax(cursor)
        assert times[now] == pytest.approx(0.305)
        before = np.array(lines)[:, np.searchsorted(times, 0.3 + 1e-9) - 1]
        np.testing.assert_allclose(before, values, rtol=1e-6)


def test_time_goes_as_fast_as_chosen_stops_at_the_end_and_begins_again(shown):
    assert shown.after(0.1) == pytest.approx(0.1)
    shown.player._speed.value = "1/4"
    assert shown.after(0.4) == pytest.approx(0.2)
    shown.player.playing = False
    assert shown.after(9.0) == pytest.approx(0.2)
    shown.player.playing, shown.player._repeats.value = True, False
    assert shown.after(9.0) == pytest.approx(0.59)
    assert not shown.player.playing
    shown.player.playing = True
    assert shown.after(0.1) == 0.0


def test_it_is_played_again_and_again(shown):
    for _ in range(2):
        assert shown.after(9.0) == pytest.approx(0.59)
        assert shown.player.playing
        assert shown.after(0.1) == 0.0


def test_the_slider_says_the_time(shown):
    shown.player.playing = False
    shown.player._slider.value = 0.405
    shown.after(1.0)
    ghost = shown.page._ghosts["/ghost"].poses[-1, :3, 3]
    np.testing.assert_allclose(ghost, arm_pose(runs.postures()[0][40], runs.ARM)[:3, 3], atol=1e-6)


def test_steps_go_from_sample_to_sample_and_pause(shown):
    shown.after(0.305)
    for steps, row in ((1, 31), (1, 32), (-1, 31), (-100, 0), (1000, runs.N - 1)):
        shown.player._steps.put(steps)
        assert shown.after(0.1) == pytest.approx(row / runs.RATE)
        assert not shown.player.playing


def test_steps_go_on_where_another_motion_is_longer(folder, monkeypatch):
    tracks = read_tracks(folder)
    other = replace(tracks.joints, times=1.5 * tracks.joints.times)
    shown = Shown(folder, monkeypatch, {"longer": other})
    try:
        end, times = tracks.duration, [shown.after(0.5)]
        for step in [1] * 50 + [-1] * 5:
            shown.player._steps.put(step)
            times.append(shown.after(0.1))
        steps = np.diff(times)
        assert np.all(steps[:50] >= 0.0)
        assert np.all(steps[50:] < 0.0)
        assert max(times) == pytest.approx(1.5 * end, abs=1e-3)
    finally:
        shown.page.close()


def test_the_motion_is_saved_as_a_table(tmp_path):
    names = theta_joints("section_1", 2)
    arm = arm_of_joints(names)
    times, angles = np.arange(40) / 100, np.random.default_rng(0).uniform(-0.3, 0.3, (40, 2))
    file = tmp_path / "motion.csv"
    joints = Track(times, names, angles)
    file.write_text(motion_csv(joints, NOTHING, NOTHING, arm), encoding="utf-8")
    again = read_tracks(file)
    np.testing.assert_allclose(again.joints.times, times, atol=1e-9)
    np.testing.assert_allclose(again.joints.values, angles, atol=1e-8)


def columns_of(text, ending):
    """The columns of a table whose names end so, (n_rows, n)."""
    header, *rows = csv.reader(text.splitlines())
    chosen = [i for i, name in enumerate(header) if name.endswith(ending)]
    return np.array([[float(row[i] or "nan") for i in chosen] for row in rows])


def test_saved_cables_and_tip_are_those_of_their_row():
    """Also in a recording that is too long for the page to draw each of its cable lengths."""
    joints = joints_track(postures := np.random.default_rng(2).uniform(-0.3, 0.3, (5400, 2, 2)))
    text = motion_csv(joints, NOTHING, NOTHING, runs.ARM)
    rows = [0, 1, 2, 2700, 2701, 5398, 5399]
    lengths = [runs.tangle(postures[row], runs.ARM) for row in rows]
    np.testing.assert_allclose(columns_of(text, "_length_m")[rows], lengths, atol=1e-9)
    tips = [arm_pose(postures[row], runs.ARM)[:3, 3] for row in rows]
    tip = np.hstack([columns_of(text, f"tip_{axis}_m") for axis in "xyz"])
    np.testing.assert_allclose(tip[rows], tips, atol=1e-9)


def joints_track(postures):
    named = [joints_of(w, runs.ARM) for w in postures]
    return Track(np.arange(len(named)) / 100, tuple(named[0]), np.array([list(row.values()) for row in named]))


def test_with_a_simulated_arm_the_measured_one_is_saved(shown):
    files = []
    client = SimpleNamespace(send_file_download=lambda name, content, **_: files.append(content.decode()))
    shown.source._save(SimpleNamespace(client=client))
    (text,) = files
    tracks, (row, now) = shown.source._tracks, (30, 0.3)
    for ending, track, unit in (
        ("_deg", tracks.joints, np.degrees),
        ("_length_m", tracks.lengths, np.array),
        ("_tension_N", tracks.tensions, np.array),
    ):
        np.testing.assert_allclose(columns_of(text, ending)[row], unit(list(track.at(now + 1e-6).values())), atol=1e-6)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_target_that_is_no_place_is_reported(tmp_path, value):
    topics = runs.run()
    topics["/traj_pose"][3].pose.position.y = value
    with pytest.raises(FileError, match="traj_pose"):
        read_tracks(runs.write(tmp_path / "run", topics))


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

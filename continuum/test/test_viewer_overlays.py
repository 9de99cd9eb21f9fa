"""Motions that are compared on the viewer's page: other recordings, and open-loop simulations of one."""

from dataclasses import replace

import numpy as np
import pytest
import recorded_runs
import swing_bag

from continuum.dynamics.model_file import load_model
from continuum.dynamics.parameters import Parameters
from continuum.dynamics.simulator import Simulator
from continuum.errors import InvalidValueError
from continuum.joint_names import phi_joint, theta_joints
from continuum.recordings.bag import stamp_ns
from continuum.recordings.read_recording import read_recording
from continuum.recordings.recording import Recording
from continuum.viewer.default_arm import arm_of_joints
from continuum.viewer.open_loop import hangs, open_loop_track
from continuum.viewer.page import Page
from continuum.viewer.playback import Playback
from continuum.viewer.tracks import Track, Tracks, read_tracks

pytestmark = pytest.mark.slow

MODEL = load_model("lamecc_prototype.yaml")
NAMES = (*theta_joints("section_1", 5), phi_joint("section_1"))
TIMES = np.arange(0.0, 0.5, 1 / 120)


def run_of(model) -> Recording:
    return Recording("run", 3.0 + TIMES, Simulator(model).run(np.full(5, np.radians(12.0)), TIMES).theta)


def measured(recording, phi=0.0):
    plane = np.full((recording.times.size, 1), phi)
    return Track(recording.times - recording.times[0], NAMES, np.hstack([recording.theta, plane]))


def test_the_simulation_of_a_run_by_its_own_model_is_the_run():
    recording = run_of(MODEL)
    track = open_loop_track(recording, measured(recording, 0.7), MODEL, "model", 3.0)
    np.testing.assert_allclose(track.times, TIMES, atol=1e-12)
    np.testing.assert_allclose(
        track.values, measured(recording, 0.7).values, atol=np.radians(0.05)
    )  # the fitted beginning is not exact


def test_the_simulation_of_a_run_whose_tensions_begin_late_has_its_time(tmp_path):
    """Joint states without known tensions are left out at the start of the run, but not of what is drawn."""
    topics = swing_bag.swing()
    begin = swing_bag.STAMPS[18]
    topics["/cable_states"] = [one for one in topics["/cable_states"] if stamp_ns(one) >= begin]
    folder = recorded_runs.write(tmp_path / "run", topics)
    tracks, recording = read_tracks(folder), read_recording(folder)
    assert recording.times.size < tracks.joints.times.size
    names = theta_joints("section_1", swing_bag.JOINTS)
    section = {name: value[: swing_bag.JOINTS] for name, value in MODEL.parameters.named().items()}
    model = replace(MODEL, parameters=Parameters(**section))
    track = open_loop_track(recording, tracks.joints, model, "model", tracks.origin)
    for time, theta in zip(track.times, recording.theta, strict=True):
        drawn = tracks.joints.at(time + 1e-6)
        np.testing.assert_allclose([drawn[name] for name in names], theta, atol=1e-9)


def test_a_table_has_the_time_of_its_first_row(tmp_path):
    recording = run_of(MODEL)
    rows = np.column_stack([recording.times, np.degrees(recording.theta)])
    header = ",".join(["t_s", *(f"q{i}_deg" for i in range(1, 6))])
    np.savetxt(tmp_path / "run.csv", rows, delimiter=",", header=header, comments="")
    tracks = read_tracks(tmp_path / "run.csv")
    track = open_loop_track(read_recording(tmp_path / "run.csv"), tracks.joints, MODEL, "model", tracks.origin)
    np.testing.assert_allclose(track.times, tracks.joints.times)


def test_a_model_that_is_too_stiff_is_seen():
    recording = run_of(MODEL)
    stiff = MODEL.with_values({"stiffness": 1.5 * MODEL.parameters.stiffness})
    track = open_loop_track(recording, measured(recording), stiff, "model")
    assert np.abs(track.values - measured(recording).values).max() > np.radians(1.0)


def test_an_arm_of_two_sections_is_refused():
    recording = run_of(MODEL)
    other = replace(measured(recording), names=("a_theta_1", "b_theta_1", *NAMES[2:]))
    with pytest.raises(InvalidValueError, match="sections"):
        open_loop_track(recording, other, MODEL, "model")


@pytest.mark.parametrize(("angle", "is_hanging"), [(0.0, True), (np.pi, False), (0.3, True)])
def test_an_arm_hangs_where_gravity_pulls_it_off_its_base(angle, is_hanging):
    assert hangs(MODEL.with_values({"hang_angle": np.array([angle])})) is is_hanging


def test_each_motion_has_its_ghost_line_and_colour():
    motion = measured(run_of(MODEL))
    later = replace(motion, values=0.5 * motion.values)
    source = Playback(arm_of_joints(NAMES), Tracks(motion), "a", {"b": later, "c": motion})
    page = Page(arm_of_joints(NAMES), source, port=0)
    try:
        source.player.playing = False
        page.draw()
        assert sorted(page._ghosts) == ["/overlay_1", "/overlay_2"]
        solid, ghosts = page._scene.links.poses, [page._ghosts[name].poses for name in sorted(page._ghosts)]
        np.testing.assert_allclose(ghosts[1], solid)
        assert np.abs(ghosts[0] - solid).max() > 0.001
        plot = source._plots.plots.plot("Joint 1 [deg]").plot
        strokes = [series["stroke"] for series in plot.series[1:]]
        assert len(set(strokes)) == len(strokes) == 4  # three motions and the cursor
    finally:
        page.close()

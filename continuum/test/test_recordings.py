"""Reports, tables and pictures of recordings whose truth is known."""

import csv
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from recorded_runs import ARM, RATE, STAMPS, Topics, postures, read, run, write
from rosbags.rosbag2 import StoragePlugin

from continuum.kinematics.ik_result import IkStatus
from continuum.kinematics.routing import tangle, tangle_rates
from continuum.recordings.cable_figure import write_cable_figure
from continuum.recordings.cable_table import write_cable_table
from continuum.recordings.kinematic_report import KinematicReport, central_differences, report_on

pytestmark = pytest.mark.slow

N = len(STAMPS)

STREAMS = {
    "/traj_pose": "/traj_pose",
    "/traj_twist": "/traj_twist",
    "/joint_states": "/joint_states",
    "/ik_status": "/ik_status",
    "/cable_states": "/cable_states",
    "/section_cable_states": "/section_cable_states of section 1",
    "/section_config_states": "/section_config_states of section 1",
}
"""Topics, and what the stream of their first message is called."""

each_topic = pytest.mark.parametrize("topic", STREAMS)


def report(tmp_path: Path, topics: Topics, n_expected: int | None = None) -> KinematicReport:
    return report_on(read(write(tmp_path / "recording", topics)), n_expected)


def counted(counts: dict[str, int]) -> dict[str, int]:
    return {name: count for name, count in counts.items() if count}


@pytest.mark.parametrize("storage", list(StoragePlugin))
def test_a_run_without_a_fault(tmp_path: Path, storage: StoragePlugin) -> None:
    found = report_on(read(write(tmp_path / "recording", run(), storage)), N)
    assert (found.n_targets, found.n_solved) == (N, N)
    assert (found.rate, found.duration) == pytest.approx((RATE, (N - 1) / RATE))
    assert found.tip_error_max < 1e-12
    assert found.rate_disagreement_ratio < 1e-3
    assert found.largest_rate == pytest.approx(np.max(np.abs(tangle_rates(*postures(), ARM))))
    assert (
        set(found.lost) == set(found.repeated) == {*STREAMS.values(), *(s.replace("1", "2") for s in STREAMS.values())}
    )
    assert (counted(found.lost), counted(found.repeated), found.n_lost) == ({}, {}, 0)


def test_tip_error_is_the_distance_to_the_target(tmp_path: Path) -> None:
    offsets = np.full((N, 3), [1e-4, -2e-4, 2e-4])
    offsets[17] = [0.0, 3e-3, 4e-3]
    found = report(tmp_path, run(offsets))
    assert (found.tip_error_median, found.tip_error_max) == pytest.approx((3e-4, 5e-3), rel=1e-9)


def test_only_reached_poses_have_a_tip_error(tmp_path: Path) -> None:
    offsets = np.zeros((N, 3))
    offsets[17] = 0.1
    topics = run(offsets)
    topics["/ik_status"][17].status = int(IkStatus.UNREACHABLE)
    found = report(tmp_path, topics)
    assert found.n_solved == N - 1
    assert found.tip_error_max < 1e-12


def test_no_pose_reached(tmp_path: Path) -> None:
    topics = run()
    for status in topics["/ik_status"]:
        status.status = int(IkStatus.LIMIT_REACHED)
    found = report(tmp_path, topics)
    assert found.n_solved == 0
    assert np.isnan([found.tip_error_median, found.tip_error_max]).all()


def test_rates_that_are_wrong(tmp_path: Path) -> None:
    found = report(tmp_path, run(rate_factor=1.03))
    assert found.rate_disagreement_ratio == pytest.approx(0.03 / 1.03, abs=5e-4)


def test_velocities_missing(tmp_path: Path) -> None:
    topics = run()
    for state in topics["/cable_states"]:
        state.velocity = np.zeros(0)
    recording = read(write(tmp_path / "recording", topics))
    found = report_on(recording)
    assert np.isnan([found.largest_rate, found.rate_disagreement, found.rate_disagreement_ratio]).all()
    assert found.n_lost == 0
    write_cable_figure(recording, tmp_path / "cables.png")
    write_cable_table(recording, tmp_path / "cables.csv")


def test_an_arm_at_rest(tmp_path: Path) -> None:
    topics = run()
    for state in topics["/cable_states"]:
        state.position, state.velocity = topics["/cable_states"][0].position, np.zeros(8)
    found = report(tmp_path, topics)
    assert (found.largest_rate, found.rate_disagreement) == (0.0, 0.0)
    assert np.isnan(found.rate_disagreement_ratio)


@each_topic
@pytest.mark.parametrize("i", [0, N - 1])
def test_a_lost_message_is_found(tmp_path: Path, topic: str, i: int) -> None:
    topics = run()
    lost = topics[topic][2 * i if "section" in topic else i]
    topics[topic].remove(lost)
    found = report(tmp_path, topics)
    assert counted(found.lost) == {STREAMS[topic]: 1}
    assert max(found.tip_error_median, found.tip_error_max) < 1e-12
    assert found.rate_disagreement_ratio < 1e-3


@each_topic
def test_a_repeated_message_hides_no_lost_one(tmp_path: Path, topic: str) -> None:
    topics = run()
    messages = topics[topic]
    messages[10] = messages[20]
    found = report(tmp_path, topics)
    assert counted(found.lost) == counted(found.repeated) == {STREAMS[topic]: 1}
    assert found.tip_error_max < 1e-12
    assert found.rate_disagreement_ratio < 1e-3


def test_a_stamp_lost_everywhere_is_found_by_what_was_expected(tmp_path: Path) -> None:
    topics = {topic: messages[: -3 * len(messages) // N] for topic, messages in run().items()}
    write(tmp_path / "recording", topics)
    assert report_on(read(tmp_path / "recording")).n_lost == 0
    assert set(report_on(read(tmp_path / "recording"), N).lost.values()) == {3}


def test_arrival_out_of_order_changes_nothing(tmp_path: Path) -> None:
    offsets = np.random.default_rng(1).normal(scale=1e-3, size=(N, 3))
    ordered = report_on(read(write(tmp_path / "ordered", run(offsets))))
    topics = run(offsets)
    for seed, messages in enumerate(topics.values()):
        np.random.default_rng(seed).shuffle(messages)
    assert report_on(read(write(tmp_path / "shuffled", topics))) == ordered


def test_joints_and_cables_are_found_by_name(tmp_path: Path) -> None:
    topics = run()
    for state in topics["/cable_states"]:
        state.name = state.name[::-1]
        state.position, state.velocity = np.flip(state.position).copy(), np.flip(state.velocity).copy()
    recording = read(write(tmp_path / "recording", topics))
    w, w_rate = postures()
    np.testing.assert_allclose(recording.configurations.values, w, atol=1e-12)
    np.testing.assert_allclose(recording.lengths.values, tangle(w, ARM), atol=1e-15)
    np.testing.assert_allclose(recording.rates.values, tangle_rates(w, w_rate, ARM), atol=1e-15)


def test_derivatives_of_a_parabola_are_exact_even_next_to_gaps() -> None:
    t = np.array([0.0, 0.1, 0.2, 0.5, 0.6, 0.61])
    inner, sensitivities = central_differences((t * 1e9).astype(np.int64), np.stack([t**2, 3 * t], axis=1))
    np.testing.assert_array_equal(inner, [1, 2, 3, 4])
    np.testing.assert_allclose(sensitivities, np.stack([2 * t, np.full(6, 3.0)], axis=1)[1:-1], rtol=1e-9)


def test_the_table_keeps_columns_and_values(tmp_path: Path) -> None:
    topics = run()
    topics["/cable_states"].reverse()
    write_cable_table(read(write(tmp_path / "recording", topics)), tmp_path / "cables.csv")
    with (tmp_path / "cables.csv").open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert head == ["t_s", *(f"{c}_m" for c in ARM.cable_names), *(f"{c}_m_s" for c in ARM.cable_names)]
    values = np.array(rows, dtype=float)
    w, w_rate = postures()
    np.testing.assert_allclose(values[:, 0], np.arange(N) / RATE, atol=1e-9)
    np.testing.assert_allclose(values[:, 1:9], tangle(w, ARM), rtol=1e-8)
    np.testing.assert_allclose(values[:, 9:], tangle_rates(w, w_rate, ARM), rtol=1e-8)


def test_the_picture_shows_lengths_and_rates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Lengths [mm] on the left; on the right rates [mm/s] as lines, and derivatives of the lengths as dots."""
    figures: list[Figure] = []
    monkeypatch.setattr(
        "continuum.recordings.cable_figure.write_figure", lambda _path, figure, **_options: figures.append(figure)
    )
    recording = read(write(tmp_path / "recording", run()))
    write_cable_figure(recording, tmp_path / "cables.png")
    left, right = figures[0].axes
    lines, dots = ([line for line in right.lines if (line.get_marker() == ".") == dotted] for dotted in (False, True))
    lengths, rates = 1e3 * recording.lengths.values.T, 1e3 * recording.rates.values.T
    times = left.lines[0].get_xdata()
    np.testing.assert_allclose(times, (STAMPS - STAMPS[0]) * 1e-9)
    np.testing.assert_array_equal([line.get_ydata() for line in left.lines], lengths)
    np.testing.assert_array_equal([line.get_ydata() for line in lines], rates)
    at = np.array([np.interp(dot.get_xdata(), times, rate) for dot, rate in zip(dots, rates, strict=True)])
    np.testing.assert_allclose([dot.get_ydata() for dot in dots], at, atol=0.01 * np.abs(rates).max())


def test_topics_that_need_not_be_there(tmp_path: Path) -> None:
    topics = run()
    del topics["/traj_twist"], topics["/section_config_states"]
    found = report(tmp_path, topics)
    assert found.n_lost == 0
    assert "/traj_twist" not in found.lost


@pytest.mark.parametrize("topic", ["/joint_states", "/ik_status", "/section_cable_states"])
def test_a_node_that_never_spoke(tmp_path: Path, topic: str) -> None:
    topics = run()
    topics[topic].clear()
    found = report(tmp_path, topics)
    assert found.n_lost == N * (2 if "section" in topic else 1)
    assert np.isnan(found.tip_error_max) == (topic != "/section_cable_states")

"""The page's plots: what they draw is what was reported, in their units, and nothing else."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.kinematics.routing import tangle
from continuum.viewer.default_arm import default_arm
from continuum.viewer.drawn_cables import drawn_cables
from continuum.viewer.line_plot import range_of, with_cursor
from continuum.viewer.manual_source import ManualSource
from continuum.viewer.page import Page
from continuum.viewer.plot_data import (
    LENGTHS,
    PHI,
    TENSIONS,
    THETA,
    Line,
    Motion,
    PlotData,
    padded,
    section_data,
    thinned,
)
from continuum.viewer.plots import SPAN, LivePlots
from continuum.viewer.section_angles import joints_of
from continuum.viewer.seen import Seen
from continuum.viewer.tracks import Track

pytestmark = pytest.mark.slow

ARM = default_arm(2)
SECTION = ARM.sections[0]
BLACK = (0.0, 0.0, 0.0)


@pytest.fixture
def plots():
    page = Page(ARM, ManualSource(ARM), port=0)
    yield LivePlots(page._layout, ARM)
    page.close()


def drawn(plots, title):
    """A plot on the page, None where there is none."""
    plot = plots.plots.plot(title)
    return plot and plot.plot


def test_plots_show_only_the_cables_that_are_reported(plots):
    """A cable without values has no line."""
    own, others = ARM.sections[0].cable_names, ARM.sections[1].cable_names

    def show(time, **what):
        plots.plots.draw_soon()
        plots.show(Seen(time=time, **what))

    show(0.0, lengths=dict.fromkeys(own, 0.2))
    assert drawn(plots, TENSIONS) is None
    assert drawn(plots, LENGTHS) is None  # one point is no line
    for time in (1.0, 1.1):
        show(time, lengths={own[0]: 0.2, own[2]: 0.3}, tensions={own[0]: 5.0, own[2]: 6.0})
    for title, values in ((LENGTHS, ([200.0], [300.0])), (TENSIONS, ([5.0], [6.0]))):
        plot = drawn(plots, title)
        times, *lines = plot.data
        assert len(plot.series) == 3
        np.testing.assert_allclose(times[-1:], [0.0])
        np.testing.assert_allclose([line[-1:] for line in lines], values)
        assert np.isfinite(plot.data).all()
    show(22.0, lengths=dict.fromkeys(own + others, 0.25))  # after a gap: no line over it
    assert drawn(plots, LENGTHS) is None
    assert drawn(plots, TENSIONS) is None
    plots.plots.choice.value = "section 2"
    show(23.0, lengths=dict.fromkeys(others, 0.1))
    assert drawn(plots, LENGTHS) is not None
    np.testing.assert_allclose(drawn(plots, LENGTHS).data[0], [-1.0, 0.0])
    np.testing.assert_allclose(drawn(plots, LENGTHS).data[1], [250.0, 100.0])
    show(22.5, lengths=dict.fromkeys(others, 0.1))  # the time went back
    assert drawn(plots, LENGTHS) is None


def test_plots_reach_back_so_far_and_no_further(plots):
    for time in range(60):
        plots.plots.draw_soon()
        plots.show(Seen(time=float(time), lengths=dict.fromkeys(ARM.cable_names, 0.2)))
    np.testing.assert_allclose(drawn(plots, LENGTHS).data[0], np.arange(-SPAN, 1.0))
    assert len(plots._instants) == SPAN + 1


def motion(names, values, label="", times=None):
    times = np.arange(float(len(values))) if times is None else times
    return Motion(label, Track(times, tuple(names), np.array(values)), BLACK)


def test_each_joint_has_a_plot():
    angles = np.random.default_rng(0).uniform(-0.3, 0.4, (7, SECTION.n_joints))
    data = section_data(SECTION, [motion(SECTION.theta_joints, angles)])
    assert len(data) == SECTION.n_joints
    np.testing.assert_allclose(np.concatenate([one.values for one in data.values()]), np.degrees(angles.T))


def test_a_section_whose_joints_bend_alike_has_a_plot_of_its_bend():
    w = np.array([[0.3, -0.2], [0.5, 0.4]])
    joints = joints_of(w, ARM)
    data = section_data(SECTION, [motion(joints, [list(joints.values())] * 2)])
    assert list(data) == [THETA, PHI]
    np.testing.assert_allclose(data[THETA].values, np.degrees(np.hypot(*w[0])))
    np.testing.assert_allclose(data[PHI].values, np.degrees(joints[SECTION.phi_joint]))


def test_motions_are_compared_at_the_same_times():
    name = SECTION.theta_joints[:2]
    slow = motion(name, [[0.0, 0.0], [1.0, 2.0]], "slow", np.array([0.0, 1.0]))
    fast = motion(name, [[0.0, 0.0], [1.0, 0.0], [0.0, 2.0]], "fast", np.array([0.0, 0.25, 2.0]))
    data = section_data(SECTION, [slow, fast])["Joint 1 [deg]"]
    assert [line.label for line in data.lines] == ["slow", "fast"]
    for line, one in zip(data.values, (slow, fast), strict=True):
        own = one.joints
        np.testing.assert_allclose(np.interp(own.times, data.times, line), np.degrees(own.values[:, 0]))


@given(st.integers(2, 3000), st.integers(0, 10))
def test_thinned_lines_keep_their_extremes_and_their_time(n, seed):
    rng = np.random.default_rng(seed)
    whole = PlotData((Line("a", BLACK), Line("b", BLACK)), np.cumsum(rng.uniform(0.0, 1.0, n)), rng.normal(size=(2, n)))
    few = thinned(whole, 100)
    assert len(few.times) <= 100
    assert np.all(np.diff(few.times) >= 0.0)
    assert (few.times[0], few.times[-1]) == (whole.times[0], whole.times[-1])
    for reduce in (np.min, np.max):
        np.testing.assert_array_equal(reduce(few.values, axis=1), reduce(whole.values, axis=1))


def test_all_plots_of_a_recording_have_the_same_time():
    late = PlotData((Line("a", BLACK),), np.array([1.0, 2.0]), np.array([[3.0, 5.0]]))
    for end in (1.5, 2.0, 4.0):
        data = padded(late, end)
        assert (data.times[0], data.times[-1]) == (0.0, end)
        np.testing.assert_allclose(data.values[0], np.interp(data.times, late.times, late.values[0], np.nan, np.nan))


def test_a_line_ends_with_its_motion():
    """Also among many points, and with a cursor beyond its end."""
    name, whole, part = SECTION.theta_joints[:2], np.linspace(0.0, 10.0, 1001), np.linspace(2.0, 6.0, 401)
    motions = [motion(name, np.sin([times, times]).T, label, times) for label, times in (("a", whole), ("b", part))]
    data = padded(thinned(section_data(SECTION, motions)["Joint 1 [deg]"], 200), 12.0)
    assert (data.times[0], data.times[-1]) == (0.0, 12.0)
    interval = 10.0 / 100
    for now in (1.0, 4.0, 8.0, 11.0):
        times, *lines, _ = with_cursor(data, now)
        for line, own in zip(lines, (whole, part), strict=True):
            drawn = times[np.isfinite(line)]
            np.testing.assert_allclose((drawn[0], drawn[-1]), (own[0], own[-1]), atol=2 * interval)
            assert np.isfinite(line[(times > drawn[0]) & (times < drawn[-1])]).all()


@given(st.lists(st.integers(-5000, 5000).map(lambda tenths: tenths / 10), min_size=1, max_size=9))
def test_the_axis_of_a_line_that_ends_has_all_of_its_values(numbers):
    assert range_of(np.array([numbers])) is None
    low, high = range_of(np.array([[np.nan, *numbers, np.nan]]))
    assert low <= min(numbers)
    assert max(numbers) <= high
    assert low < high
    assert high - low <= max(4.0, 4.0 * (max(numbers) - min(numbers)))


@given(st.floats(-1.0, 11.0))
def test_the_cursor_is_at_its_time_and_leaves_the_lines_as_they_are(now):
    times = np.linspace(0.0, 10.0, 21)
    line = np.sin(times)
    drawn_times, drawn_line, cursor = with_cursor(PlotData((Line("a", BLACK),), times, line[None]), now)
    peak = np.argmax(cursor)
    assert set(drawn_times[peak - 1 : peak + 2]) == {now}  # it is upright
    assert np.sum(cursor > 0.0) == 1
    assert np.all(np.diff(drawn_times) >= 0.0)
    np.testing.assert_allclose(drawn_line, np.interp(drawn_times, times, line))


def test_cables_of_a_recording_without_lengths_are_those_of_its_postures():
    postures = np.random.default_rng(1).uniform(-0.6, 0.6, (5, 2, 2))
    rows = [joints_of(w, ARM) for w in postures]
    track = Track(np.arange(5.0), tuple(rows[0]), np.array([list(row.values()) for row in rows]))
    lengths = drawn_cables(track, ARM)
    assert lengths.names == tuple(ARM.cable_names)
    np.testing.assert_allclose(lengths.values, [tangle(w, ARM) for w in postures], atol=1e-9)

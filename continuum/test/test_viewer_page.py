"""The page: its controls and what they say, without a browser."""

import gzip
import re
import urllib.request

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from continuum.kinematics.cable_lines import section_arrow
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.routing import tangle
from continuum.viewer import posture_controls, status_table
from continuum.viewer.default_arm import default_arm
from continuum.viewer.manual_source import ManualSource
from continuum.viewer.page import Page
from continuum.viewer.plot_data import LENGTHS
from continuum.viewer.remote_arm import RemoteArm
from continuum.viewer.screen_colours import linear_light
from continuum.viewer.section_angles import joints_of
from continuum.viewer.seen import Status
from continuum.viewer.slider_value import end_in_degrees

pytestmark = pytest.mark.slow

ARM = default_arm(2)


@pytest.fixture
def opened():
    pages = []

    def open_page(source):
        pages.append(Page(ARM, source, port=0))
        return pages[-1]

    yield open_page
    for page in pages:
        page.close()


def test_target_leads_the_sliders_and_sliders_the_target(opened):
    source = ManualSource(ARM)
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


def test_a_typed_target_is_reached_and_the_arm_straightened(opened):
    source = ManualSource(ARM)
    page = opened(source)
    page.draw()
    controls = source._controls
    straight, wanted = controls.target, arm_pose(np.array([[0.3, -0.2], [0.5, 0.4]]), ARM)[:3, 3]
    for number, part in zip(controls._typed, wanted, strict=True):
        number.value = 1e3 * part
    page.draw()
    np.testing.assert_allclose(page._scene.tip, straight)  # nothing moves while numbers are typed
    controls._pressed = posture_controls._GO
    page.draw()
    np.testing.assert_allclose(page._scene.tip, wanted, atol=1e-5)
    np.testing.assert_allclose(controls._gizmo.position, wanted)
    controls._pressed = posture_controls._STRAIGHTEN
    page.draw()
    np.testing.assert_allclose(page._scene.tip, straight, atol=1e-9)
    np.testing.assert_allclose([number.value for number in controls._typed], 1e3 * straight, atol=0.05)


def test_a_button_that_was_pressed_while_others_moved_the_arm_does_nothing_later(opened):
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    w = np.array([[0.1, 0.2], [-0.3, 0.1]])
    remote.tell(joints=joints_of(w, ARM), time=1.0)
    remote._controls._pressed = posture_controls._STRAIGHTEN
    page.draw()
    remote._leads._handle.value = "the joints"
    page.draw()
    np.testing.assert_allclose(remote.posture, w, atol=1e-9)


def test_state_of_others_is_shown_and_nothing_asked_of_them(opened):
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    w = np.array([[0.1, 0.2], [-0.3, 0.1]])
    remote.tell(joints=joints_of(w, ARM), time=1.0)
    page.draw()
    np.testing.assert_allclose(page._scene.tip, arm_pose(w, ARM)[:3, 3], atol=1e-9)
    assert remote.target is None
    assert remote.posture is None
    assert not remote._controls._gizmo.visible
    assert remote._controls._sliders[0].theta.disabled
    assert remote.tensions.wanted() == {}


def test_an_arm_that_nobody_reported_of_is_pale_and_said_so(opened):
    """What is drawn then is no state of it, so nothing is plotted either."""
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    meshes = [mesh for _, mesh in page._scene.links._meshes]
    page.draw()
    assert remote._unheard.visible
    assert max(mesh.opacity for mesh in meshes) < 1.0
    assert page._plots.plots.plot(LENGTHS) is None
    for time in (1.0, 1.1):
        page._plots.plots.draw_soon()
        remote.tell(joints=joints_of(np.full((2, 2), 0.1), ARM), time=time)
        page.draw()
    assert not remote._unheard.visible
    assert {mesh.opacity for mesh in meshes} == {None}
    assert page._plots.plots.plot(LENGTHS).plot is not None


@given(st.floats(1e-3, np.pi))
@example(np.pi)
@example(1.2)
@example(np.radians(70.0))
@example(np.nextafter(np.radians(70.0), 0.0))
def test_sliders_end_at_the_last_tenth_of_a_degree_within_the_limit(limit):
    end = end_in_degrees(limit)
    assert end == round(end, 1)
    assert np.radians(end) <= limit < np.radians(end + 0.1 + 1e-9)


def test_measured_arm_is_the_ghost_of_the_simulated_one(opened):
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    simulated, measured = np.array([[0.1, 0.2], [-0.3, 0.1]]), np.array([[0.2, 0.2], [-0.3, 0.2]])
    for output in (joints_of(simulated, ARM), {}, joints_of(simulated, ARM)):
        remote.tell(joints=joints_of(measured, ARM), simulated=output)
        page.draw()
        assert page._ghosts["/ghost"].visible == bool(output)
    np.testing.assert_allclose(page._scene.tip, arm_pose(simulated, ARM)[:3, 3], atol=1e-9)
    np.testing.assert_allclose(page._ghosts["/ghost"].poses[-1, :3, 3], arm_pose(measured, ARM)[:3, 3], atol=1e-9)


def test_cables_are_pulled_while_control_is_taken_and_slack_after(opened):
    """Those alone whose tensions somebody says: a node refuses cables that it does not have."""
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    tensions, (cable, other, *_) = remote.tensions, ARM.cable_names
    page.draw()
    assert not tensions._folder.visible
    remote.tell(tensions={cable: 1.0, other: 2.0})
    page.draw()
    assert tensions._folder.visible
    assert [name for name, slider in tensions._sliders.items() if slider.visible] == [cable, other]
    tensions._sliders[cable].value = 12.0
    assert tensions.wanted() == {cable: 0.0, other: 0.0}
    tensions._taken._handle.value = True
    assert tensions.wanted()[cable] == 0.0  # what was set before does not pull at once
    tensions._sliders[cable].value = 12.0
    assert tensions.wanted() == {cable: 12.0, other: 0.0}
    for _ in range(2):
        remote.let_go()  # no browser took it
    assert not tensions.taken
    assert tensions.wanted()[cable] == 0.0


@pytest.mark.parametrize(("said", "meant"), [(1e9, 30.0), (-5.0, 0.0), (np.nan, 0.0), (np.inf, 0.0), (12, 12.0)])
def test_no_browser_asks_for_more_than_a_slider_has(opened, said, meant):
    remote = RemoteArm(ARM, 30.0)
    page, cable = opened(remote), ARM.cable_names[0]
    remote.tell(tensions={cable: 1.0})
    page.draw()
    remote.tensions._taken._handle.value = True
    remote.tensions.wanted()
    remote.tensions._sliders[cable].value = said
    assert remote.tensions.wanted() == {cable: meant}


@pytest.mark.parametrize("place", [(np.nan, 0.0, 0.1), (np.inf, 0.0, 0.0), (1e300, 0.0, 0.0), (0.0, -100.0, 0.0)])
def test_a_target_that_no_mouse_drags_is_put_back(opened, place):
    source = ManualSource(ARM)
    page = opened(source)
    page.draw()
    before = page._scene.tip
    source._controls._gizmo.position = np.array(place)
    source._controls._sliders[0].theta.value = np.nan
    page.draw()
    np.testing.assert_allclose(page._scene.tip, before)
    np.testing.assert_allclose(source._controls._gizmo.position, before)


def test_all_of_the_arm_moves_with_its_joints(opened):
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    scene, w = page._scene, np.array([[0.0, 0.0], [0.5, 0.4]])
    remote.tell(joints=joints_of(w, ARM))
    page.draw()
    for links, mesh in scene.links._meshes:
        np.testing.assert_allclose(mesh.batched_positions, scene.links.poses[links, :3, 3], atol=1e-6)
        turns = Rotation.from_quat(np.roll(mesh.batched_wxyzs, -1, axis=-1)).as_matrix()
        np.testing.assert_allclose(turns, scene.links.poses[links, :3, :3], atol=1e-6)
    np.testing.assert_allclose(list(scene.cable_lengths().values()), tangle(w, ARM), atol=1e-6)
    assert not scene._arrows.visible
    page._view._vectors.value = True
    page.draw()
    assert scene._arrows.visible
    base = scene.links.poses[scene._bases[1]]
    arrow = section_arrow(w[1], ARM.sections[1], 0.25 * ARM.length, 10.0 * ARM.length)
    np.testing.assert_allclose(scene._arrows.points, [arrow @ base[:3, :3].T + base[:3, 3]], atol=1e-6)
    remote.tell(joints=joints_of(0 * w, ARM))
    page.draw()
    assert not scene._arrows.visible
    assert len(page._tip_trail._points) > 0


def test_a_target_out_of_reach_is_reported(opened):
    source = ManualSource(ARM)
    page = opened(source)
    source._controls._gizmo.position = np.array([0.0, 0.0, 2.0 * ARM.length])
    page.draw()
    assert "out of reach" in source._controls._answer.content


def test_colours_of_points_are_shares_of_light():
    np.testing.assert_array_equal(linear_light([0.0, 0.5, 1.0]), [0, 55, 255])


@pytest.mark.parametrize("hanging", [False, True])
def test_the_base_is_below_or_above_as_chosen(opened, hanging):
    page = opened(ManualSource(ARM))
    page._view._hanging.value = hanging
    page.draw()
    camera = page._server.initial_camera
    upwards = np.dot(camera.up, page._scene.tip)
    assert bool(upwards < 0.0) is hanging
    assert np.dot(camera.up, np.subtract(camera.position, camera.look_at)) > 0.0  # seen from above


def test_the_tip_is_read_in_numbers(opened):
    remote = RemoteArm(ARM, 30.0)
    page = opened(remote)
    page.draw()
    assert not re.findall(r"[xyz] \*\*-?[\d.]+", page._readout._table.content)
    remote.tell(joints=joints_of(np.array([[0.1, 0.2], [-0.3, 0.1]]), ARM), time=1.0)
    page._readout._due = 0.0
    page.draw()
    read = re.findall(r"[xyz] \*\*(-?[\d.]+)", page._readout._table.content)
    np.testing.assert_allclose([float(number) for number in read], 1e3 * page._scene.tip, atol=0.05)


def test_the_browser_is_given_the_title_of_the_page():
    page = Page(ARM, ManualSource(ARM), port=0, title="a < b.csv")
    try:
        for compression in ("gzip", "identity"):
            request = urllib.request.Request(page.address, headers={"Accept-Encoding": compression})
            with urllib.request.urlopen(request) as answer:
                body = answer.read()
                text = (gzip.decompress(body) if answer.headers["Content-Encoding"] == "gzip" else body).decode()
            assert re.findall("<title>(.*?)</title>", text) == ["a &lt; b.csv"]
    finally:
        page.close()


def test_words_of_others_are_text():
    table = status_table._table([Status("<script>alert(1)</script>", 9, "a < b")])
    assert "<script>" not in table
    assert "a &lt; b" in table


def test_trail_begins_again_after_a_leap(opened):
    trail = opened(ManualSource(ARM))._tip_trail
    for x in np.arange(0.0, 0.1, 0.001):
        trail.follow(np.array([x, 0.0, 0.0]))
    pieces = trail._line.points
    np.testing.assert_allclose(pieces[1:, 0], pieces[:-1, 1])
    assert np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1).min() >= trail._step * 0.999
    trail.follow(np.array([0.0, 1.0, 0.0]))
    assert not trail._line.visible

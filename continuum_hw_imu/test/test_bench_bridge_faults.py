"""The node at an emulated bench while things go wrong: it says so, tells no wrong angle, and lets the cables go."""

import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest
from ament_index_python.packages import get_package_prefix
from emulated_bench import Bridge, LatencyProbe, bridge_at, emulated_bench
from harness import NodeProcess, Probe, ended_in_any_case
from test_bench_bridge_node import WAITING, angles_and_truth

from continuum_hw_imu.bench_bridge import AUTOSTART_PERIOD
from continuum_hw_imu.protocol.messages import ReceiverLimits

pytestmark = pytest.mark.ros

FARTHEST = np.radians(1.5)
"""A single angle that is further off the truth is wrong: five times what the sensors may err at rest."""

RESUMED = 1.0
"""Time after the link's return within which data come again [s]."""

LIMITS = ReceiverLimits()
"""The emulated bench's."""

NOTICED = {signal.SIGKILL: 0.0, signal.SIGSTOP: LIMITS.heartbeat_timeout}
"""Time after which the bench knows that the bridge died [s]: the port closes, or heartbeats stop."""

BUSY = 0.1
"""What rows of the truth and a busy machine add to a time [s]."""


@pytest.fixture(scope="module")
def probe(domain):
    with Probe(domain) as probe:
        yield probe


@pytest.fixture(scope="module")
def latency_probe(probe):
    return LatencyProbe(probe)


@pytest.fixture(scope="module")
def bench(domain, tmp_path_factory):
    with emulated_bench(domain, tmp_path_factory.mktemp("bench")) as bench:
        yield bench


@pytest.fixture(scope="module")
def calibration(domain, latency_probe, bench):
    """File of the emulated sensors' calibration."""
    file = bench.port.with_name("calibration.yaml")
    with bridge_at(latency_probe, bench, domain, calibration=file) as bridge:
        bridge.wait_for_state("inactive")
        bridge.calibrate()
        assert bridge.node.stop() == 0
    return file


@pytest.fixture
def pulling(domain, latency_probe, probe, bench, calibration):
    """A calibrated bridge, active, that pulls one cable by 8 N."""
    probe.wait_until(lambda: not bench.status["open"], "the port is free")
    with bridge_at(
        latency_probe, bench, domain, calibration=calibration, keep_bias=True, autostart="activate"
    ) as bridge:
        bridge.wait_for_state("active")
        probe.wait_until(lambda: len(bridge.joints) > 5, lambda: f"joint states; {bridge.diagnostic('angles')}")
        pull(bridge)
        yield bridge
    bench.tell("clear")


def pull(bridge: Bridge) -> None:
    bridge.pull([8.0, 0.0], lambda: bridge.bench.status["set_points"][0] == pytest.approx(8.0, abs=0.01))


def go_on(bridge: Bridge, lasts: float) -> None:
    """Command on for so long by the emulator's clock."""
    end = bridge.bench.status["time"] + lasts
    bridge.command_until([8.0, 0.0], lambda: bridge.bench.status["time"] > end)


def slack_time_after(bench, instant: float) -> float:
    """How long after an instant of this machine's clock all set points are zero for good [s]."""
    truth = bench.truth()
    tight = truth["monotonic_s"][truth["set_point"].any(axis=1)]
    return max(0.0, tight[-1] - instant)


def assert_no_wrong_angle(bridge: Bridge, joints) -> None:
    """None but for a lag, one for each quarter of a second: a bridge that waits for its turn hears all frames late."""
    off = np.abs(np.subtract(*angles_and_truth(bridge, joints, np.linspace(0.0, WAITING, 11)))).max(axis=-1)
    stretches = [off[:, i : i + 15].max(axis=1).min() for i in range(0, off.shape[1], 15)]
    assert max(stretches) < FARTHEST, np.degrees(stretches)


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGSTOP], ids=["killed", "hangs"])
def test_cables_are_let_go_when_the_bridge_dies(pulling, number):
    bench = pulling.bench
    pulling.node.send(number)
    instant = bench.status["monotonic"]
    pulling.probe.wait_until(lambda: not np.any(bench.truth()["set_point"][-1]), "slack")
    assert slack_time_after(bench, instant) <= NOTICED[number] + LIMITS.slack_time + BUSY
    assert not bench.status["claimed"]


def test_unplugging_ends_tension_and_streaming_resumes(pulling):
    bench, probe = pulling.bench, pulling.probe
    instant = bench.status["monotonic"]
    bench.tell("unplug for=1.5")
    pulling.wait_for_state("inactive")
    pulling.wait_for_level("link", "ERROR", "does not exist")
    assert slack_time_after(bench, instant) <= LIMITS.slack_time + BUSY
    for subject in ("angles", "clock", "tension"):
        pulling.wait_for_level(subject, "STALE", "last received values: ")
    answer = pulling.call("zero")
    assert not answer.success
    assert "does not exist" in answer.message
    probe.wait_until(lambda: bench.status["port"], "the port's return")
    back, before = bench.status["monotonic"], len(pulling.imus[0])
    probe.wait_until(lambda: len(pulling.imus[0]) > before, "data of the sensors")
    assert pulling.monotonic(pulling.imus[0][before]) - back < RESUMED
    pulling.command([8.0, 0.0])
    probe.wait_until(lambda: probe.count(pulling.name, "dropped: not active") > 0, "a refused command")
    assert not any(bench.status["set_points"])
    assert pulling.change("activate"), pulling.node.stderr
    pull(pulling)
    probe.wait_until(lambda: len(pulling.joints) > 0, "joint states")
    assert_no_wrong_angle(pulling, pulling.joints)


def test_a_bench_that_begins_again_is_greeted_again(pulling):
    bench, probe = pulling.bench, pulling.probe
    bench.tell("reboot")
    pulling.node.wait_for_line("fell back to inactive, cables slack")
    pulling.joints.clear()
    probe.wait_until(lambda: len(pulling.joints) > 5, lambda: f"joint states; {pulling.diagnostic('angles')}")
    assert_no_wrong_angle(pulling, pulling.joints)
    assert not any(bench.status["set_points"])
    assert pulling.change("activate"), pulling.node.stderr
    pull(pulling)


LINE_FAULTS = {
    "damage share=0.1 for=1.5": "frames damaged",
    "damage share=0.2 for=1.5 way=down": "frames that the bench found damaged",
}


@pytest.mark.parametrize("order", LINE_FAULTS)
def test_a_bad_line_is_reported_and_survived(pulling, order):
    pulling.joints.clear()
    pulling.bench.tell(order)
    go_on(pulling, 1.5)
    key = LINE_FAULTS[order]
    pulling.probe.wait_until(
        lambda: int(pulling.diagnostic("link").get(key, 0)) > 0, lambda: pulling.diagnostic("link")
    )
    assert pulling.diagnostic("link")["level"] in ("WARN", "ERROR")
    if pulling.state != "active":  # a stretch without any good frame
        assert pulling.change("activate"), pulling.node.stderr
    pull(pulling)
    before = len(pulling.joints)
    pulling.probe.wait_until(lambda: len(pulling.joints) > before + 5, lambda: pulling.diagnostic("angles"))
    assert_no_wrong_angle(pulling, pulling.joints)
    assert pulling.bench.status["largest_set_point"] < 8.01  # what is pulled here


def test_late_frames_have_the_stamps_of_their_measurement(pulling):
    pulling.joints.clear()
    pulling.bench.tell("late by=0.2 for=1")
    go_on(pulling, 1.0)
    pulling.wait_for_level("clock", "WARN", "ms late")
    pulling.probe.wait_until(lambda: len(pulling.joints) > 60, "joint states")
    assert_no_wrong_angle(pulling, pulling.joints)


def test_a_stop_at_the_bench_stops_the_node(pulling, domain, latency_probe):
    """Seen as the node's own: it is latched, and reset by its service."""
    assert pulling.call("stop").success
    pulling.wait_for_state("inactive")
    pulling.node.close()
    with bridge_at(latency_probe, pulling.bench, domain) as after:
        after.node.wait_for_line("stopped: by the bench")
        assert not after.change("activate")
        assert after.call("reset_stop").success
        assert after.change("activate"), after.node.stderr


def test_what_was_stopped_becomes_active_by_a_persons_word_alone(domain, latency_probe, probe, bench, calibration):
    """Even a node that had yet to begin by itself when it was stopped."""
    probe.wait_until(lambda: not bench.status["open"], "the port is free")
    bench.tell("unplug for=1000")
    with bridge_at(
        latency_probe, bench, domain, calibration=calibration, keep_bias=True, autostart="activate"
    ) as bridge:
        bridge.node.wait_for_line("does not exist")
        assert bridge.call("stop").success
        bench.tell("clear")
        probe.wait_until(lambda: bench.status["port"], "the port's return")
        assert bridge.change("configure"), bridge.node.stderr
        assert bridge.call("reset_stop").success
        go_on(bridge, 3 * AUTOSTART_PERIOD)
        assert bridge.state == "inactive"
        assert not any(bench.status["set_points"])
        assert bridge.node.stop() == 0


def test_the_bias_of_a_file_is_of_another_day(domain, latency_probe, probe, bench, calibration):
    probe.wait_until(lambda: not bench.status["open"], "the port is free")
    with bridge_at(latency_probe, bench, domain, calibration=calibration) as bridge:
        bridge.wait_for_level("angles", "ERROR", "not calibrated: no bias")
        known = bench.status["monotonic"]
        probe.wait_until(lambda: len(bridge.since(known, bridge.imus[0])) > 60, "data of the sensors")
        assert not bridge.since(known, bridge.joints)
        bridge.wait_for_success("calibrate_bias")
        probe.wait_until(
            lambda: len(bridge.since(known, bridge.joints)) > 5, lambda: f"joint states; {bridge.diagnostic('angles')}"
        )
        assert_no_wrong_angle(bridge, bridge.since(known, bridge.joints))
        assert bridge.node.stop() == 0


def test_a_second_emulator_takes_nothing_from_the_first(domain, bench, tmp_path):
    folder = bench.port.parent
    for words, diagnostic in (
        (("--link", bench.port), "exists already and refers to /dev/pts/"),
        (("--link", tmp_path / "other", "--control", folder / "control"), "belongs to another running emulator"),
    ):
        again = NodeProcess("continuum_hw_imu", "bench_emulator", domain, arguments=tuple(map(str, words)))
        with ended_in_any_case(again):
            assert again.exit_code() == 2
            assert diagnostic in again.stderr
    assert bench.port.exists()
    assert bench.status["port"]


def test_orders_are_given_by_a_command(bench, capfd):
    command = [Path(get_package_prefix("continuum_hw_imu")) / "lib/continuum_hw_imu/bench_order"]
    control = ["--control", bench.port.parent / "control"]
    assert subprocess.run([*command, *control, "clear", "status"], timeout=60).returncode == 0
    assert '"set_points"' in capfd.readouterr().out
    assert subprocess.run([*command, *control, "explode"], timeout=60).returncode == 1
    assert subprocess.run([*command, "--control", "/nowhere", "status"], timeout=60).returncode == 2
    assert capfd.readouterr().err.endswith("/nowhere: No such file or directory; is the emulator running?\n")


def test_an_empty_battery_is_reported(pulling):
    pulling.bench.tell("battery sensor=2 percent=3")
    pulling.wait_for_level("imu 2", "ERROR", "battery at 3 %")
    pulling.bench.tell("battery sensor=2 percent=90")

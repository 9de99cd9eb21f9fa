"""The node's own rules of safety, beside the controller that keeps them too."""

import pytest
from looped_bench import LoopedBench

from continuum.dynamics.live.tension_limit import TensionLimits
from continuum_hw_imu.bench_commander import BenchCommander
from continuum_hw_imu.protocol.messages import GuardState

LIMITS = TensionLimits(max_tension=12.0, max_rate=100.0, patience=0.4, slack_time=0.2)


@pytest.fixture
def bench():
    return LoopedBench()


@pytest.fixture
def commander(bench):
    commander = BenchCommander(LIMITS, 2, lambda: bench.now)
    commander.client = bench.client
    return commander


def run(bench, commander, duration: float, wanted=None) -> None:
    """Commands, if any, and set points 60 times a second."""
    for _ in range(round(duration * 60)):
        if wanted is not None:
            commander.gate.command(wanted, bench.now)
        commander.send(bench.now)
        bench.pass_time(1 / 60, steps=1)


def test_tension_takes_a_claim_and_stays_within_limits(bench, commander):
    assert not commander.gate.command([5.0, 0.0], bench.now)
    assert commander.begin() == ""
    assert bench.set_points == [0.0, 0.0]
    run(bench, commander, 0.5, [50.0, 3.0])
    assert bench.set_points == [12.0, 3.0]
    commander.end()
    assert commander.gate.set_point.tolist() == [0.0, 0.0]
    bench.pass_time(0.6)
    assert bench.set_points == [0.0, 0.0]


def test_cables_are_let_go_when_commands_stop(bench, commander):
    commander.begin()
    run(bench, commander, 0.5, [12.0, 0.0])
    run(bench, commander, LIMITS.patience - 0.05)
    assert bench.set_points == [12.0, 0.0]
    run(bench, commander, LIMITS.slack_time + 0.1)
    assert bench.set_points == [0.0, 0.0]
    assert commander.gate.abandoned
    assert commander.problem() == ""
    run(bench, commander, 0.5, [4.0, 0.0])
    assert bench.set_points == [4.0, 0.0]


def test_a_bench_that_does_not_fit_is_not_pulled(bench, commander):
    commander.mismatch = "another arm's"
    assert commander.begin() == "another arm's"
    assert not commander.gate.is_open
    assert not commander.gate.command([5.0, 0.0], bench.now)
    assert not bench.client.commands


def test_a_stop_holds_until_it_is_reset_at_both_ends(bench, commander):
    commander.begin()
    run(bench, commander, 0.3, [8.0, 0.0])
    commander.stop()
    assert bench.set_points == [0.0, 0.0]
    assert commander.problem().startswith("stopped")
    assert commander.begin().startswith("stopped")
    bench.pass_time(0.1)
    assert commander.reset_stop() == ""
    assert not commander.gate.is_open
    assert bench.controller.guard.state is GuardState.SLACK
    assert commander.begin() == ""


def test_a_stop_without_a_line_reaches_the_bench_later(bench, commander):
    bench.link.deaf = True
    commander.stop()
    assert not bench.controller.guard.stopped
    bench.link.deaf = False
    commander.keep_up(bench.now)
    assert bench.controller.guard.stopped
    assert not commander.keep_up(bench.now)  # it is the node's own


def test_a_stop_of_the_bench_is_the_nodes_too(bench, commander):
    commander.begin()
    bench.controller.guard.stop(bench.device_time)
    bench.report_news()
    assert commander.keep_up(bench.now)
    assert commander.gate.stopped


def test_release_leaves_the_gate_open(bench, commander):
    assert commander.let_go() != ""
    commander.begin()
    run(bench, commander, 0.3, [8.0, 0.0])
    assert commander.let_go() == ""
    assert commander.gate.set_point.tolist() == [0.0, 0.0]
    assert bench.set_points == [0.0, 0.0]
    run(bench, commander, 0.1)
    assert bench.set_points == [0.0, 0.0]
    run(bench, commander, 0.3, [2.0, 0.0])
    assert bench.set_points == [2.0, 0.0]


def test_every_trouble_of_the_line_keeps_tension_out(bench, commander):
    assert BenchCommander(LIMITS, 2).line_problem() == "not configured"
    commander.mismatch = "another arm's"
    assert commander.begin() == "another arm's"
    commander.mismatch = ""
    commander.begin()
    bench.now += 0.6
    assert "silent" in commander.problem()
    bench.now += 3.0
    bench.controller.move_on(bench.device_time, 3.6)
    commander.keep_up(bench.now)
    assert bench.link.reopened == 1
    bench.report_news()
    assert "missed this node's heartbeats" in commander.problem()
    bench.client._begin()
    assert commander.problem() == "the port is open, but no bench says who it is"
    bench.link.close()
    assert commander.problem() == "closed"

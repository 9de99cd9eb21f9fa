"""The trajectory publisher over DDS: starts when it is heard, one stamp for both, no drift, nothing lost."""

import math

import numpy as np
import pytest
from geometry_msgs.msg import PoseStamped, TwistStamped
from harness import NodeProcess, Probe, ended_in_any_case
from rosgraph_msgs.msg import Clock

from continuum_manipulator.nodekit.stamps import nanoseconds
from continuum_manipulator.nodekit.usage import usage
from trajectory_generator.from_parameters import trajectory_from_mapping
from trajectory_generator.trajectory_publisher import TrajectoryPublisherNode

pytestmark = pytest.mark.ros

PATH = {
    "path": "line",
    "line.start": [0.1, 0.0, 0.4],
    "line.end": [0.1, 0.05, 0.4],
    "max_speed": 0.2,
    "max_acceleration": 1.0,
    "lead_time": 0.1,
    "rest_time": 0.1,
    "rate": 130.0,
}
QUICK = {"settle_time": 0.1}


def publisher(domain, **parameters) -> NodeProcess:
    values = PATH | QUICK | parameters
    return NodeProcess(
        "trajectory_generator",
        "trajectory_publisher",
        domain,
        parameters={key: str(value).lower() if isinstance(value, bool) else value for key, value in values.items()},
    )


@pytest.fixture
def probe(domain):
    with Probe(domain) as probe:
        yield probe


def instants(messages) -> list[int]:
    return [nanoseconds(message.header.stamp) for message in messages]


def test_whole_trajectory_arrives_with_one_stamp_for_both(domain, probe):
    poses, twists = probe.hear(PoseStamped, "traj_pose"), probe.hear(TwistStamped, "traj_twist")
    trajectory = trajectory_from_mapping(PATH)
    times = trajectory.times(PATH["rate"])
    with ended_in_any_case(publisher(domain, exit_at_end=True)) as (node,):
        probe.wait_until(lambda: len(twists) >= len(times) <= len(poses), lambda: f"{len(poses)} of {len(times)}")
        assert node.exit_code() == 0
        assert "Traceback" not in node.stderr
        assert f"trajectory ended, {len(times)} poses" in node.stderr
    assert len(poses) == len(twists) == len(times)
    stamps = np.array(instants(poses))
    assert stamps.tolist() == instants(twists)
    np.testing.assert_allclose((stamps - stamps[0]) * 1e-9, times, rtol=0, atol=2e-9)
    expected = trajectory.sample(times)
    position = [(m.pose.position.x, m.pose.position.y, m.pose.position.z) for m in poses]
    linear = [(m.twist.linear.x, m.twist.linear.y, m.twist.linear.z) for m in twists]
    np.testing.assert_array_equal(position, expected.position)
    np.testing.assert_array_equal(linear, expected.linear_velocity)
    assert {m.header.frame_id for m in poses + twists} == {"base_link"}
    assert all(math.isclose(m.pose.orientation.w, 1.0) for m in poses)


def test_waits_for_listeners_and_for_nodes_then_begins_at_the_beginning(domain, probe):
    poses = probe.hear(PoseStamped, "traj_pose")
    with ended_in_any_case(publisher(domain, wait_for_nodes="[late]")) as (node,):
        probe.wait_for_nodes("trajectory_publisher")
        probe.wait_until(lambda: probe.report("trajectory_publisher"), "diagnostics")
        assert not poses
        twists = probe.hear(TwistStamped, "traj_twist")
        probe.listen_until_quiet(1.0)
        assert not poses
        with Probe(domain, name="late"):
            probe.wait_until(lambda: poses and twists, "the first pose")
        assert poses[0].pose.position.y == 0.0
        assert node.stop() == 0


def test_starts_without_listeners_after_the_time_out_and_says_so(domain, probe):
    probe.hear(PoseStamped, "traj_pose")
    with ended_in_any_case(publisher(domain, wait_timeout=1.0, wait_for_nodes="[late]", exit_at_end=True)) as (node,):
        node.wait_for_line("started without all listeners: traj_twist has 0 of 1 subscriptions, node late does not run")
        assert node.exit_code() == 0


def test_loop_goes_on_with_rising_stamps(domain, probe):
    poses, _ = probe.hear(PoseStamped, "traj_pose"), probe.hear(TwistStamped, "traj_twist")
    n = len(trajectory_from_mapping(PATH).times(PATH["rate"]))
    with ended_in_any_case(publisher(domain, loop=True)) as (node,):
        probe.wait_until(lambda: len(poses) > 2 * n, "two rounds")
        assert node.stop() == 0
    assert [m.pose for m in poses[:n]] == [m.pose for m in poses[n : 2 * n]]
    steps = np.diff(instants(poses))
    assert steps.min() > 0
    assert np.abs(steps - 1e9 / PATH["rate"]).max() <= 1


def test_simulated_time_sets_the_pace(domain, probe):
    """Time that runs ten times as fast, then stands still: the schedule does as well."""
    poses, _ = probe.hear(PoseStamped, "traj_pose"), probe.hear(TwistStamped, "traj_twist")
    say_clock = probe.node.create_publisher(Clock, "/clock", 10).publish
    now = 1000 * 10**9
    period = 1e9 / PATH["rate"]

    def tick() -> None:
        nonlocal now
        now += 20_000_000
        clock = Clock()
        clock.clock.sec, clock.clock.nanosec = divmod(now, 10**9)
        say_clock(clock)

    with ended_in_any_case(publisher(domain, use_sim_time=True)) as (node,):
        probe.wait_for_nodes("trajectory_publisher")
        probe.wait_until(lambda: (tick(), len(poses) > 30)[1], "thirty poses")
        probe.settle()
        probe.listen_until_quiet(0.5)
        probe.settle()
        stood = len(poses)
        assert instants(poses)[-1] <= now + period
        probe.listen_until_quiet(0.5)
        assert len(poses) == stood
        assert instants(poses)[0] > 1000 * 10**9
        assert node.stop() == 0


def test_being_late_is_reported_but_not_of_the_start(domain, probe):
    """Simulated time that jumps: by half a second at the start, and again when the motion runs."""
    poses, _ = probe.hear(PoseStamped, "traj_pose"), probe.hear(TwistStamped, "traj_twist")
    say_clock = probe.node.create_publisher(Clock, "/clock", 10).publish
    now = 1000 * 10**9

    def tick(step: int) -> None:
        nonlocal now
        now += step
        clock = Clock()
        clock.clock.sec, clock.clock.nanosec = divmod(now, 10**9)
        say_clock(clock)

    def until(count: int) -> None:
        """The clock waits for a node that a busy machine holds up."""
        while len(poses) <= count:
            tick(5_000_000)
            probe.settle()

    with ended_in_any_case(publisher(domain, use_sim_time=True, lead_time=5.0, rate=50.0)) as (node,):
        probe.wait_for_nodes("trajectory_publisher")
        until(2)
        tick(500_000_000)
        until(100)
        assert "behind" not in node.stderr
        tick(500_000_000)
        until(130)
        node.wait_for_line("behind the schedule")
        assert node.stop() == 0


def test_help_lists_the_parameters_of_every_path():
    names = [line.strip() for line in usage(TrajectoryPublisherNode).splitlines() if " " not in line.strip()]
    for name in ("corner_radius", "helix.radius", "line.start", "circle.angle", "via_points.list", "loop", "rate"):
        assert names.count(name) == 1


def test_a_parameter_of_another_path_ends_the_node_with_one_line(domain):
    with ended_in_any_case(publisher(domain, **{"helix.radius": 0.1})) as (node,):
        assert node.exit_code() == 2
        (line,) = node.stderr.splitlines()
        assert "unknown parameter 'helix.radius'; " in line

"""What every node does with its topics: quality of service from parameters, lost messages counted, arrival noted."""

from types import SimpleNamespace

import pytest
import rclpy
from harness.waiting import LONG, wait_until
from rclpy.duration import Duration
from rclpy.event_handler import QoSSubscriptionEventType
from rclpy.experimental import EventsExecutor
from rclpy.qos import QoSReliabilityPolicy
from std_msgs.msg import String

from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.qos import STREAM

pytestmark = pytest.mark.ros

OVERRIDES = ("heard.subscription.reliability:=best_effort", "heard.subscription.depth:=3", "said.publisher.depth:=5")


class Plain(CheckedNode):
    NAME = "plain"


@pytest.fixture
def node(domain):
    arguments = ["--ros-args"]
    for override in OVERRIDES:
        arguments += ["-p", f"qos_overrides./{override}"]
    rclpy.init(args=arguments, domain_id=domain)
    node = Plain()
    yield node
    node.destroy_node()
    rclpy.shutdown()


def test_quality_of_service_from_parameters_and_lost_messages(node):
    received = node.listen(String, "heard", lambda _: None)
    node.offer(String, "said")
    node.refuse_unknown_overrides()
    assert (received.qos_profile.depth, received.qos_profile.reliability) == (3, QoSReliabilityPolicy.BEST_EFFORT)
    assert node.get_parameter("qos_overrides./said.publisher.depth").value == 5
    assert (STREAM.depth, STREAM.reliability) == (4000, QoSReliabilityPolicy.RELIABLE)
    lost = QoSSubscriptionEventType.RCL_SUBSCRIPTION_MESSAGE_LOST
    (handler,) = (handler for handler in received.event_handlers if handler.event_type == lost)
    handler.callback(SimpleNamespace(total_count=5, total_count_change=3))
    assert node.diagnostics.warnings.counts == {"messages lost on the way": 3}


def test_a_message_that_waits_in_the_node_has_the_time_of_its_arrival(node):
    arrivals: list[int] = []
    node.listen(String, "waits", lambda _: arrivals.append(node.arrival()), timed=True)
    publisher = node.create_publisher(String, "waits", STREAM)
    executor = EventsExecutor()
    executor.add_node(node)
    wait_until(publisher.get_subscription_count, "the subscription")

    def now() -> int:
        return node.get_clock().now().nanoseconds

    before = now()
    publisher.publish(String())
    assert publisher.wait_for_all_acked(Duration(seconds=LONG))
    after = now()
    wait_until(lambda: now() > after + 100_000_000, "work of the node's elsewhere")
    wait_until(lambda: (executor.spin_once(timeout_sec=0.1), arrivals)[1], "the message", pause=0)
    executor.remove_node(node)
    assert before <= arrivals[0] <= after

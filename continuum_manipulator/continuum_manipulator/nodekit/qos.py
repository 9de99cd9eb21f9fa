"""Quality of service of the workspace's topics (docs/architecture.md, Topics)."""

from __future__ import annotations

from rclpy.qos import QoSDurabilityPolicy, QoSHistoryPolicy, QoSProfile, QoSReliabilityPolicy

STREAM = QoSProfile(
    reliability=QoSReliabilityPolicy.RELIABLE,
    durability=QoSDurabilityPolicy.VOLATILE,
    history=QoSHistoryPolicy.KEEP_LAST,
    depth=4000,
)
"""Every stream of states and commands: a slow reader catches up, nothing in between is dropped.

The depth bridges a stall of some ten seconds of a reader that hears three writers of 120 Hz."""

NEWEST = QoSProfile(
    reliability=QoSReliabilityPolicy.BEST_EFFORT,
    durability=QoSDurabilityPolicy.VOLATILE,
    history=QoSHistoryPolicy.KEEP_LAST,
    depth=1,
)
"""For who only looks: no writer keeps or sends anything twice for its sake."""

REPORT = QoSProfile(
    reliability=QoSReliabilityPolicy.RELIABLE,
    durability=QoSDurabilityPolicy.VOLATILE,
    history=QoSHistoryPolicy.KEEP_LAST,
    depth=10,
)
"""ROS's usual setting, for diagnostics and markers: only the latest matter."""

TRANSFORMS = QoSProfile(
    reliability=QoSReliabilityPolicy.RELIABLE,
    durability=QoSDurabilityPolicy.VOLATILE,
    history=QoSHistoryPolicy.KEEP_LAST,
    depth=100,
)
"""For ``/tf``, as tf2's broadcaster publishes."""

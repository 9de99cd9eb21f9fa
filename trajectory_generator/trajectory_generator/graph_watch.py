"""Wait for all subscribers, so that the first messages of a trajectory are not lost."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from rclpy.node import Node


class GraphWatch:
    """Detects that the subscribers are present and that the ROS graph has settled.

    Nodes that start together find each other within a fraction of a second, but a graph that is complete for this node
    may be incomplete for the others. The graph must therefore also have been unchanged for some time.

    Args:
        node: node whose view of the graph is used.
        nodes: names of nodes that must run.
        complete: a further condition.
        settle_time: time for which the graph must have been unchanged [s].
    """

    def __init__(self, node: Node, nodes: Sequence[str], complete: Callable[[], bool], settle_time: float) -> None:
        self._node = node
        self._wanted = set(nodes)
        self._complete = complete
        self._settle_time = settle_time
        self._picture: object = None
        self._still_since = time.monotonic()

    def missing(self) -> list[str]:
        """Return the names of required nodes that are not running."""
        running = self._node.get_node_names_and_namespaces()
        names = {name for name, _ in running} | {f"{space.rstrip('/')}/{name}" for name, space in running}
        return sorted(self._wanted - names)

    def ready(self) -> bool:
        """Return whether the graph is complete and settled; call this several times within the settle time."""
        picture = self._check()
        if picture != self._picture:
            self._picture, self._still_since = picture, time.monotonic()
        still = time.monotonic() - self._still_since >= self._settle_time
        return still and self._complete() and not self.missing()

    def _check(self) -> object:
        node = self._node
        topics = [topic for topic, _ in node.get_topic_names_and_types()]
        ends = [(topic, node.count_publishers(topic), node.count_subscribers(topic)) for topic in sorted(topics)]
        return sorted(node.get_fully_qualified_node_names()), ends

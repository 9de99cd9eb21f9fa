"""Waiting until all who are to listen are there, so that a trajectory's first messages are not lost."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence

from rclpy.node import Node


class GraphWatch:
    """Tells when the listeners are there and the graph has come to rest.

    Nodes that start together find each other within a fraction of a second; that the graph looks complete from here
    does not say that the others have found each other. So it must also have been still for a while.

    Args:
        node: through which to look.
        nodes: names of nodes that must run.
        complete: a further condition.
        settle_time: how long the graph must have been still [s].
    """

    def __init__(self, node: Node, nodes: Sequence[str], complete: Callable[[], bool], settle_time: float) -> None:
        self._node = node
        self._wanted = set(nodes)
        self._complete = complete
        self._settle_time = settle_time
        self._picture: object = None
        self._still_since = time.monotonic()

    def missing(self) -> list[str]:
        """Names of wanted nodes that are not running."""
        running = self._node.get_node_names_and_namespaces()
        names = {name for name, _ in running} | {f"{space.rstrip('/')}/{name}" for name, space in running}
        return sorted(self._wanted - names)

    def ready(self) -> bool:
        """To be asked again and again, several times within the settle time."""
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

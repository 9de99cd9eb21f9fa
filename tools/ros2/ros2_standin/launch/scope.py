"""What a launch file's tags change for those after them: variables, environment, namespace, remappings, parameters."""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Scope:
    """State while launch files are evaluated, tag by tag.

    Attributes:
        variables: values of ``arg`` and ``let``.
        environment: environment of processes and of ``$(env)``.
        namespace: of nodes, empty for the root.
        remaps: of every node, pairs (from, to).
        parameters: of every node.
        file: the launch file under evaluation.
        anonymous: names that ``$(anon)`` made, shared by all scopes.
    """

    environment: dict[str, str]
    file: Path
    variables: dict[str, str] = field(default_factory=dict)
    namespace: str = ""
    remaps: list[tuple[str, str]] = field(default_factory=list)
    parameters: dict[str, object] = field(default_factory=dict)
    anonymous: dict[str, str] = field(default_factory=dict)

    def inner(self) -> Scope:
        """A scope of a ``group``: knows everything, and keeps its changes to itself."""
        inside = copy.deepcopy(self)
        inside.anonymous = self.anonymous
        return inside

    def push_namespace(self, namespace: str) -> None:
        """Go into a namespace: an absolute one replaces, a relative one is appended."""
        self.namespace = join_namespaces(self.namespace, namespace)


def join_namespaces(base: str, namespace: str) -> str:
    """``namespace`` as seen from ``base``, without a slash at its end; empty for the root."""
    if namespace.startswith("/"):
        base = ""
    parts = [part for part in f"{base}/{namespace}".split("/") if part]
    return "".join(f"/{part}" for part in parts)

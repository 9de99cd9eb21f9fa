"""What is to be seen of an arm at one instant, whoever says it: nodes, a recording, or the page's own sliders."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from continuum.arrays import Array
from continuum.viewer.layout import Layout


@dataclass(frozen=True)
class Status:
    """How something is.

    Attributes:
        name: of what.
        level: 0 well, 1 a warning, 2 an error, 3 stale; the numbers of ``diagnostic_msgs/DiagnosticStatus``.
        message: in words.
    """

    name: str
    level: int
    message: str


class Plots(Protocol):
    """Plots of a source that knows its time from beginning to end."""

    def show(self, now: float, dark: bool = False) -> None:
        """Show the instant ``now`` [s], on a dark or a light page."""


@dataclass(frozen=True)
class Seen:
    """One instant; what is not known is empty.

    Attributes:
        time: of the instant, by any clock [s].
        joints: joint angles by name [rad]. The arm is drawn by them.
        overlays: joint angles of other motions of the arm [rad]; each is drawn as a ghost.
        simulated: those of a simulated arm beside a measured one [rad]. Where there are any, the arm is drawn by
            these, and ``joints`` as its ghost.
        lengths: of cables by name [m]; where nobody says them, those of the cables as they are drawn are plotted.
        tensions: of cables by name [N].
        target: where the tip shall be, (3,) [m] in ``base_link``.
        statuses: of sensors, link, nodes.
        plots: what plots the instant, if that is not the page's plots over the last seconds.
    """

    time: float = 0.0
    joints: Mapping[str, float] = field(default_factory=dict)
    simulated: Mapping[str, float] = field(default_factory=dict)
    overlays: tuple[Mapping[str, float], ...] = ()
    lengths: Mapping[str, float] = field(default_factory=dict)
    tensions: Mapping[str, float] = field(default_factory=dict)
    target: Array | None = None
    statuses: tuple[Status, ...] = ()
    plots: Plots | None = None

    @property
    def has_posture(self) -> bool:
        """Whether anybody has said how the arm stands."""
        return bool(self.simulated or self.joints)


class Source(Protocol):
    """Who says what is to be seen. It is asked once for each frame, and only while somebody looks."""

    def add_controls(self, layout: Layout) -> None:
        """Put its controls on the page; called once, before the first frame."""

    def newest(self) -> Seen:
        """What is to be seen now."""

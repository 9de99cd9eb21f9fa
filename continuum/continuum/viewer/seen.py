"""State of an arm to draw at one instant, from nodes, a recording or the sliders of the page."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from continuum.arrays import Array
from continuum.viewer.layout import Layout


@dataclass(frozen=True)
class Status:
    """Status of a node, sensor or link.

    Attributes:
        name: name of what it describes.
        level: 0 well, 1 warning, 2 error, 3 stale, as in ``diagnostic_msgs/DiagnosticStatus``.
        message: description.
    """

    name: str
    level: int
    message: str


class Plots(Protocol):
    """Plots of a source whose whole duration is known."""

    def show(self, now: float, dark: bool = False) -> None:
        """Show the instant ``now`` [s], on a dark or a light page."""


@dataclass(frozen=True)
class Seen:
    """One instant; unknown fields are empty.

    Attributes:
        time: time of the instant on any clock [s].
        joints: joint angles of the drawn arm by name [rad].
        simulated: joint angles of a simulated arm beside a measured one by name [rad]. If there are any, the arm is
            drawn at these angles, and ``joints`` as its ghost.
        overlays: joint angles of other motions of the arm by name [rad]; each is drawn as a ghost.
        lengths: lengths of cables by name [m]; if empty, the lengths of the drawn cables are plotted.
        tensions: tensions of cables by name [N].
        target: target of the tip, (3,) [m] in ``base_link``.
        statuses: statuses of sensors, link and nodes.
        plots: plots of the source; None for the plots over the last seconds.
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
        """Whether the posture of the arm is known."""
        return bool(self.simulated or self.joints)


class Source(Protocol):
    """Source of the state to draw. It is queried once per frame, and only while a browser is connected."""

    def add_controls(self, layout: Layout) -> None:
        """Add the controls of the source to the page; called once, before the first frame."""

    def newest(self) -> Seen:
        """Return the state to draw now."""

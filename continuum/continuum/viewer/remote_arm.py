"""An arm that nodes move: the page shows their messages and provides the commands of its users."""

from __future__ import annotations

from dataclasses import replace

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.viewer.choice import Choice
from continuum.viewer.held_input import Held
from continuum.viewer.layout import Layout
from continuum.viewer.posture_controls import PostureControls
from continuum.viewer.section_angles import configuration_of_joints
from continuum.viewer.seen import Seen
from continuum.viewer.tension_controls import TensionControls

_NOTHING = "nothing"
"""Default choice of what the user moves."""

_UNHEARD = "No `joint_states` received yet: the arm is drawn pale and straight, whatever its posture."


class RemoteArm:
    """Source that accepts new states at any rate, from any thread, and provides the newest to the page.

    Args:
        arm: arm.
        max_tension: largest tension that a user may command [N].

    Attributes:
        target: position of the tip commanded by a user, (3,) [m]; None while no user commands it.
        posture: configuration commanded by a user, (n_sections, 2) [rad]; None while no user commands it.
        tensions: controls of the cable tensions; None before `add_controls`.
    """

    def __init__(self, arm: Arm, max_tension: float) -> None:
        self._arm = arm
        self._most = max_tension
        self._seen = Seen()
        self.target: Array | None = None
        self.posture: Array | None = None
        self.tensions: TensionControls | None = None

    def tell(self, **news: object) -> None:
        """Update fields of `Seen`."""
        self._seen = replace(self._seen, **news)  # type: ignore[arg-type]

    @property
    def latest(self) -> Seen:
        """The newest state."""
        return self._seen

    def add_controls(self, layout: Layout) -> None:
        gui = layout.server.gui
        with layout.move:
            leads = Choice(
                layout, "You move", (_NOTHING, "the target", "the joints"),
                hint="the target: poses for the inverse kinematics; the joints: instead of a node that moves them",
            )  # fmt: skip
            self._unheard = gui.add_markdown(_UNHEARD)
        self._leads = Held(layout.server, leads, _NOTHING)
        self._controls = PostureControls(layout, self._arm)
        self.tensions = TensionControls(layout, self._arm.cable_names, self._most)

    def newest(self) -> Seen:
        seen = self._seen
        leads = self._leads.value
        self._unheard.visible = not seen.has_posture
        if self.tensions is not None:
            self.tensions.offer(seen.tensions)
        self._controls.hand_over(leads != _NOTHING)
        if leads == _NOTHING:
            self.target = self.posture = None
            w = configuration_of_joints(seen.simulated or seen.joints, self._arm)
            self._controls.show(w)
            return seen
        self._controls.follow()
        self.target = self._controls.target if leads == "the target" else None
        self.posture = self._controls.w if leads == "the joints" else None
        return seen

    def let_go(self) -> None:
        """Discard commands of users whose browsers are no longer connected."""
        if self.tensions is None:
            return
        self.tensions.let_go()
        self._leads.let_go()
        if self._leads.value == _NOTHING:
            self.target = self.posture = None

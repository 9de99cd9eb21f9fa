"""An arm that others move: what they say of it is shown, and what the page's user wants is held ready for them."""

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
"""What the page's user moves unless another choice is made."""

_UNHEARD = "No `joint_states` heard yet: the arm is drawn pale and straight, however it may stand."


class RemoteArm:
    """Takes in the newest state at any rate, from any thread, and gives it to the page when that asks.

    Args:
        arm: the arm.
        max_tension: largest that the page's user may ask for [N].

    Attributes:
        target: where the user dragged the tip (3,) [m]; None while the target is not the user's.
        posture: what the user's sliders say, (n_sections, 2) [rad]; None while they are not the user's.
    """

    def __init__(self, arm: Arm, max_tension: float) -> None:
        self._arm = arm
        self._most = max_tension
        self._seen = Seen()
        self.target: Array | None = None
        self.posture: Array | None = None
        self.tensions: TensionControls | None = None

    def tell(self, **news: object) -> None:
        """Take in what is new of the fields of `Seen`."""
        self._seen = replace(self._seen, **news)  # type: ignore[arg-type]

    @property
    def latest(self) -> Seen:
        """All that was taken in."""
        return self._seen

    def add_controls(self, layout: Layout) -> None:
        gui = layout.server.gui
        with layout.move:
            leads = Choice(
                layout, "You move", (_NOTHING, "the target", "the joints"),
                hint="the target: poses for the inverse kinematics; the joints: in the place of a node that moves them",
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
        """What was moved by a user who looks no more is nobody's."""
        if self.tensions is None:
            return
        self.tensions.let_go()
        self._leads.let_go()
        if self._leads.value == _NOTHING:
            self.target = self.posture = None

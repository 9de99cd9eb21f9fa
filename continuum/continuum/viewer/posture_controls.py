"""Controls of a posture: phi and theta of each section, and a draggable target that the tip follows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import viser

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.kinematics.chain import arm_pose
from continuum.kinematics.configuration import allen_from_jones, jones_from_allen
from continuum.kinematics.ik_result import IkResult, IkStatus
from continuum.kinematics.ik_target import Target
from continuum.kinematics.inverse_kinematics import InverseKinematics
from continuum.viewer.layout import Layout, spoken
from continuum.viewer.slider_value import end_in_degrees, value_within

_WORDS = {
    IkStatus.SOLVED: "reached",
    IkStatus.LIMIT_REACHED: "a bend limit keeps the tip away",
    IkStatus.UNREACHABLE: "out of reach",
    IkStatus.NO_CONVERGENCE: "not found",
}
_FREE = "Drag the target, or move a slider."
_BOUND = "First choose above what you move."
_GO, _STRAIGHTEN = "Go to target", "Straighten"
_FAR = 10.0
"""Largest distance of a target in lengths of the arm; one further away was not dragged there."""

_MOVED = 1e-7
"""Smallest motion of a target or slider that counts [m, deg]."""


@dataclass(frozen=True)
class _Sliders:
    phi: viser.GuiSliderHandle[float]
    theta: viser.GuiSliderHandle[float]


class PostureControls:
    """Sliders and a target, read once per frame: the one moved last determines the other.

    Args:
        layout: page.
        arm: arm.

    Attributes:
        w: commanded configuration, (n_sections, 2) [rad].
        target: commanded position of the tip, (3,) [m].
    """

    def __init__(self, layout: Layout, arm: Arm) -> None:
        self._arm = arm
        self._faults = layout.faults
        self._solver = InverseKinematics(arm, objective="near_start")
        self.w = np.zeros((arm.n_sections, 2))
        self.target = arm_pose(self.w, arm)[:3, 3]
        gui = layout.server.gui
        with layout.move:
            self._sliders = []
            for section in arm.sections:
                with gui.add_folder(spoken(section.name)):
                    end = end_in_degrees(section.bend_limit)
                    theta = gui.add_slider("theta [deg]", 0.0, end, 0.1, 0.0, hint="bend of the section")
                    phi = gui.add_slider("phi [deg]", -180.0, 180.0, 0.1, 0.0, hint="direction in which it bends")
                    self._sliders.append(_Sliders(phi, theta))
            with gui.add_folder("Target"):
                self._typed: list[viser.GuiNumberHandle[float]] = [
                    gui.add_number(f"{axis} [mm]", float(1e3 * part), step=0.1)
                    for axis, part in zip("xyz", self.target, strict=True)
                ]
                self._buttons = gui.add_button_group("", (_GO, _STRAIGHTEN), hint="The arm moves there immediately.")
            self._answer = gui.add_markdown(_FREE)
        layout.words.update((_GO, _STRAIGHTEN))
        self._pressed = ""
        self._buttons.on_click(self._press)
        self._gizmo = layout.server.scene.add_transform_controls(
            "/target", scale=0.14 * arm.length, disable_rotations=True, depth_test=False, position=self.target
        )
        self._set = self._read()

    def hand_over(self, to_user: bool) -> None:
        """Enable the target and the sliders for the user, or only display them."""
        if to_user is not self._gizmo.visible:
            self._gizmo.visible = to_user
            self._answer.content = _FREE if to_user else _BOUND
            self._buttons.visible = to_user
            for number in self._typed:
                number.disabled = not to_user
        if not to_user:
            self._pressed = ""  # an earlier click has no later effect
        for sliders in self._sliders:
            sliders.phi.disabled = sliders.theta.disabled = not to_user

    def follow(self) -> bool:
        """Apply what the user moved; return whether anything was."""
        pressed, self._pressed = self._pressed, ""
        place, angles = np.array(self._gizmo.position, dtype=float), self._read()
        if pressed == _GO:
            place = 1e-3 * np.array([number.value for number in self._typed])
        elif pressed == _STRAIGHTEN:
            angles = np.zeros_like(angles)
            for sliders in self._sliders:
                sliders.phi.value = sliders.theta.value = 0.0  # type: ignore[misc]
        if not np.abs(place).max() < _FAR * self._arm.length:  # also true of NaN
            self._faults.note("target of a browser", f"{place} m; allowed: up to {_FAR:g} lengths of the arm away")
            self._place(self.target)
            return False
        if np.abs(place - self.target).max() > _MOVED:
            self._place(place)
            result = self._solver.solve(Target(place), start=self.w)
            self.w = result.configuration
            self._write()
            self._say(result)
            return True
        if np.abs(angles - self._set).max() > _MOVED:
            self._set = angles
            self.w = allen_from_jones(*np.radians(angles).T)
            self._place(arm_pose(self.w, self._arm)[:3, 3])
            self._answer.content = "The target follows the sliders."
            return True
        return False

    def show(self, w: Array) -> None:
        """Set sliders and target to ``w``, (n_sections, 2) [rad], of an arm that others move."""
        if np.abs(w - self.w).max() > _MOVED:
            self.w = w
            self._write()
            self._place(arm_pose(w, self._arm)[:3, 3])

    def _place(self, point: Array) -> None:
        self.target = point
        self._gizmo.position = point
        for number, part in zip(self._typed, point, strict=True):
            number.value = round(float(1e3 * part), 1)  # type: ignore[misc]

    def _press(self, event: viser.GuiEvent[Any]) -> None:
        self._pressed = event.target.value

    def _read(self) -> Array:
        """Return phi and theta of the sliders, clipped to their limits, (n_sections, 2) [deg]."""
        shown = [[sliders.phi, sliders.theta] for sliders in self._sliders]
        return np.array([[value_within(slider) for slider in pair] for pair in shown])

    def _write(self) -> None:
        for sliders, phi, theta in zip(self._sliders, *np.degrees(jones_from_allen(self.w)), strict=True):
            sliders.phi.value = float(phi)
            sliders.theta.value = float(np.clip(theta, sliders.theta.min, sliders.theta.max))
        self._set = self._read()

    def _say(self, result: IkResult) -> None:
        self._answer.content = (
            f"Target {_WORDS[result.status]}; the tip is {1e3 * result.distance:.3f} mm away from it."
        )

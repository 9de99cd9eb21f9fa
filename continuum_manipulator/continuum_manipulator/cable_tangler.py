"""Node between sections and cables of the arm: adds the lengths in all sections, and separates commanded lengths."""

from __future__ import annotations

import numpy as np
from rclpy.clock import Clock
from rclpy.clock_type import ClockType

from continuum.kinematics.routing import (
    cables_through,
    section_length_rates,
    section_lengths,
    tangle,
    untangle,
    untangle_rates,
)
from continuum_manipulator.command_checks import (
    TOLERANCE,
    check_configuration,
    check_fit,
    check_lengths,
    check_rates,
)
from continuum_manipulator.nodekit import messages
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.stamps import Loss, StampJoiner, nanoseconds, seconds
from continuum_manipulator.section_number import checked_section
from continuum_msgs.msg import CableStates

PATIENCE = 10.0
"""Time by the machine's clock after which sections without a publisher are reported [s]."""

LOSSES = {
    Loss.INCOMPLETE: ("instants given up with a section missing", "no state of {sections}"),
    Loss.LATE: ("section states too late", "{sections}; this instant, or a later one, has been published already"),
    Loss.REPEATED: ("section states repeated", "{sections} again; every instant needs a unique stamp"),
}
"""Cause and detail that are reported for states that do not enter a sum."""

WAITING_PERIOD = 2.0
"""Time by the machine's clock for which an instant waits before the missing sections are reported [s]."""


class CableTanglerNode(CheckedNode):
    """Adds ``section_cable_states`` to ``cable_states``; converts ``cable_commands`` to ``section_cable_commands``.

    Sections are joined by their stamps: different instants are never mixed.
    """

    NAME = "cable_tangler"
    PARAMETERS = (TOLERANCE,)
    HAS_ARM = True

    def __init__(self) -> None:
        super().__init__()
        self._numbers = range(1, self.arm.n_sections + 1)
        self._names = list(self.arm.cable_names)
        self._through = {number: cables_through(self.arm, number - 1).names for number in self._numbers}
        self._instants: StampJoiner[int, CableStates] = StampJoiner(self._numbers, on_loss=self._report_loss)
        self.diagnostics.values["instants waiting for a section"] = lambda: self._instants.waiting
        self._publish_states = self.offer(CableStates, "cable_states")
        self._publish_commands = self.offer(CableStates, "section_cable_commands")
        self._received: set[int] = set()
        self._sections = self.listen(CableStates, "section_cable_states", self._on_section)
        self.listen(CableStates, "cable_commands", self._on_commands)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._patience_timer = self.create_timer(PATIENCE, self._report_missing, clock=steady)
        self._waited_for: tuple[int, frozenset[int]] | None = None
        self._reported = self._waited_for
        self._waiting_timer = self.create_timer(WAITING_PERIOD, self._report_waiting, clock=steady)

    def _report_missing(self) -> None:
        """Report missing sections once, so that a launch file for another arm is noticed before poses arrive."""
        self.destroy_timer(self._patience_timer)
        speakers, wanted = self._sections.get_publisher_count(), len(self._numbers)
        if speakers < wanted and len(self._received) < wanted:
            detail = f"the arm has {wanted} sections, publishers on {self._sections.topic_name}: {speakers}"
            self.diagnostics.warnings.note("sections without a node", detail)

    def _report_waiting(self) -> None:
        """Report the sections that an instant still misses after `WAITING_PERIOD`: a dead node, or a busy machine."""
        before, self._waited_for = self._waited_for, self._instants.first_waiting
        if self._waited_for is None or before != self._waited_for or self._reported == self._waited_for:
            return
        stamp, numbers = self._reported = self._waited_for
        detail = f"at {seconds(stamp)}: no state of {_listed(numbers)} yet; {self._instants.waiting} instants wait"
        self.diagnostics.warnings.note("section states missing", detail)

    def _on_section(self, message: CableStates) -> None:
        number = checked_section(message.section, self.arm)
        messages.stamped(message.header.stamp)
        messages.named(message.name, "cables", self._through[number])
        messages.same_length("position", message.position, message.name)
        messages.same_length("velocity", message.velocity, message.name, optional=True)
        messages.indices_of(self._through[number], message.name)
        messages.finite("position", message.position)
        messages.finite("velocity", message.velocity)
        self._received.add(number)
        instant = self._instants.add(number, nanoseconds(message.header.stamp), message)
        if instant is not None:
            self._tangle(instant)

    def _report_loss(self, loss: Loss, stamp: int, numbers: frozenset[int]) -> None:
        cause, detail = LOSSES[loss]
        self.diagnostics.warnings.note(cause, f"at {seconds(stamp)}: {detail.format(sections=_listed(numbers))}")

    def _tangle(self, instant: dict[int, CableStates]) -> None:
        total = CableStates(section=CableStates.WHOLE_ARM, name=self._names)
        total.header.stamp = instant[1].header.stamp
        total.position = self._sum(instant, "position")
        if all(part.velocity for part in instant.values()):
            total.velocity = self._sum(instant, "velocity")
        self._publish_states(total)

    def _sum(self, instant: dict[int, CableStates], field: str) -> list[float]:
        total = dict.fromkeys(self._names, 0.0)
        for number, part in instant.items():
            values = dict(zip(part.name, getattr(part, field), strict=True))
            for name in self._through[number]:
                total[name] += values[name]
        return list(total.values())

    def _on_commands(self, message: CableStates) -> None:
        messages.stamped(message.header.stamp)
        messages.named(message.name, "cables", self._names)
        messages.same_length("position", message.position, message.name)
        messages.same_length("velocity", message.velocity, message.name, optional=True)
        order = messages.indices_of(self._names, message.name)
        lengths = messages.finite("position", np.asarray(message.position)[order])
        check_lengths(lengths, self._names)
        w = untangle(lengths, self.arm)
        check_configuration(w, self.arm.sections)
        check_fit(lengths, tangle(w, self.arm), self._names, self.values[TOLERANCE.name])
        w_rate = None
        if message.velocity:
            velocities = messages.finite("velocity", np.asarray(message.velocity)[order])
            w_rate = untangle_rates(lengths, velocities, self.arm)
            check_rates(w_rate)
        for i, section in enumerate(self.arm.sections):
            n_actuating = len(section.cable_names)
            command = CableStates(section=i + 1, name=list(section.cable_names))
            command.header.stamp = message.header.stamp
            command.position = section_lengths(w[i], self.arm, i)[:n_actuating]
            if w_rate is not None:
                command.velocity = section_length_rates(w[i], w_rate[i], self.arm, i)[:n_actuating]
            self._publish_commands(command)


def _listed(numbers: frozenset[int]) -> str:
    return ", ".join(f"section {number}" for number in sorted(numbers))

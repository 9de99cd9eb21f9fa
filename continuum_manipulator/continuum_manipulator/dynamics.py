"""Node of a simulated arm: receives tension commands, publishes joint and cable states in real or simulated time."""

from __future__ import annotations

import time
from pathlib import Path

import numpy as np
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.time import Time
from sensor_msgs.msg import JointState
from std_srvs.srv import Trigger

from continuum.dynamics.live.live_arm import INTEGRATORS, LiveArm
from continuum.dynamics.live.tension_limit import TensionLimiter
from continuum.dynamics.planar.cable_lengths import SIDES
from continuum.dynamics.trajectory import SimulationStatus
from continuum.errors import InvalidValueError
from continuum.parameter_spec import ParameterSpec
from continuum_manipulator.load_meter import LoadMeter, Mark
from continuum_manipulator.nodekit import tension_parameters
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.planar_arm import SECTION, PlanarArm
from continuum_manipulator.nodekit.stamps import NANOSECONDS
from continuum_manipulator.nodekit.tension_commands import held_for, read_tensions
from continuum_manipulator.pace import Pace
from continuum_manipulator.postures import checked_posture, initial_posture
from continuum_msgs.msg import CableStates
from continuum_msgs.srv import ResetArm

BEHIND = 0.1
"""Lag above which a warning is given [s]."""

CATCH_UP_PERIOD = 0.001
"""Pause between two batches while the simulation is behind, by the machine's clock [s]; it serves other events."""

LONGEST_GO = 0.01
"""Longest duration of a batch by the machine's clock [s]; between two batches only one other event is served."""


class DynamicsNode(CheckedNode):
    """Converts ``cable_tension_cmd`` to ``joint_states`` and ``cable_states`` by integrating a model.

    Simulated time is ROS time and has no gaps: on a slow machine the simulation lags behind, warns and catches up.
    A command is stale if it is old on arrival, not if it is handled late; it times out by its stamp in simulated time,
    and one that has timed out before it is handled is dropped.
    Commands are clipped to ``max_tension``; invalid ones are dropped, and the previous one remains in force. Without a
    valid command for ``command_timeout``, tension falls linearly to zero within ``slack_time``. The service
    ``~/release`` drops all tension at once, and ``~/reset`` sets a posture; later commands pull again.
    """

    NAME = "dynamics"
    PARAMETERS = (
        ParameterSpec("model", str, "model file, arm file with a block dynamics, or name of a file in the library",
                      default="lamecc_prototype.yaml"),
        SECTION,
        ParameterSpec("rate", float, "states per second", "Hz", 1.0, 2000.0, default=120.0),
        ParameterSpec("integrator", str, "bdf: SciPy's integrator with the thesis's settings; esdirk: the fast one",
                      choices=tuple(INTEGRATORS), default="bdf"),
        ParameterSpec("initial_bend", float, "total bend at the start, equal at every joint", "rad", -1e4, 1e4,
                      default=0.0),
        ParameterSpec("initial_angles", float, "joint angles at the start from base to tip, instead of a total bend",
                      "rad", -np.pi, np.pi, is_list=True, default=[]),
        *tension_parameters.PARAMETERS,
    )  # fmt: skip

    def __init__(self) -> None:
        super().__init__()
        self._planar = PlanarArm.of_parameters(self.values)
        model = self._planar.model
        self._n_joints = model.n_joints
        self._posture = initial_posture(model.n_joints, self.values)
        self._arm = LiveArm(model, self._posture, self.values["integrator"])
        self._limits = tension_parameters.limits_from(self.values)
        self._tensions = TensionLimiter(self._limits, len(SIDES))
        self._pace: Pace | None = None  # None until the time is known
        self._by_clock = bool(self.get_parameter("use_sim_time").value)
        self._failure: SimulationStatus | None = None
        self._meter = LoadMeter()
        self.diagnostics.values |= {
            "integrator": lambda: self.values["integrator"],
            "real-time factor": lambda: f"{self._meter.real_time_factor:.3f}",
            "load of one core": lambda: f"{self._meter.load:.3f}",
            "lag [s]": lambda: f"{self._lag():.3f}",
            "cables": self._cables_in_words,
        }
        self._publish_joints = self.offer(JointState, "joint_states")
        self._publish_cables = self.offer(CableStates, "cable_states")
        self.listen(CableStates, "cable_tension_cmd", self._on_command, timed=True)
        self.create_service(Trigger, "~/release", self._release)
        self.create_service(ResetArm, "~/reset", self._reset)
        steady = Clock(clock_type=ClockType.STEADY_TIME)  # ROS time may jump forwards or backwards
        self._timer = self.create_timer(1.0 / self.values["rate"], self._keep_pace, clock=steady)
        self._catch_up = self.create_timer(CATCH_UP_PERIOD, self._go, clock=steady)
        self._catch_up.cancel()

    def in_words(self) -> str:
        """Describe the simulated arm and the integration."""
        name, bend = Path(self.values["model"]).name, np.degrees(self._posture.sum())
        bent = f"{self._n_joints} joints, bent by {bend:.0f} degrees in total"
        return f"{name}, {bent}, at {self.values['rate']:g} Hz by {self.values['integrator']}"

    def _now(self) -> int:
        """Return ROS time [ns], 0 until simulated time starts."""
        return self.get_clock().now().nanoseconds

    def _lag(self) -> float:
        return 0.0 if self._pace is None else self._pace.lag(self._now())

    def _keep_pace(self) -> None:
        """Simulate the instants that are due, and warn if the simulation lags behind."""
        now = self._now()
        if now == 0:
            return
        if self._pace is None:
            self._pace = Pace(self.values["rate"], self.values["command_timeout"] / 4, now)
            self._publish()
            return
        if self._pace.went_back(now):
            back = (self._pace.seen - now) / NANOSECONDS
            self.diagnostics.warnings.note("time went back", f"by {back:.3f} s; the arm continues from its posture")
            self._pace.begin(now)
            self._meter.restart()
            self._tensions.forget_time()
        if self._failure is not None:
            detail = f"{self._failure.value}; the arm stands still until {self.get_name()}/reset"
            self.diagnostics.warnings.note("integration failed", detail)
            return
        lag = self._pace.lag(self._pace.seen if self._by_clock else now)  # /clock may take large steps
        if lag > BEHIND:
            busy = "the machine is too busy, or /clock too fast" if self._by_clock else "the machine is too busy"
            self.diagnostics.warnings.note("behind", f"{lag:.3f} s: {busy}; no time is skipped")
        self._go()

    def _go(self) -> None:
        """Simulate and publish a limited number of due instants; the rest follows after waiting commands."""
        now, began = self._now(), time.monotonic()
        for number in self._pace.due(now):
            if self._failure is not None or time.monotonic() - began > LONGEST_GO:
                break
            self._advance(number)
        self._meter.mark(Mark(began, time.process_time(), self._pace.covered(now)))
        if self._pace.lag(now) > 0.0 and self._failure is None:
            self._catch_up.reset()
        else:
            self._catch_up.cancel()

    def _advance(self, number: int) -> None:
        """Simulate up to an instant and publish its state."""
        begin, before = self._pace.last, self._tensions.abandoned
        duration = (self._pace.reach(number) - begin) / NANOSECONDS
        interval = self._tensions.move_on(self._pace.seconds(begin), duration)
        if self._tensions.abandoned and not before:
            tension_parameters.report_abandoned(self.diagnostics, self._limits)
        status = self._arm.advance(interval)
        if status is SimulationStatus.COMPLETE:
            self._publish()
        else:
            self._failure = status

    def _publish(self) -> None:
        """Publish the state at the last simulated instant."""
        stamp = Time(nanoseconds=self._pace.last).to_msg()
        angles, rates = self._arm.angles, self._arm.rates
        self._publish_joints(self._planar.joint_state(stamp, angles, rates))
        self._publish_cables(self._planar.cable_states(stamp, angles, rates, self._tensions.tension))

    def _on_command(self, message: CableStates) -> None:
        arrival = self.arrival()
        wanted = read_tensions(message, self._planar.cables, arrival, self.values["command_timeout"])
        if self._pace is None:
            return  # within the first period
        now = self._pace.last
        held = held_for(message, arrival, now, self.values["command_timeout"])
        tension_parameters.report_limited(self.diagnostics, self._planar.cables, wanted, self._limits.max_tension)
        self._tensions.command(wanted, self._pace.seconds(now) - held)

    def _release(self, _request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._tensions.release()
        response.success, response.message = True, "all cables are slack"
        return response

    def _reset(self, request: ResetArm.Request, response: ResetArm.Response) -> ResetArm.Response:
        try:
            posture = (
                checked_posture("position", request.position, self._n_joints) if request.position else self._posture
            )
        except InvalidValueError as error:
            response.message = str(error)
            return response
        self._arm.place(posture)
        self._tensions.release()
        self._failure = None
        response.success = True
        response.message = "at rest, cables slack"
        if self._pace is not None:
            self._pace.begin(self._now())
            self._meter.restart()
        return response

    def _cables_in_words(self) -> str:
        if self._tensions.abandoned:
            return "commands stopped"
        return "tight" if np.any(self._tensions.tension > 0) else "slack"

"""Lifecycle node between ROS and a bench: publishes joint and cable states, and forwards tension commands."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from lifecycle_msgs.msg import State
from lifecycle_msgs.srv import ChangeState
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.lifecycle import LifecycleState, TransitionCallbackReturn
from rclpy.lifecycle.node import LifecycleNodeMixin
from sensor_msgs.msg import Imu, JointState
from std_srvs.srv import Trigger

from continuum.errors import ContinuumError, InvalidValueError
from continuum.inertial.calibration_values import save_calibration
from continuum_hw_imu.bench_commander import ANSWER_TIME, NO_HELLO, BenchCommander, BenchError
from continuum_hw_imu.bench_diagnostics import BenchDiagnostics
from continuum_hw_imu.bench_parameters import AUTOSTARTS, PARAMETERS, steps_from
from continuum_hw_imu.bench_streams import BenchStreams
from continuum_hw_imu.imu_messages import ImuMessages
from continuum_hw_imu.link.bench_client import BenchClient
from continuum_hw_imu.protocol.messages.forces import LARGEST, STEP
from continuum_hw_imu.sensor_quality import SensorQuality
from continuum_hw_imu.sensor_watch import SensorWatch
from continuum_manipulator.nodekit import tension_parameters
from continuum_manipulator.nodekit.checked_node import CheckedNode
from continuum_manipulator.nodekit.faults import MessageFault
from continuum_manipulator.nodekit.planar_arm import PlanarArm
from continuum_manipulator.nodekit.tension_commands import held_for, read_tensions
from continuum_msgs.msg import CableStates

COMMANDS = "cable_tension_cmd"

RCLError = rclpy_implementation.RCLError

OPEN_TIME = 0.3
"""Time within which an existing port opens [s]."""

AUTOSTART_PERIOD = 1.0
"""Time between two automatic transitions [s]."""

CALIBRATE = {
    "bias": "~/calibrate_bias (at rest)",
    "zero": "~/zero (at rest and straight)",
    "axis": "~/find_axes (after a bend towards cable 1 and back)",
}
"""Service that finds each step of the calibration."""

DONE, FAILED = TransitionCallbackReturn.SUCCESS, TransitionCallbackReturn.FAILURE

Answer = Trigger.Response


class BenchBridgeNode(LifecycleNodeMixin, CheckedNode):
    """Publishes a bench's sensors as ``imu_N/data_raw``, ``joint_states`` and ``cable_states``, and forwards commands.

    Commands arrive on ``cable_tension_cmd``. The configured node has the port, and can be calibrated. Only the
    active node publishes and forwards tension. It returns to inactive, with slack cables, if the link is lost, the
    bench restarts, another host commands it, tight cables pull while angles are lost, or ``~/stop`` is called, which
    ``~/reset_stop`` ends. ``~/release`` drops all tension at once. Joint states are published while every joint is
    known. This requires ``~/calibrate_bias`` (at rest), ``~/find_axes`` (after bending towards cable 1 and back) and
    ``~/zero`` (at rest, straight), or a calibration file.
    """

    NAME = "bench_bridge"
    PARAMETERS = PARAMETERS

    def __init__(self) -> None:
        CheckedNode.__init__(self)
        if self.get_parameter("use_sim_time").value:
            raise InvalidValueError("use_sim_time", True, "false; a bench runs in real time")
        self._planar = PlanarArm.of_parameters(self.values)
        model = self._planar.model
        self._n_joints = model.n_joints
        self._steps = steps_from(self.values["calibration"], model.n_joints, self.values["keep_bias"])
        LifecycleNodeMixin.__init__(self)
        self._refuse_what_is_none()
        self._limits = tension_parameters.limits_from(self.values)
        most = LARGEST * STEP
        if self._limits.max_tension > most:
            raise InvalidValueError("max_tension", self._limits.max_tension, f"up to {most:g} N, the protocol's limit")
        self._commander = BenchCommander(self._limits, len(self._planar.cables))
        self._streams = self._offered_streams()
        self._to_come = self.values["autostart"] != AUTOSTARTS[0]
        self._autostart_at = 0.0
        self._waits_for = ""
        self._all_lost = False
        self._link_problem = ""
        self.listen(CableStates, COMMANDS, self._on_command, timed=True)
        rest_time = self.values["rest_time"]
        services: dict[str, Callable[[], str]] = {
            "zero": partial(self._calibrate, lambda watch: watch.find_zero(rest_time)),
            "calibrate_bias": partial(self._calibrate, lambda watch: watch.find_bias(rest_time)),
            "find_axes": partial(self._calibrate, SensorWatch.find_axes),
            "release": self._release,
            "stop": self._stop,
            "reset_stop": self._reset_stop,
        }
        for name, carry_out in services.items():
            self.create_service(Trigger, f"~/{name}", partial(self._serve, carry_out))
        name = self.get_fully_qualified_name().lstrip("/")
        bench_diagnostics = BenchDiagnostics(
            name, self._streams, self._commander, str(self.values["port"]), self._n_joints
        )
        self.diagnostics.subjects += bench_diagnostics.subjects()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self.create_timer(1.0 / self.values["command_rate"], self._tick, clock=steady)

    def in_words(self) -> str:
        return f"{Path(self.values['model']).name}, {self._n_joints} joints, bench at {self.values['port']}"

    def _offered_streams(self) -> BenchStreams:
        quality = SensorQuality(rate_noise=self.values["rate_noise"], force_noise=self.values["force_noise"])
        links = range(1, self._n_joints + 1)
        return BenchStreams(
            self._planar,
            [ImuMessages(f"{self._planar.section}_imu_{k}", quality) for k in links],
            self.get_clock(),
            self._steps,
            self.offer(JointState, "joint_states"),
            self.offer(CableStates, "cable_states"),
            [self.offer(Imu, f"imu_{k}/data_raw") for k in links],
        )

    # --- life cycle

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002
        """Open the port and wait for a matching bench."""
        client = BenchClient(str(self.values["port"]), int(self.values["baud_rate"]), self._streams.take)
        self._commander.client = client
        client.start()
        client.wait_for(lambda: client.link.is_open, OPEN_TIME)
        if client.link.is_open:
            client.wait_for(lambda: client.hello is not None, ANSWER_TIME)
        self._commander.mismatch = self._streams.problem
        problem = self._commander.line_problem() or ("" if client.hello else NO_HELLO)
        if problem:
            self._hang_up()
            self._refuse("configure", problem)
            return FAILED
        self._commander.refused = ""
        hello, own = client.hello, self._limits
        most = min(hello.limits.max_tension, own.max_tension)
        self.get_logger().info(
            f"{hello.firmware} at {self.values['port']}: {len(hello.sensors)} sensors at {hello.sample_rate:g} Hz, "
            f"{hello.n_cables} cables, up to {most:g} N"
        )
        return self._reached("configure")

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002
        """Become the bench's commander, with slack cables, and start to publish."""
        problem = self._commander.line_problem() or self._uncalibrated() or self._commander.begin()
        if problem:
            self._refuse("activate", problem)
            return FAILED
        self._streams.publishing = True
        self.get_logger().info("active: publishes, and passes tension commands on")
        return self._reached("activate")

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002
        """Release the cables, and publish nothing any more."""
        self._commander.end()
        self._streams.publishing = False
        return DONE

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:  # noqa: ARG002
        """Close the port."""
        self._hang_up()
        return DONE

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """As on deactivation and clean-up."""
        self.on_deactivate(state)
        return self.on_cleanup(state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Close the port after a failed transition; rclpy does not report the reason."""
        self.get_logger().error(f"a transition from {state.label} failed; the port is closed")
        return self.on_shutdown(state)

    @property
    def _state(self) -> int:
        """State of the life cycle, one of `lifecycle_msgs/State`."""
        return int(self._state_machine.current_state[0])

    def _refuse_what_is_none(self) -> None:
        """Refuse transitions that do not exist in the present state; rclpy would terminate the node."""
        change = self._service_change_state.callback

        def change_if_possible(request: ChangeState.Request, response: ChangeState.Response) -> ChangeState.Response:
            try:
                return change(request, response)
            except RCLError:
                response.success = False
                self._refuse("change its state", f"no transition {request.transition.id} in state {self._state}")
                return response

        self._service_change_state.callback = change_if_possible

    def _refuse(self, transition: str, problem: str) -> None:
        self._commander.refused = problem if transition == "configure" else ""
        self.diagnostics.warnings.note(f"cannot {transition}", problem)

    def _hang_up(self) -> None:
        client, self._commander.client = self._commander.client, None
        if client is not None:
            client.close()
        self._streams.forget()

    def _autostart(self, now: float) -> None:
        """Advance to the state of ``autostart`` once; after that, the node never activates by itself again.

        A port that is not there yet is waited for, and everything else is tried again now and then. Without a
        calibration the node stays inactive: at its end hands are on the arm.
        """
        if not self._to_come or now < self._autostart_at:
            return
        port, state = self.values["port"], self._state
        if state == State.PRIMARY_STATE_UNCONFIGURED:
            missing = "" if Path(port).exists() else f"{port} does not exist"
            self._commander.refused = missing or self._commander.refused
            go_on = self.trigger_configure
        elif state == State.PRIMARY_STATE_INACTIVE:
            missing, go_on = "", self.trigger_activate
            if uncalibrated := self._uncalibrated():
                self._to_come = False
                self.get_logger().info(f"stays inactive: {uncalibrated}; then activate the node")
                return
        else:
            return
        if missing:
            if missing != self._waits_for:
                self.get_logger().info(f"waiting: {missing}")
            self._waits_for = missing
        elif go_on() != DONE:
            self._autostart_at = now + AUTOSTART_PERIOD

    def _reached(self, where: str) -> TransitionCallbackReturn:
        """Record that a transition has reached its state."""
        if AUTOSTARTS.index(where) >= AUTOSTARTS.index(self.values["autostart"]):
            self._to_come = False
        return DONE

    # --- tension

    def _tick(self) -> None:
        """Maintain the link, check the safety conditions, and send the set points that the gate lets through."""
        now = time.monotonic()
        self._autostart(now)
        commander = self._commander
        commander.mismatch = self._streams.problem
        if commander.keep_up(now):
            self._to_come = False
            self.diagnostics.warnings.note("stopped", "by the bench, until ~/reset_stop")
        self._report_link()
        self._report_sensors()
        if self._state != State.PRIMARY_STATE_ACTIVE:
            return
        problem = commander.problem() or (self._blind() if commander.gate.is_tight else "")
        if problem:
            self.diagnostics.warnings.note("fell back to inactive, cables slack", problem)
            self.trigger_deactivate()
            return
        before = commander.gate.abandoned
        commander.send(now)
        if commander.gate.abandoned and not before:
            tension_parameters.report_abandoned(self.diagnostics, self._limits)

    def _blind(self) -> str:
        """Describe why angles are lost for too long or not known yet; empty without a calibration."""
        streams = self._streams
        unread = max(0.0, time.monotonic() - streams.frame_read)  # for which the thread of the port had no turn
        lost_for = streams.lost_for + unread
        if streams.steps.missing or lost_for <= self.values["lost_angles_timeout"]:
            return ""
        if math.isinf(lost_for):
            return f"no angles are known yet: {streams.doubt}"
        return f"the angles are lost since {lost_for:.2f} s: {streams.doubt or 'the port is not read'}"

    def _uncalibrated(self) -> str:
        """Describe what is missing of the calibration that an active node needs; empty if nothing is."""
        missing = () if self.values["allow_uncalibrated"] else self._streams.steps.missing
        if not missing:
            return ""
        calls = ", ".join(CALIBRATE[step] for step in missing)
        return f"not calibrated: no {', no '.join(missing)}; call {calls}, or set the parameter allow_uncalibrated"

    def _report_link(self) -> None:
        """Log the loss and the return of the link in one line each; an active node falls back with a line."""
        problem = "" if self._commander.client is None else self._commander.line_problem()
        if problem and not self._link_problem and self._state == State.PRIMARY_STATE_INACTIVE:
            self.diagnostics.warnings.note("the link is lost", problem)
        elif self._link_problem and not problem and self._commander.client is not None:
            self.get_logger().info("the link is back")
        self._link_problem = problem

    def _report_sensors(self) -> None:
        """Log each loss, those of a burst together, and each return of a sensor, or of all, in one line."""
        watch, silent = self._streams.watch, self._streams.silent
        if silent and not self._all_lost:
            self.diagnostics.warnings.note("all sensors are lost", "no frames of the sensors, while others come")
        elif self._all_lost and not silent:
            self.get_logger().info("the frames of the sensors are back")
        self._all_lost = silent
        while watch is not None and watch.news:
            news = watch.news.popleft()
            if news.lost:
                self.diagnostics.warnings.note(
                    f"imu {news.link} is lost", f"no data of {news.name} for {news.gap:.2f} s"
                )
            else:
                self.get_logger().info(f"imu {news.link} is back: {news.name} was lost for {news.gap:.2f} s")

    def _on_command(self, message: CableStates) -> None:
        speakers = self.count_publishers(self.resolve_topic_name(COMMANDS))
        if speakers > 1:
            raise MessageFault("several commanders", f"{speakers} publishers; only one may command at a time")
        arrival, patience = self.arrival(), self.values["command_timeout"]
        wanted = read_tensions(message, self._planar.cables, arrival, patience)
        held = held_for(message, arrival, self.get_clock().now().nanoseconds, patience)
        blind = self._blind() if self._commander.gate.is_open else ""
        if blind:
            raise MessageFault("angles lost", blind)
        if not self._commander.gate.command(wanted, time.monotonic() - held):
            raise MessageFault("not active", "a tension command arrived; activate the node first")
        tension_parameters.report_limited(self.diagnostics, self._planar.cables, wanted, self._limits.max_tension)

    # --- services

    def _serve(self, carry_out: Callable[[], str], _request: Trigger.Request, response: Answer) -> Answer:
        """Carry out a request, and answer with the result or the reason of the failure."""
        try:
            response.message, response.success = carry_out(), True
            self.get_logger().info(response.message)
        except ContinuumError as error:
            response.message = str(error)
        return response

    def _calibrate(self, step: Callable[[SensorWatch], None]) -> str:
        watch, problem = self._streams.watch, self._commander.line_problem()
        if watch is None or problem:
            raise InvalidValueError("bench", problem or "unknown", "a matching bench that is configured and connected")
        step(watch)
        if watch is not self._streams.watch:
            raise InvalidValueError("bench", "restarted during the calibration", "a bench that stays; repeat the step")
        self._streams.calibrated(watch.steps)
        calibration, file = watch.steps.complete(), self.values["calibration"]
        if calibration is None:
            return f"found; still to find: {', '.join(watch.steps.missing)}"
        if not file:
            return "found; the calibration is complete, but not saved: the parameter calibration is empty"
        save_calibration(calibration, file)
        return f"found; the calibration is complete and written to {file}"

    def _release(self) -> str:
        _refuse_unless_done("the cables are not released", self._commander.let_go())
        return "all cables are slack"

    def _stop(self) -> str:
        self._to_come = False  # after a stop, only the user may activate the node
        self._commander.stop()
        return "stopped until ~/reset_stop; afterwards activate the node again"

    def _reset_stop(self) -> str:
        _refuse_unless_done("the stop persists", self._commander.reset_stop())
        return "the stop has ended; activate the node to command tension"

    def close(self) -> None:
        """Release the cables and close the port before the node ends."""
        self.on_shutdown(LifecycleState(*reversed(self._state_machine.current_state)))
        super().close()


def _refuse_unless_done(what: str, problem: str) -> None:
    if problem:
        raise BenchError(f"{what}: {problem}")

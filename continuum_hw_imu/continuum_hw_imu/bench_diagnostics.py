"""Diagnostics of a bench: one status on `/diagnostics` for each subject. docs/bench.md explains each one."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import numpy as np
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from continuum_hw_imu.bench_commander import STOPPED, BenchCommander
from continuum_hw_imu.bench_streams import BenchStreams
from continuum_hw_imu.protocol.messages import FaultCode, GuardState, Status
from continuum_hw_imu.recent import RateMeter, Recent

OK, WARN, ERROR, STALE = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR, DiagnosticStatus.STALE

LATE = 0.05
"""Age on arrival above which a sample counts as late [s]."""

SLOW = 0.01
"""Latency of the slowest percent above which a warning is given [s]."""

MOST_DRIFT = 200e-6
"""Drift that a quartz does not exceed."""

LOW, EMPTY = 20, 5
"""Battery charges of a sensor that give a warning and an error [%]."""

NOT_CONFIGURED = "not configured"

Complaint = tuple[bytes, str]
"""Level and description of a problem."""


class BenchDiagnostics:
    """Statuses of one node's bench.

    Args:
        prefix: name of the node.
        streams: the published streams.
        commander: commander of the bench; it has no client while the node is not configured.
        port: name of the port.
        n_sensors: number of sensors.
    """

    def __init__(
        self,
        prefix: str,
        streams: BenchStreams,
        commander: BenchCommander,
        port: str,
        n_sensors: int,
    ) -> None:
        self._prefix, self._streams, self._commander, self._port = prefix, streams, commander, port
        self._recent = Recent()
        self._frames, self._samples = RateMeter(), [RateMeter() for _ in range(n_sensors)]

    def subjects(self) -> list[Callable[[], DiagnosticStatus]]:
        """Return one function for each status."""
        sensors = [lambda k=k: self._sensor(k) for k in range(len(self._samples))]
        return [self._link, self._clock, *sensors, self._angles, self._tension]

    def _link(self) -> DiagnosticStatus:
        client = self._commander.client
        if client is None:
            refused = self._commander.refused
            why = (ERROR, refused) if refused else (STALE, NOT_CONFIGURED)
            return self._status("link", [why], {"port": self._port})
        latency, now = self._streams.latency, time.monotonic()
        talk = client.conversation  # the reading thread may start another one at any time
        damage = {f"damaged: {kind}": count for kind, count in client.decoder.errors.copy().items()}
        counts = {
            "frames lost": client.arrivals.lost,
            "frames repeated": client.arrivals.repeated,
            "frames overtaken": client.arrivals.late,
            "frames damaged": client.decoder.refused,
            "frames of other sensors or cables": self._streams.unfit,
            "writes refused by the port": client.link.refused,
        }
        if talk.status is not None:
            counts["frames that the bench found damaged"] = talk.status.refused
        slow = latency.quantile(0.99)
        problem = self._commander.line_problem()
        complaints = [*([(ERROR, problem)] if problem else []), *self._grown("link", counts)]
        if slow > SLOW:
            complaints.append((WARN, f"frames take {1e3 * slow:.1f} ms through this process"))
        values = {
            "port": self._port,
            "firmware": "" if talk.hello is None else talk.hello.firmware,
            "frames": client.decoder.good,
            "frame rate [Hz]": f"{self._frames.rate(client.decoder.good, now):.1f}",
            **counts,
            **damage,
            "times opened": client.link.openings,
            "requests": client.results.asked,
            "requests unanswered": client.results.unanswered,
            "latency, median [ms]": f"{1e3 * latency.quantile(0.5):.2f}",
            "latency, 99 % [ms]": f"{1e3 * slow:.2f}",
            "latency, largest [ms]": f"{1e3 * latency.largest:.2f}",
        }
        return self._status("link", complaints, values, "streaming")

    def _clock(self) -> DiagnosticStatus:
        client = self._commander.client
        if client is None or not client.clock.known:
            return self._status("clock", [(STALE, NOT_CONFIGURED if client is None else "nothing received yet")], {})
        clock, age = client.clock, self._streams.age
        complaints = list(self._grown("clock", {"clock jumps": clock.leaps}))
        oldest, self._streams.oldest = self._streams.oldest, 0.0  # since the last report
        if oldest > LATE:
            complaints.append((WARN, f"samples come up to {1e3 * oldest:.0f} ms late"))
        if abs(clock.drift) > MOST_DRIFT:
            complaints.append((WARN, f"drifts by {1e6 * clock.drift:.0f} ppm; a quartz drifts less"))
        complaints += self._unheard()
        error = clock.error(client.conversation.newest)
        values = {
            "drift [ppm]": f"{1e6 * clock.drift:.1f}",
            "largest possible error of a stamp [ms]": "unknown" if np.isinf(error) else f"{1e3 * error:.2f}",
            "age of the newest sample [ms]": f"{1e3 * age:.2f}",
            "leaps": clock.leaps,
        }
        return self._status("clock", complaints, values, "device time is known")

    def _sensor(self, k: int) -> DiagnosticStatus:
        subject, client, watch = f"imu {k + 1}", self._commander.client, self._streams.watch
        hello = None if client is None else client.conversation.hello
        if client is None or watch is None or hello is None:
            return self._status(subject, [(STALE, NOT_CONFIGURED if client is None else "no bench")], {})
        missing, clipped = int(watch.missing[k]), int(watch.clipped[k])
        at = next((i for i, sensor in enumerate(hello.sensors) if sensor.link == k + 1), None)
        if at is None:  # another bench has just identified itself
            return self._status(subject, [(STALE, "no bench")], {})
        status = client.conversation.status
        battery = status.batteries[at] if status is not None and at < len(status.batteries) else None
        rate = self._samples[k].rate(watch.samples - missing, time.monotonic())
        complaints = list(self._grown(subject, {"samples missing": missing, "samples clipped": clipped}))
        expected = hello.sample_rate
        if not watch.received[k] or self._commander.line_problem():
            complaints.append((ERROR, "no data"))
        elif rate < 0.95 * expected:
            complaints.append((WARN, f"{rate:.1f} Hz instead of {expected:g} Hz"))
        if battery is not None and battery <= LOW:
            complaints.append((ERROR if battery <= EMPTY else WARN, f"battery at {battery} %"))
        values = {
            "name": hello.sensors[at].name,
            "rate [Hz]": f"{rate:.1f}",
            "samples missing": missing,
            "samples clipped": clipped,
            "battery [%]": "unknown" if battery is None else battery,
        }
        return self._status(subject, complaints, values, "measures")

    def _angles(self) -> DiagnosticStatus:
        streams, watch = self._streams, self._streams.watch
        if self._commander.client is None or watch is None:
            return self._status(
                "angles", [(STALE, NOT_CONFIGURED if self._commander.client is None else "no bench")], {}
            )
        estimate, complaints = watch.estimate, list(self._grown("angles", {"samples withheld": streams.withheld}))
        if unheard := self._unheard():
            complaints += unheard
        elif watch.steps.missing:
            complaints.append((ERROR, f"not calibrated: no {', no '.join(watch.steps.missing)}"))
        elif estimate is None:
            complaints.append((ERROR, "no samples"))
        elif streams.doubt:
            complaints.append((ERROR, streams.doubt))
        values: dict[str, object] = {"samples withheld": streams.withheld}
        if estimate is not None:
            values["estimated error of the worst joint [deg]"] = f"{np.degrees(estimate.errors.max()):.2f}"
            values["at rest"] = "yes" if estimate.resting.all() else "no"
        values |= {f"calibration of imu {k}": text for k, text in enumerate(watch.steps.sources, start=1)}
        return self._status("angles", complaints, values, "joint angles are known")

    def _tension(self) -> DiagnosticStatus:
        client = self._commander.client
        status = None if client is None else client.conversation.status
        if client is None or status is None:
            why = NOT_CONFIGURED if client is None else "no status of the bench"
            stop = [(ERROR, STOPPED)] if self._commander.gate.stopped else []
            return self._status("tension", [*stop, (STALE, why)], {})
        complaints = list(_faults(status))
        if self._commander.gate.stopped or status.state is GuardState.STOPPED:
            complaints.insert(0, (ERROR, STOPPED))
        refused = {
            f"answers: {result.name.lower()}": n for result, n in client.results.counts.copy().items() if result.value
        }
        complaints += [*self._grown("tension", refused), *self._unheard()]
        values: dict[str, object] = {
            "node": "forwards commands" if self._commander.gate.is_open else "forwards nothing",
            "bench": status.state.name.lower(),
            "cause of the last release": status.cause.name.lower(),
            "commander": "this node" if client.commands else "another" if status.claimed else "nobody",
            **refused,
        }
        if self._streams.tension is not None:
            frame = self._streams.tension
            values["set points [N]"] = ", ".join(f"{tension:.2f}" for tension in frame.set_points)
            values["measured [N]"] = ", ".join("?" if t is None else f"{t:.2f}" for t in frame.measured)
        return self._status("tension", complaints, values, status.state.name.lower().replace("_", " "))

    def _unheard(self) -> list[Complaint]:
        """Mark the last received values as stale while the link is down."""
        return [(STALE, f"last received values: {problem}")] if (problem := self._commander.line_problem()) else []

    def _grown(self, subject: str, counts: dict[str, int]) -> Iterable[Complaint]:
        """Yield a warning for each count that has grown recently."""
        now = time.monotonic()
        for cause, count in counts.items():
            if self._recent.grew(f"{subject}: {cause}", count, now):
                yield WARN, f"{count} {cause}"

    def _status(
        self, subject: str, complaints: Iterable[Complaint], values: dict[str, object], well: str = ""
    ) -> DiagnosticStatus:
        """Return a status; the worst of the complaints sets the level and comes first."""
        ordered = sorted(complaints, key=lambda complaint: -_WEIGHT.index(complaint[0]))
        return DiagnosticStatus(
            level=ordered[0][0] if ordered else OK,
            name=f"{self._prefix}: {subject}",
            hardware_id=self._port,
            message="; ".join(text for _, text in ordered) or well,
            values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
        )


_WEIGHT = (OK, WARN, STALE, ERROR)


def _faults(status: Status) -> Iterable[Complaint]:
    """Yield the faults of the bench that no other subject reports."""
    for code in FaultCode:
        if status.faults >> code & 1 and code not in (FaultCode.SENSOR_LOST, FaultCode.BATTERY_LOW):
            level = ERROR if code is FaultCode.ACTUATOR else WARN
            yield level, f"the bench reports: {code.name.lower().replace('_', ' ')}"

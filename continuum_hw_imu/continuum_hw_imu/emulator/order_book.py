"""Schedule of orders: carries them out at their times, and ends their effects."""

from __future__ import annotations

import heapq
import json
from collections.abc import Callable
from itertools import count

import numpy as np

from continuum.errors import ContinuumError
from continuum_hw_imu.emulator.emulator import Emulator
from continuum_hw_imu.emulator.hand import Hand
from continuum_hw_imu.emulator.line_faults import LineFault, LineFaultKind
from continuum_hw_imu.emulator.orders import ON_THE_LINE, Order, read_order

_Deed = Callable[[float], None]


class OrderBook:
    """Schedule of orders; times [s] are those of the emulator's clock.

    Args:
        emulator: the emulator that carries out the orders.
    """

    def __init__(self, emulator: Emulator) -> None:
        self._emulator = emulator
        self._to_come: list[tuple[float, int, _Deed]] = []
        self._to_end: list[tuple[float, int, _Deed]] = []
        self._numbers = count()

    @property
    def wake_at(self) -> float:
        """Return the time at which the next action is due [s]."""
        return min([entry[0] for entry in (*self._to_come[:1], *self._to_end[:1])], default=np.inf)

    def add(self, order: Order) -> None:
        """Schedule an order; its time counts from the emulator's start.

        Raises:
            InvalidValueError: the bench has no sensor of that number.
        """
        sensor = order.numbers.get("sensor")
        if sensor is not None:
            self._emulator.bench.check_sensor(int(sensor))
        self._push(self._to_come, self._emulator.began + order.at, lambda now: self._carry_out(order, now))

    def step(self, now: float) -> None:
        """Carry out the actions that are due."""
        for book in (self._to_end, self._to_come):
            while book and book[0][0] <= now:
                heapq.heappop(book)[2](now)

    def answer(self, line: str, now: float) -> str:
        """Carry out the order of a line, at once or at its time, or report the state; return the answer as JSON."""
        if line == "status":
            return json.dumps({"ok": True} | self._status(now))
        try:
            self.add(read_order(line))
        except ContinuumError as error:
            return json.dumps({"ok": False, "error": str(error)})
        self.step(now)
        return json.dumps({"ok": True})

    def _push(self, book: list[tuple[float, int, _Deed]], when: float, deed: _Deed) -> None:
        heapq.heappush(book, (when, next(self._numbers), deed))

    def _carry_out(self, order: Order, now: float) -> None:
        emulator, bench, numbers = self._emulator, self._emulator.bench, order.numbers
        sensor = int(numbers.get("sensor", 1)) - 1
        match order.action:
            case action if action in ON_THE_LINE:
                self._spoil_line(order, now)
            case "drop":
                bench.sensors.lost.add(sensor)
                self._later(order, now, lambda _: bench.sensors.lost.discard(sensor))
            case "mute":
                bench.mute = True
                self._later(order, now, lambda _: setattr(bench, "mute", False))
            case "clip":
                bench.sensors.narrowed[sensor] = np.radians(numbers["range"])
                self._later(order, now, lambda _: bench.sensors.widen(sensor))
            case "battery":
                bench.controller.batteries[sensor] = round(numbers["percent"])
            case "drift":
                emulator.clock.drift_from(now, numbers["ppm"])
            case "unplug":
                emulator.unplug()
                self._later(order, now, lambda _: emulator.port.plug())
            case "freeze":
                bench.deaf = True
                self._later(order, now, lambda _: setattr(bench, "deaf", False))
            case "reboot":
                emulator.reboot(now)
            case "hand":
                goal = np.full(bench.n_joints, np.radians(numbers["bend"]) / bench.n_joints)
                bench.hand = Hand(now, bench.arm.angles.copy(), goal, numbers["over"], numbers["hold"])
            case "clear":
                self._clear(now)

    def _spoil_line(self, order: Order, now: float) -> None:
        numbers = order.numbers
        fault = LineFault(
            LineFaultKind(order.action),
            numbers["share"],
            now + numbers["for"],
            numbers.get("by", 0.0),
            int(numbers.get("size", 0.0)),
        )
        if order.way in ("up", "both"):
            self._emulator.up.add(fault)
        if order.way in ("down", "both"):
            self._emulator.down.add(fault)

    def _later(self, order: Order, now: float, deed: _Deed) -> None:
        self._push(self._to_end, now + order.numbers["for"], deed)

    def _clear(self, now: float) -> None:
        self._to_come.clear()
        self._emulator.up.clear()
        self._emulator.down.clear()
        self._emulator.bench.hand = None
        while self._to_end:
            heapq.heappop(self._to_end)[2](now)

    def _status(self, now: float) -> dict[str, object]:
        emulator, bench = self._emulator, self._emulator.bench
        guard, controller = bench.controller.guard, bench.controller
        return {
            "time": now - emulator.began,
            "monotonic": now,
            "device_time": emulator.clock.at(now),
            "port": emulator.port.name if emulator.port.plugged else None,
            "open": emulator.port.open,
            "angles": bench.arm.angles.tolist(),
            "rates": bench.arm.rates.tolist(),
            "set_points": guard.set_points.tolist(),
            "largest_set_point": emulator.largest_set_point,
            "tensions": bench.actuators.tension.tolist(),
            "state": guard.state.name,
            "cause": guard.cause.name,
            "claimed": guard.claimed,
            "received": controller.decoder.good,
            "refused": controller.decoder.refused,
            "hit_up": emulator.up.hit,
            "hit_down": emulator.down.hit,
            "dropped": emulator.port.dropped,
            "skipped": emulator.skipped,
            "waiting_orders": len(self._to_come),
        }

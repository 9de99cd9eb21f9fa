"""docs/bench-protocol.md against the code: types, sizes, numbers of states and results, limits, the byte budget."""

import re
from pathlib import Path

import numpy as np
import pytest

from continuum_hw_imu.emulator.bench import FIRMWARE
from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.frame import LONGEST_BODY, VERSION, Frame
from continuum_hw_imu.protocol.messages.imu import FORCE_STEP, RATE_STEP
from continuum_hw_imu.receiver.bench_controller import STATUS_PERIOD

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "bench-protocol.md").read_text(encoding="utf-8")
WORDS = " ".join(PAGE.split())
LIMITS = m.ReceiverLimits()
BITS_A_BYTE = 10


def examples(sensors: int = 5, cables: int = 2) -> dict[str, m.Message]:
    """A message of every type, by its name on the page."""
    places = tuple(m.SensorPlace(i + 1, f"DOT-{i + 1}") for i in range(sensors))
    still = np.zeros((sensors, 3))
    return {
        "HELLO": m.Hello(1, FIRMWARE, 60.0, places, cables, LIMITS),
        "IMU": m.ImuFrame.of(0, still, still, np.zeros(sensors)),
        "TENSION": m.TensionFrame((0.0,) * cables, (0.0,) * cables),
        "ACK": m.Ack(0, 0, m.Result.DONE),
        "STATUS": m.Status(m.GuardState.SLACK, m.Cause.START, False, 0, 0, 0, (0,) * sensors),
        "FAULT": m.Fault(m.FaultCode.OVERRUN),
        "HELLO_REQUEST": m.HelloRequest(),
        "CLAIM": m.Claim(0),
        "RELEASE": m.Release(0),
        "HEARTBEAT": m.Heartbeat(0),
        "SET_TENSION": m.SetTension(0, 0, (0.0,) * cables),
        "STOP": m.Stop(),
        "RESET_STOP": m.ResetStop(0, 0),
        "LET_GO": m.LetGo(0),
    }


def size(message: m.Message) -> int:
    return len(Frame(0, 0, message).encode())


def load(rates: dict[str, int], sensors: int = 5) -> int:
    """Bytes a second."""
    return sum(rate * size(examples(sensors)[name]) for name, rate in rates.items())


UP = {"IMU": 60, "TENSION": 60, "STATUS": 10, "ACK": 60}
DOWN = {"SET_TENSION": 60, "HEARTBEAT": 20}


def test_the_table_of_messages_is_that_of_the_code():
    rows = re.findall(r"^\| (0x\w\w) \| (\w+) \|.*\| (\d+) \|$", PAGE, re.MULTILINE)
    expected = [(f"0x{message.TYPE:02X}", name, str(size(message))) for name, message in examples().items()]
    assert rows == expected
    assert [kind.TYPE for kind in (*m.OF_DEVICE, *m.OF_HOST)] == [message.TYPE for message in examples().values()]


@pytest.mark.parametrize("kind", [m.GuardState, m.Cause, m.Result, m.FaultCode])
def test_numbers_and_names_are_reported(kind):
    assert [member for member in kind if f"{member.value} {member.name}" not in WORDS] == []


@pytest.mark.parametrize(("way", "rates"), [("host", UP), ("device", DOWN)])
def test_the_byte_budget_is_right(way, rates):
    bytes_a_second = load(rates)
    shares = [f"{100 * BITS_A_BYTE * bytes_a_second / baud:.1f} %" for baud in (115200, 921600)]
    assert f"| to the {way} | {bytes_a_second} | {shares[0]} | {shares[1]} |" in PAGE


def test_what_is_said_next_to_the_budget():
    assert f"({100 * BITS_A_BYTE * load(UP, 10) / 115200:.1f} %)" in PAGE
    times = [size(examples()["IMU"]) * BITS_A_BYTE / baud * 1e3 for baud in (115200, 921600)]
    assert f"takes {times[0]:.1f} ms on the line at 115200 baud and {times[1]:.1f} ms at 921600" in WORDS
    assert STATUS_PERIOD * UP["STATUS"] == 1e6


def test_steps_limits_and_versions():
    assert f"[{RATE_STEP} deg/s]" in PAGE
    assert f"[{FORCE_STEP} m/s²]" in PAGE
    assert f"has {LONGEST_BODY} bytes at most" in WORDS
    assert f"Version {VERSION}." in PAGE
    for name, value, unit in (
        ("heartbeat timeout", LIMITS.heartbeat_timeout, "s"),
        ("command timeout", LIMITS.command_timeout, "s"),
        ("slack time", LIMITS.slack_time, "s"),
        ("max tension", LIMITS.max_tension, "N"),
        ("max rate", LIMITS.max_rate, "N/s"),
    ):
        assert f"`{name}` ({value:g} {unit})" in WORDS


def test_the_times_to_slack():
    assert f"slack {LIMITS.slack_after} s after the last set point was decided" in WORDS
    assert f"{LIMITS.heartbeat_timeout + LIMITS.slack_time} s after the last sign of life" in WORDS
    assert f"{LIMITS.slack_time} s after the port was seen to close" in WORDS

"""What goes wrong on request at the emulated bench does, costs what it must, and leaves the cables slack in time."""

import os
from collections.abc import Iterator
from pathlib import Path

import pytest
from bench_lab import STEP, Lab, of

from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.decoder import Garbage

pytestmark = pytest.mark.slow


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Lab]:
    lab = Lab(tmp_path)
    yield lab
    lab.close()


@pytest.mark.parametrize(
    ("end", "longest"),
    [("closed", 0.5), ("silent", 0.75), ("unplugged", 0.5), ("frozen", 0.75), ("deaf host", 1.0), ("lost", 0.75)],
)
def test_it_is_slack_in_time_however_the_host_goes(lab, end, longest):
    lab.pulling()
    begin = lab.now
    match end:
        case "closed":
            lab.shut()
        case "unplugged":
            lab.order("unplug for=5")
        case "frozen" | "lost":  # the host does not know, and commands on
            lab.order("freeze for=5" if end == "frozen" else "lose for=5 way=down")
            while lab.bench.controller.guard.set_points.any():
                lab.run(8 * STEP, pull=(20.0, 0.0))
                assert lab.now < begin + 5
        case "deaf host":
            newest = lab.newest
            while lab.bench.controller.guard.set_points.any():
                lab.newest = newest  # it hears nothing new, and commands on
                lab.run(8 * STEP, pull=(20.0, 0.0))
                assert lab.now < begin + 5
    assert lab.now - begin + lab.seconds_to_slack() <= longest + 0.05
    assert lab.order("status")["largest_set_point"] <= 20.0


def test_without_hang_up_it_has_its_time_outs(tmp_path):
    lab = Lab(tmp_path, sees_hang_up=False)
    lab.pulling()
    lab.shut()
    lab.run(0.1)
    assert lab.bench.controller.guard.claimed
    assert lab.seconds_to_slack() <= 0.7
    lab.emulator.close()


@pytest.mark.parametrize("begin", ["unplug for=0.5", "reboot"])
def test_tension_is_zero_when_the_link_is_back_and_nobody_commands(lab, begin):
    lab.pulling()
    boots = {message.boot for message in of(m.Hello, lab.frames)}
    lab.order(begin)
    lab.run(0.6)
    if "unplug" in begin:
        lab.shut()
        lab.open()
    frames = lab.run(0.4, pull=(20.0, 0.0))
    assert not lab.bench.controller.guard.set_points.any()
    assert {ack.result for ack in of(m.Ack, frames)} == {m.Result.NOT_COMMANDER}
    hellos = of(m.Hello, lab.frames)
    assert len(hellos) == 2
    assert (hellos[-1].boot in boots) == ("unplug" in begin)


def test_an_unplugged_port_is_gone_with_its_link_and_comes_back(lab):
    lab.open()
    lab.run(0.1)
    lab.order("unplug for=0.5")
    lab.run(0.25)
    assert not lab.link.is_symlink()
    with pytest.raises(OSError):
        os.write(lab.port, b"x")
    lab.run(0.5)
    lab.shut()
    lab.open()
    assert len(of(m.ImuFrame, lab.run(1.0))) == 60


def test_frames_of_before_do_not_reach_the_next_host(lab):
    lab.open()
    for _ in range(100):
        lab.now += STEP
        lab.emulator.step(lab.now)  # the host does not read
    lab.shut()
    lab.run(0.5)
    lab.open()
    assert isinstance(lab.run(0.5)[0].message, m.Hello)


def test_a_host_that_does_not_read_costs_whole_frames_only(lab):
    lab.open()
    for _ in range(60 * 20):
        lab.now += 1 / 60
        lab.emulator.step(lab.now)
    lab.run(1.0)
    assert lab.emulator.port.dropped > 0
    assert lab.decoder.refused == 0
    assert lab.arrivals.lost == lab.emulator.port.dropped


def test_damaged_and_noisy_lines_cost_what_they_touch(lab):
    lab.open()
    lab.run(0.1)
    lab.order("damage share=0.2 for=3")
    lab.order("noise share=0.2 for=3")
    lab.run(3.1)
    good = lab.decoder.good
    assert lab.decoder.refused > 20
    assert lab.arrivals.lost > 20
    assert not lab.decoder.errors[Garbage.PAYLOAD]
    lab.run(1.0)
    assert lab.decoder.good - good >= 125


def test_sensors_drop_out_clip_and_run_low(lab):
    lab.open()
    lab.run(0.1)
    lab.order("drop sensor=3 for=0.5")
    lab.order("clip sensor=2 range=0 for=0.5")
    lab.order("battery sensor=5 percent=7")
    frames = lab.run(0.4)
    image = of(m.ImuFrame, frames)[-1]
    assert image.present.tolist() == [True, True, False, True, True]
    assert set(of(m.Fault, frames)) == {m.Fault(m.FaultCode.SENSOR_LOST, 3), m.Fault(m.FaultCode.BATTERY_LOW, 5)}
    status = of(m.Status, frames)[-1]
    assert status.faults == 1 << m.FaultCode.SENSOR_LOST | 1 << m.FaultCode.BATTERY_LOW
    assert status.batteries[4] == 7
    lab.order("hand bend=30 over=0.1 hold=0")
    assert of(m.ImuFrame, lab.run(0.05))[-1].clipped.tolist() == [False, True, False, False, False]
    assert of(m.ImuFrame, lab.run(0.5))[-1].present.all()


def test_clear_ends_what_lasts_and_what_is_to_come(lab):
    lab.open()
    lab.order("lose for=100")
    lab.order("drop sensor=1 for=100")
    lab.order("freeze for=100")
    lab.order("at 1000 unplug")
    assert lab.run(0.2) == []
    assert lab.order("status")["waiting_orders"] == 1
    lab.order("clear")
    frames = lab.run(0.5)
    assert of(m.ImuFrame, frames)[-1].present.all()
    assert lab.order("status")["waiting_orders"] == 0
    assert not lab.bench.deaf


def test_a_machine_that_sleeps_skips_time_and_says_so(lab):
    lab.open()
    lab.run(0.2)
    lab.now += 30.0
    lab.run(1.0)
    assert lab.emulator.skipped == pytest.approx(30.0, abs=1.0)
    assert len(of(m.ImuFrame, lab.run(1.0))) == 60

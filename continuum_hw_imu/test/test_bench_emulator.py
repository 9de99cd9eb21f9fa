"""The whole emulator on a real pseudo-terminal, without waiting for a clock: it streams, obeys and tells the truth."""

import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from bench_lab import Lab, of

from continuum_hw_imu.protocol import messages as m

WRAP = 1 << 32


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[Lab]:
    lab = Lab(tmp_path)
    yield lab
    lab.close()


def test_it_says_who_it_is_and_streams_at_its_rate(lab):
    lab.open()
    frames = lab.run(2.0)
    assert isinstance(frames[0].message, m.Hello)
    assert [sensor.link for sensor in frames[0].message.sensors] == [1, 2, 3, 4, 5]
    images = [frame for frame in frames if isinstance(frame.message, m.ImuFrame)]
    assert len(images) in (119, 120)  # the last one may be just due
    gaps = np.diff([frame.time for frame in images])
    assert set(gaps.tolist()) <= {16666, 16667}
    assert set(np.diff([frame.message.sample for frame in images]).tolist()) == {1}
    assert (lab.arrivals.lost, lab.decoder.refused) == (0, 0)


def test_sums_of_its_rates_are_the_true_angles(lab):
    lab.open()
    lab.run(0.1)
    lab.order("hand bend=90 over=0.5 hold=0.2")
    frames = lab.run(2.0)
    images = [frame for frame in frames if isinstance(frame.message, m.ImuFrame)]
    rates = np.array([frame.message.angular_rates[:, 1] for frame in images])
    links = np.cumsum(rates / 60, axis=0)
    with lab.truth.open() as file:
        rows = {int(row["device_time_us"]): row for row in csv.DictReader(file)}
    true = np.array([[float(rows[frame.time][f"theta_{i}"]) for i in range(1, 6)] for frame in images])
    assert np.degrees(np.abs(true).max()) > 15
    # steps of 0.0625 deg/s, each rounded, over 120 samples of 1/60 s
    np.testing.assert_allclose(np.diff(links, axis=1, prepend=0.0), true, atol=np.radians(0.1))


def test_a_cable_pulls_the_arm_to_its_side(lab):
    lab.pulling()
    lab.run(1.0, pull=(20.0, 0.0))
    assert np.all(lab.bench.arm.angles > 0.05)
    frame = of(m.TensionFrame, lab.frames)[-1]
    assert frame.set_points == (20.0, 0.0)
    assert frame.measured == pytest.approx((20.0, 0.0), abs=0.3)


def test_the_clock_drifts_as_reported_and_wraps(tmp_path):
    lab = Lab(tmp_path, clock_start=WRAP - 500_000)
    lab.open()
    lab.order("drift ppm=500")
    frames = [frame for frame in lab.run(2.0) if isinstance(frame.message, m.ImuFrame)]
    assert len(frames) in (120, 121)
    assert frames[0].time > frames[-1].time
    device = lab.order("status")["device_time"]
    assert device == pytest.approx(WRAP - 500_000 + 2_001_000, abs=3_000)
    lab.shut()
    lab.emulator.close()


def test_it_reports_when_sound_frames_left(tmp_path):
    lab = Lab(tmp_path, sent=tmp_path / "sent.csv")
    try:
        lab.open()
        lab.run(0.5)
        lab.order("damage share=1 for=0.5")
        lab.run(0.5)
        whole = lab.run(0.5)
    finally:
        lab.close()
    rows = (tmp_path / "sent.csv").read_text().splitlines()[1:]
    frames = [frame for frame in lab.frames if isinstance(frame.message, m.ImuFrame)]
    assert [row.split(",")[1:] for row in rows] == [[str(frame.time), str(frame.sequence)] for frame in frames]
    assert len(rows) < 70
    assert len(of(m.ImuFrame, whole)) > 25

"""Units of the messages on the line, against numbers worked out by hand."""

import numpy as np

from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.messages.imu import PRESENT


def test_rates_and_forces_come_out_within_half_a_step():
    random = np.random.default_rng(1)
    rates, forces = random.uniform(-30, 30, (5, 3)), random.uniform(-150, 150, (5, 3))
    frame = m.ImuFrame.of(1, rates, forces, np.full(5, PRESENT))
    read = m.ImuFrame.decode(frame.encode())
    np.testing.assert_allclose(read.angular_rates, rates, atol=np.radians(0.0625) / 2 + 1e-12)
    np.testing.assert_allclose(read.specific_forces, forces, atol=0.0025 + 1e-12)


def test_a_frame_of_one_sensor_byte_by_byte():
    payload = bytes.fromhex("02011000f0ff0000c80038ff000088")
    frame = m.ImuFrame.decode(payload)
    assert frame.sample == 0x0102
    np.testing.assert_allclose(frame.angular_rates, np.radians([[1.0, -1.0, 0.0]]))
    np.testing.assert_allclose(frame.specific_forces, [[1.0, -1.0, 0.0]])
    assert frame.clipped.tolist() == [True]
    assert frame.present.tolist() == [True]
    assert frame.encode() == payload


def test_what_is_beyond_the_range_is_its_end():
    frame = m.ImuFrame.of(0, np.full((1, 3), 1e6), np.full((1, 3), -1e6), np.array([PRESENT]))
    assert frame.readings[0][:6] == (0x7FFF, 0x7FFF, 0x7FFF, -0x7FFF, -0x7FFF, -0x7FFF)


def test_a_flag_for_each_sensor():
    frame = m.ImuFrame.of(0, np.zeros((3, 3)), np.zeros((3, 3)), np.array([0x00, 0x80, 0x90]))
    assert frame.present.tolist() == [False, True, True]
    assert frame.clipped.tolist() == [False, False, True]


def test_tensions_byte_by_byte():
    frame = m.TensionFrame((20.0, 0.5), (-0.25, None))
    assert frame.encode() == bytes.fromhex("d0073200e7ff0080")
    assert m.TensionFrame.decode(frame.encode()) == frame


def test_measured_tensions_beyond_the_range_are_its_end():
    frame = m.TensionFrame((0.0, 0.0), (1e6, -1e6))
    assert m.TensionFrame.decode(frame.encode()).measured == (327.67, -327.67)

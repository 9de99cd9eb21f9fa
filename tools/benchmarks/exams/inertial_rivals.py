"""Methods for the angle between two inertial sensors, one of which rotates about an axis fixed in the other.

All return the rotation since the first reading about the same axis, (n_times,) [rad].
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.spatial.transform import Rotation
from vqf import VQF, offlineVQF

from continuum.arrays import Array
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.integrated_rate import integrated


def raw_difference(recording: ImuRecording, axis: Array) -> Array:
    """Integrate the difference of both gyroscopes' raw components that are closest to the axis."""
    component = int(np.argmax(np.abs(axis)))
    rate = (recording.rates[:, 1] - recording.rates[:, 0])[:, [component]] * np.sign(axis[component])
    return np.asarray(integrated(recording.times, rate)[:, 0])


def complementary(recording: ImuRecording, axis: Array) -> Array:
    """Mahony's filter (IEEE Transactions on Automatic Control 53, 2008) of each sensor, in its proportional form.

    The direction of the accelerometer's reading corrects the inclination with the time constant of
    `continuum.inertial` at rest. The heading is the integral of the rate.
    """
    gain = 1 / EstimatorSettings().time_constant
    up = recording.forces / np.linalg.norm(recording.forces, axis=2, keepdims=True)
    turned = [_mahony(recording.times, recording.rates[:, i], up[:, i], gain) for i in (0, 1)]
    return _twist(turned[0], turned[1], axis)


def _mahony(times: Array, rates: Array, up: Array, gain: float) -> Rotation:
    """Rotations from the sensor to the world, whose z is up, at all times."""
    q = np.empty((times.size, 4))  # x, y, z, w
    q[0] = Rotation.align_vectors([[0, 0, 1]], [up[0]])[0].as_quat()
    for k, step in enumerate(np.diff(times), start=1):
        x, y, z, w = q[k - 1]
        expected = np.array([2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z])
        a, b, c = (rates[k] + gain * np.cross(up[k], expected)) * step / 2
        turn = [w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a, -(x * a + y * b + z * c)]
        q[k] = q[k - 1] + turn
        q[k] /= np.linalg.norm(q[k])
    return Rotation.from_quat(q)


def vqf_online(recording: ImuRecording, axis: Array) -> Array:
    """VQF without magnetometer (Laidig, Seel, Information Fusion 91, 2023) with its default parameters."""
    return _by_vqf(recording, axis, lambda rates, forces, period: VQF(period).updateBatch(rates, forces))


def vqf_without_rests(recording: ImuRecording, axis: Array) -> Array:
    """VQF with bias estimation from motion only."""
    return _by_vqf(
        recording, axis, lambda rates, forces, period: VQF(period, restBiasEstEnabled=False).updateBatch(rates, forces)
    )


def vqf_offline(recording: ImuRecording, axis: Array) -> Array:
    """VQF's variant for recordings, which also uses later readings."""
    return _by_vqf(recording, axis, lambda rates, forces, period: offlineVQF(rates, forces, None, period))


def _by_vqf(recording: ImuRecording, axis: Array, run: Callable[[Array, Array, float], dict[str, Array]]) -> Array:
    period = float(np.mean(np.diff(recording.times)))
    both = []
    for i in (0, 1):
        rates, forces = (np.ascontiguousarray(block[:, i]) for block in (recording.rates, recording.forces))
        both.append(Rotation.from_quat(run(rates, forces, period)["quat6D"], scalar_first=True))
    return _twist(both[0], both[1], axis)


def _twist(first: Rotation, second: Rotation, axis: Array) -> Array:
    """Return the rotation of the second sensor relative to the first since the start, about an axis in the second."""
    relative = first.inv() * second
    q = (relative[0].inv() * relative).as_quat()
    return np.asarray(np.unwrap(2 * np.arctan2(q[:, :3] @ axis, q[:, 3])))

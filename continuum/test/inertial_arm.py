"""An arm with inertial sensors of which the truth is known: the prototype's model moves it, a sensor model reads it.

It hangs; x is towards cable 1, z down along the straight arm, so that positive bends turn about +y.
"""

from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.model_file import load_model
from continuum.dynamics.pulled_posture import pulled_posture
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.tensions import Tensions
from continuum.dynamics.trajectory import SimulationStatus
from continuum.inertial.angle_estimator import AngleEstimate, AngleEstimator
from continuum.inertial.calibration import CalibrationSteps
from continuum.inertial.calibration_values import Calibration
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording

N = 5
FINE = 960  # simulated instants a second, of which readings are means
SPACING, BEYOND = 0.0385, 0.03  # m: of the joints, and of the sensors beyond their joints
GRAVITY = 9.81
REST, PULL, HOLD, SWING = 6.0, 8.0, 3.0, 8.0  # s
RELEASE = REST + PULL + HOLD

DEG = np.pi / 180


@dataclass(frozen=True)
class Motion:
    """The truth: joint angles (n_times, n) [rad] and rates [rad/s] at times (n_times,) [s]."""

    times: Array
    theta: Array
    rate: Array

    def at(self, times: Array) -> tuple[Array, Array]:
        """Angles and rates at some times, linear in between."""
        return tuple(
            np.stack([np.interp(times, self.times, column) for column in block.T], axis=1)
            for block in (self.theta, self.rate)
        )


@cache
def pull_and_release(total: float = 90.0) -> Motion:
    """Straight at rest, pulled slowly to a total bend [degrees], held, and let go: the thesis's test."""
    model = load_model("lamecc_prototype.yaml")
    held = pulled_posture(model, np.radians(total)).tension
    times = np.arange(int((RELEASE + SWING) * FINE) + 1) / FINE
    rows = np.array([0.0, REST, REST + PULL, RELEASE, RELEASE + 0.004])
    tensions = Tensions(rows, np.outer([0, 0, 1.02, 1.02, 0], held))
    run = Simulator(model).run(np.zeros(N), times, tensions)
    assert run.status is SimulationStatus.COMPLETE
    return Motion(times, run.theta, run.theta_rate)


@dataclass(frozen=True)
class SensorModel:
    """Errors of the sensors, like those that exports of Xsens DOT show.

    Attributes:
        mounting: standard deviation of the plates' angles from the nominal [rad]; with random turns, every sensor is
            besides mounted in any of the ways in which it can be turned.
        bias: of the gyroscopes [rad/s].
        rate_noise, force_noise: of readings at 120 Hz [rad/s, m/s2], standard deviation; grow with the rate's root.
        force_bias: of the accelerometers, after the vendor's calibration [m/s2].
        rate_scale: standard deviation of the gyroscopes' scale from 1.
        rate_limit: at which they clip [rad/s].
        means: rates are means over the period, else the rate at the instant.
    """

    mounting: float = 3 * DEG
    bias: float = 0.3 * DEG
    rate_noise: float = 0.06 * DEG
    force_noise: float = 0.012
    force_bias: float = 0.01
    rate_scale: float = 0.001
    rate_limit: float = 2000 * DEG
    means: bool = True


PERFECT = SensorModel(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def rotation(axis: Array, angle: float) -> Array:
    """R(axis, angle), by Rodrigues' formula."""
    cross = np.cross(np.eye(3), axis)  # times v: axis x v
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def any_rotation(rng: np.random.Generator) -> Array:
    return np.linalg.qr(rng.normal(size=(3, 3)))[0]


def sensed(motion: Motion, rate: float, sensors: SensorModel, seed: int) -> tuple[ImuRecording, Array]:
    """Readings at ``rate`` a second, and the axes of the links in the sensors' frames, (n, 3)."""
    fixed, rng = np.random.default_rng(seed).spawn(2)
    alpha, speed = np.cumsum(motion.theta, axis=1), np.cumsum(motion.rate, axis=1)
    force = _specific_force(motion.times, alpha, speed)
    per = round(FINE / rate)
    ends = np.arange(per, motion.times.size, per)
    means = np.diff(alpha[::per], axis=0)[: ends.size] * rate
    spin = means if sensors.means else speed[ends]
    force = np.stack([force[end - per : end + 1].mean(axis=0) for end in ends])
    rates, forces = np.zeros((2, ends.size, N, 3))
    axes = np.zeros((N, 3))
    grow = np.sqrt(rate / 120)
    for i in range(N):
        tilt = fixed.normal(size=3)
        mount = any_rotation(fixed) if sensors.mounting else np.eye(3)
        mount *= np.sign(np.linalg.det(mount))
        mount = mount @ rotation(tilt / np.linalg.norm(tilt), fixed.normal(scale=sensors.mounting or 1e-12))
        axes[i] = mount.T @ [0, 1, 0]
        true_rate = spin[:, i, None] * axes[i] * (1 + fixed.normal(scale=sensors.rate_scale))
        noise = rng.normal(scale=sensors.rate_noise * grow, size=true_rate.shape)
        rates[:, i] = true_rate + fixed.normal(scale=sensors.bias, size=3) + noise
        shaken = rng.normal(scale=sensors.force_noise * grow, size=true_rate.shape)
        forces[:, i] = force[:, i] @ mount + fixed.normal(scale=sensors.force_bias, size=3) + shaken
    clipped = np.any(np.abs(rates) >= sensors.rate_limit, axis=2)
    rates = np.clip(rates, -sensors.rate_limit, sensors.rate_limit)
    return ImuRecording(motion.times[ends], rates, forces, clipped, np.ones_like(clipped)), axes


def _specific_force(times: Array, alpha: Array, speed: Array) -> Array:
    """Acceleration less gravity of every sensor in its link's axes, (n_times, n, 3) [m/s2]."""
    growth = np.gradient(speed, times, axis=0)
    along = np.stack([np.sin(alpha), np.zeros_like(alpha), np.cos(alpha)], axis=2)
    across = np.stack([np.cos(alpha), np.zeros_like(alpha), -np.sin(alpha)], axis=2)
    pull = growth[:, :, None] * across - speed[:, :, None] ** 2 * along  # second derivative of `along`
    before = np.cumsum(pull, axis=1) - pull
    world = SPACING * before + BEYOND * pull - np.array([0, 0, GRAVITY])
    return np.stack([np.sum(world * across, axis=2), world[:, :, 1], np.sum(world * along, axis=2)], axis=2)


def with_losses(recording: ImuRecording, lost: Array) -> ImuRecording:
    """The same without some samples, (n_times,) bool, or some sensors' readings, (n_times, n)."""
    if lost.ndim == 1:
        keep = ~lost
        return ImuRecording(
            recording.times[keep], recording.rates[keep], recording.forces[keep], recording.clipped[keep],
            recording.valid[keep],
        )  # fmt: skip
    return replace(recording, valid=recording.valid & ~lost)


TAGS = tuple(f"link {i + 1}" for i in range(N))


def write_exports(folder: Path, recording: ImuRecording, first_tick: int = 1_000_000) -> list[Path]:
    """Files as the vendor's app exports them, one for each sensor; readings that are not valid are not in them."""
    paths = []
    folder.mkdir(exist_ok=True)
    for i, tag in enumerate(TAGS[: recording.n_sensors]):
        head = ["sep=,", f"DeviceTag:,{tag}", "FirmwareVersion:,2.0.0", "AppVersion:,2021.0", "© X 2005-2021", ""]
        lines = ["PacketCounter,SampleTimeFine,Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z,Status"]
        ticks = np.round((recording.times - recording.times[0]) * 1e6).astype(int) + first_tick
        for k in np.flatnonzero(recording.valid[:, i]):
            numbers = [*recording.forces[k, i], *np.degrees(recording.rates[k, i])]
            status = 0x0008 if recording.clipped[k, i] else 0x0200
            lines.append(",".join([str(k), str(ticks[k] % 2**32), *(f"{x:.14f}" for x in numbers), str(status)]))
        paths.append(folder / f"{tag.replace(' ', '_')}.csv")
        paths[-1].write_text("\n".join([*head, *lines]) + "\n", encoding="utf-8")
    return paths


def calibrated(recording: ImuRecording) -> Calibration:
    """As a person would: bias and zero from the rest at the start, axes from the pull towards cable 1."""
    rest = recording.part(0.2, REST - 0.5)
    found = CalibrationSteps().with_bias(rest).with_axis(recording).with_zero(rest).complete()
    assert found is not None
    return found


def estimated(
    recording: ImuRecording, calibration: Calibration, settings: EstimatorSettings | None = None
) -> list[AngleEstimate]:
    """What the estimator says, sample by sample."""
    estimator = AngleEstimator(calibration, settings)
    return [estimator.update(sample) for sample in recording.samples()]


def errors(estimates: list[AngleEstimate], motion: Motion) -> Array:
    """Estimated less true joint angles, NaN where none is given, (n_times, n) [degrees]."""
    theta, _ = motion.at(np.array([estimate.time for estimate in estimates]))
    return np.degrees(np.array([estimate.angles for estimate in estimates]) - theta)


def rms(values: Array) -> Array:
    """Of each column, over what is not NaN."""
    return np.sqrt(np.nanmean(values**2, axis=0))

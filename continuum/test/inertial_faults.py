"""What may happen to a recording of sensors on its way."""

from dataclasses import replace

import numpy as np
from inertial_arm import DEG, RELEASE, N, with_losses

from continuum.inertial.imu_recording import ImuRecording


def losses(kind: str, recording: ImuRecording, rng: np.random.Generator) -> ImuRecording:
    """A recording with some trouble in it, but for its end."""
    times = recording.times
    whole = times > times[-1] - 3
    if kind == "single frames":
        return with_losses(recording, ~whole & (rng.random(times.size) < 0.03))
    if kind == "bursts":
        middles, halves = rng.uniform(RELEASE - 4, RELEASE + 2, 8), rng.uniform(0.01, 0.2, 8)
        return with_losses(recording, np.any(np.abs(times[:, None] - middles) < halves, axis=1))
    if kind == "release unseen":
        begin = RELEASE + rng.uniform(-0.12, 0.12)
        return with_losses(recording, (times > begin) & (times < begin + rng.uniform(0.02, 0.15)))
    if kind == "one sensor at times":
        lost = np.zeros((times.size, N), dtype=bool)
        lost[:, rng.integers(N)] = ~whole & (rng.random(times.size) < 0.05)
        return with_losses(recording, lost)
    if kind == "one sensor for long":
        lost = np.zeros((times.size, N), dtype=bool)
        begin = rng.uniform(RELEASE - 2, RELEASE + 1)
        lost[(times > begin) & (times < begin + rng.uniform(0.3, 2)), rng.integers(N)] = True
        return with_losses(recording, lost)
    limit = rng.uniform(100, 400) * DEG
    clipped = np.any(np.abs(recording.rates) > limit, axis=2)
    return replace(recording, rates=np.clip(recording.rates, -limit, limit), clipped=clipped)


KINDS = ("single frames", "bursts", "release unseen", "one sensor at times", "one sensor for long", "clips")

"""The release of repetition 7: our solution of Eq. 12 beside the author's, and both beside the measurement."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from continuum.arrays import Array
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.trajectory import SimulationStatus, Trajectory
from continuum.identification.nrmse import measured_rates, nrmse
from continuum.recordings.recording import Recording
from continuum.recordings.recording_csv import read_recording_csv

DATA = Path(__file__).resolve().parents[3] / "data" / "rep7"
TABLE_4_POSITION, TABLE_4_VELOCITY = 0.58105, 0.63264  # the thesis's NRMSE of repetition 7


@dataclass(frozen=True)
class Release:
    """What became of the release.

    Attributes:
        measured, published: the prototype, and the author's simulation.
        from_rest: ours from the author's first row, at rest.
        thrown: ours with the initial joint rates that bring it closest to the author's.
    """

    measured: Recording
    published: Recording
    from_rest: Trajectory
    thrown: Trajectory

    def distance(self, ours: Trajectory) -> Array:
        """Root mean square distance to the author's simulation, of each joint, (5,) [deg]."""
        return np.asarray(np.degrees(np.sqrt(np.mean((ours.theta - self.published.theta) ** 2, axis=0))))

    def velocity_nrmse(self, theta: Array) -> float:
        """Eq. 19 against the measurement; rates of both are derivatives of their angles, (n_times, 5) [rad]."""
        simulated = Recording(self.measured.name, self.measured.times, theta)
        return nrmse(measured_rates(simulated), measured_rates(self.measured))

    def position_nrmse(self, theta: Array) -> float:
        """The same of positions, which may not be how Table 4 normalised them."""
        return nrmse(theta, self.measured.theta)


def over_all(distance: Array) -> float:
    """Root mean square over the joints too [deg]."""
    return float(np.sqrt(np.mean(distance**2)))


def prototype(**changed: float) -> Model:
    """Tables 1 and 3, and what neither prints, or other values."""
    return load_model("lamecc_prototype.yaml").with_values(changed)


def reproduce_release(model: Model) -> Release:
    """Simulate from the author's first row, at rest, and with the initial rates free."""
    measured, published = (read_recording_csv(DATA / f"rep7_{name}.csv") for name in ("measured", "simulated"))
    simulator = Simulator(model)
    start, times = published.theta[0], published.times
    n, n_p = start.size, simulator.equations.values.size
    by_rates = np.eye(2 * n, n, k=-n)  # the initial state by the initial rates

    def thrown(rates: Array) -> Trajectory:
        found = simulator.run(np.concatenate([start, rates]), times, free=np.zeros((n_p, n)), free_initial=by_rates)
        if found.status is not SimulationStatus.COMPLETE:
            raise RuntimeError(f"a simulation of the release failed: {found.status.value}")
        return found

    fitted = least_squares(
        lambda rates: (thrown(rates).theta - published.theta).ravel(),
        np.zeros(n),
        lambda rates: thrown(rates).sensitivities[:, :n].reshape(-1, n),
        method="lm",
    )
    return Release(measured, published, thrown(np.zeros(n)), thrown(fitted.x))

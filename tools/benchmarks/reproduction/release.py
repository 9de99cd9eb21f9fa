"""The release of repetition 7: our solution of Eq. 12 compared with the author's, and both with the measurement."""

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
    """Motions of the release.

    Attributes:
        measured, published: measurement of the prototype, and the author's simulation.
        from_rest: our simulation from the author's first row, at rest.
        thrown: our simulation with the initial joint rates that minimise the distance to the author's.
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
        """The same for positions, which Table 4 may have normalised differently."""
        return nrmse(theta, self.measured.theta)


def over_all(distance: Array) -> float:
    """Return the root mean square over all joints [deg]."""
    return float(np.sqrt(np.mean(distance**2)))


def prototype(**changed: float) -> Model:
    """Return the model of Tables 1 and 3 with the unprinted values, or with changed values."""
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

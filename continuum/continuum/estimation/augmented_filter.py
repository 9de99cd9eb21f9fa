"""One Kalman pass over a run with all columns at once (de Jong, Annals of Statistics 19, 1991), and the smoother.

The readings are linear in the parameters' deviations theta: every column of torque or reading passes through the same
filter as the data. Whitened innovations Z of the columns and z of the data then give

    -2 log p(y | theta) = z'z - 2 theta' Z'z + theta' Z'Z theta + log |S|     (up to a constant)

for any theta, so that one pass serves every hypothesis.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.estimation.compiled_loops import compiled, entry_point
from continuum.estimation.run import Run, Trajectory
from continuum.estimation.sensor_noise import NoiseModel
from continuum.estimation.transition import Transition


@dataclass(frozen=True)
class Measurement:
    """Readings of a trajectory.

    Attributes:
        expected: readings of the trajectory, (n_times, n_readings).
        H: their derivative with respect to angles and rates, (n_readings, 2 n).
    """

    expected: Array
    H: Array


@dataclass(frozen=True)
class RunLikelihood:
    """Minus twice the log-likelihood of a run: energy - 2 theta' e + theta' L theta + log_det.

    Attributes:
        L: information matrix, (P, P).
        e: information vector, (P,).
        energy: sum of squared whitened innovations of the data, z'z.
        log_det: log determinant of the innovations' covariances.
    """

    L: Array
    e: Array
    energy: float
    log_det: float


def run_likelihood(
    run: Run, way: Trajectory, step: Transition, seen: Measurement, columns: tuple[Array, Array], noise: NoiseModel
) -> RunLikelihood:
    """Return the run's likelihood as a function of all columns' coefficients.

    Args:
        run, way, step, seen: rows, trajectory, and motion and readings linearised along it.
        columns: states per unit, (n_times - 1, 2 n, P), and readings per unit, (n_times, n_readings, P).
        noise: noise of sensors and torque.
    """
    of_states, of_readings = columns
    P = of_states.shape[2]
    L, e = np.zeros((P, P)), np.zeros(P)
    energy, log_det = _filter(*_given(run, way, step, seen, noise), of_states, of_readings, L, e)
    return RunLikelihood(L, e, energy, log_det)


def smoothed(
    run: Run, way: Trajectory, step: Transition, seen: Measurement, added: tuple[Array, Array], noise: NoiseModel
) -> tuple[Array, Array, Array]:
    """Return smoothed deviations, (n_times, 4 n), their variances, and whitened innovations, (n_times, n_readings).

    Args:
        run, way, step, seen: as for `run_likelihood`.
        added: sum of the columns at given coefficients: (n_times - 1, 2 n) and (n_times, n_readings).
        noise: noise of sensors and torque.
    """
    torque, reading = (np.ascontiguousarray(part) for part in added)
    found: tuple[Array, Array, Array] = _smooth(*_given(run, way, step, seen, noise), torque, reading)
    return found


def _given(run: Run, way: Trajectory, step: Transition, seen: Measurement, noise: NoiseModel):  # type: ignore[no-untyped-def]
    h, n = run.intervals, run.n
    start = np.concatenate([np.full(n, noise.start_angle), np.full(n, noise.start_rate), noise.slow, noise.sigma])
    keep_b, keep_d = np.exp(-h / noise.slow_time), np.exp(-h / noise.torque_time)
    return (
        run.readings - seen.expected, run.live, way.q, way.w, way.d, step.end, step.F, step.D, step.noise, seen.H,
        noise.white, start, keep_b, keep_d,
    )  # fmt: skip


@compiled
def _update(P, H, white, live, L, G):  # type: ignore[no-untyped-def]
    """Compute the innovation's Cholesky factor L and the gain times it, G = P H' L^-T; angle readings include b."""
    n, size = H.shape[1] // 2, H.shape[0]
    PH = np.ascontiguousarray(P[:, : 2 * n]) @ H.T
    for j in range(min(size, n)):
        PH[:, j] += P[:, 2 * n + j]
    for i in range(size):
        for j in range(i + 1):
            s = 0.0
            for m in range(2 * n):
                s += H[i, m] * PH[m, j]
            if i < n:
                s += PH[2 * n + i, j]
            if live[i] > 0.0 and live[j] > 0.0:
                s += white[i, j]
            L[i, j] = s
        if live[i] == 0.0:
            L[i, i] += 1e6
    for j in range(size):
        s = L[j, j]
        for k in range(j):
            s -= L[j, k] * L[j, k]
        L[j, j] = np.sqrt(s)
        for i in range(j + 1, size):
            t = L[i, j]
            for k in range(j):
                t -= L[i, k] * L[j, k]
            L[i, j] = t / L[j, j]
    for i in range(P.shape[0]):
        for j in range(size):
            t = PH[i, j]
            for k in range(j):
                t -= G[i, k] * L[j, k]
            G[i, j] = t / L[j, j]


@compiled
def _predict(P, Ft, noise, start, keep_b, keep_d):  # type: ignore[no-untyped-def]
    n = start.size // 4
    P = Ft @ P @ Ft.T
    P[: 2 * n, : 2 * n] += noise
    for i in range(n):
        b, d = 2 * n + i, 3 * n + i
        P[b, b] += start[b] ** 2 * (1 - keep_b * keep_b)
        P[d, d] += start[d] ** 2 * (1 - keep_d * keep_d)
    return 0.5 * (P + P.T)


@compiled
def _transition(F, D, keep_b, keep_d):  # type: ignore[no-untyped-def]
    n = D.shape[1]
    Ft = np.zeros((4 * n, 4 * n))
    Ft[: 2 * n, : 2 * n] = F
    Ft[: 2 * n, 3 * n :] = D
    for i in range(n):
        Ft[2 * n + i, 2 * n + i] = keep_b
        Ft[3 * n + i, 3 * n + i] = keep_d
    return Ft


@compiled
def _defect(k, q, w, d, end, D):  # type: ignore[no-untyped-def]
    """Return the end of the model's interval minus the trajectory's next row, for d = 0, (2 n,)."""
    n = q.shape[1]
    out = end[k].copy()
    for i in range(2 * n):
        for j in range(n):
            out[i] -= D[k, i, j] * d[k, j]
        out[i] -= q[k + 1, i] if i < n else w[k + 1, i - n]
    return out


@entry_point
def _filter(y, live, q, w, d, end, F, D, noise, H, white, start, keep_b, keep_d, B, C, L_out, e_out):  # type: ignore[no-untyped-def]
    rows, size = y.shape
    n, n4, P = q.shape[1], 4 * q.shape[1], B.shape[2]
    cov = np.diag(start * start)
    V = np.zeros((n4, P + 1))  # the columns' states, and in the last column the data's
    log_det = 0.0
    L, G, Z = np.zeros((size, size)), np.empty((n4, size)), np.empty((size, P + 1))
    whitened = np.empty((rows * size, P + 1))
    for k in range(rows):
        _update(cov, H, white, live[k], L, G)
        Z[:, :] = H @ np.ascontiguousarray(V[: 2 * n])
        for i in range(size):
            if i < n:
                Z[i] += V[2 * n + i]
            Z[i, :P] += C[k, i]
            Z[i, P] = y[k, i] - Z[i, P]
            if live[k, i] == 0.0:
                Z[i, P] = 0.0
            for j in range(i):
                Z[i] -= L[i, j] * Z[j]
            Z[i] /= L[i, i]
            log_det += 2 * np.log(L[i, i])
        whitened[k * size : (k + 1) * size] = Z
        cov = cov - G @ G.T
        Z[:, :P] = -Z[:, :P]  # a column adds to the readings, so the gain acts on its state with a minus sign
        V = V + G @ Z
        if k == rows - 1:
            break
        V[: 2 * n] = F[k] @ V[: 2 * n] + D[k] @ V[3 * n :]
        V[2 * n : 3 * n] *= keep_b[k]
        V[3 * n :] *= keep_d[k]
        V[: 2 * n, :P] += B[k]
        V[: 2 * n, P] += _defect(k, q, w, d, end, D)
        cov = _predict(cov, _transition(F[k], D[k], keep_b[k], keep_d[k]), noise[k], start, keep_b[k], keep_d[k])
    Zp, z = np.ascontiguousarray(whitened[:, :P]), np.ascontiguousarray(whitened[:, P])
    L_out += Zp.T @ Zp
    e_out += Zp.T @ z
    return z @ z, log_det


@entry_point
def _smooth(y, live, q, w, d, end, F, D, noise, H, white, start, keep_b, keep_d, Bt, Ct):  # type: ignore[no-untyped-def]
    """Filter, then smooth by Bryson and Frazier's method, which inverts no covariance of states."""
    rows, size = y.shape
    n, n4 = q.shape[1], 4 * q.shape[1]
    cov, m = np.diag(start * start), np.zeros(n4)
    covs, ms = np.empty((rows, n4, n4)), np.empty((rows, n4))
    Gs, Ls = np.empty((rows, n4, size)), np.zeros((rows, size, size))
    steps, zs = np.zeros((rows, n4, n4)), np.empty((rows, size))
    for k in range(rows):
        covs[k], ms[k] = cov, m
        _update(cov, H, white, live[k], Ls[k], Gs[k])
        read = H @ m[: 2 * n]
        for i in range(size):
            t = y[k, i] - Ct[k, i] - read[i]
            if i < n:
                t -= m[2 * n + i]
            if live[k, i] == 0.0:
                t = 0.0
            for j in range(i):
                t -= Ls[k, i, j] * zs[k, j]
            zs[k, i] = t / Ls[k, i, i]
        m = m + Gs[k] @ zs[k]
        cov = cov - Gs[k] @ Gs[k].T
        if k == rows - 1:
            break
        Ft = _transition(F[k], D[k], keep_b[k], keep_d[k])
        steps[k] = Ft
        m = Ft @ m
        m[: 2 * n] += Bt[k] + _defect(k, q, w, d, end, D)
        cov = _predict(cov, Ft, noise[k], start, keep_b[k], keep_d[k])
    states, variances = np.empty((rows, n4)), np.empty((rows, n4))
    r, N = np.zeros(n4), np.zeros((n4, n4))
    whole = np.zeros((size, n4))
    whole[:, : 2 * n] = H
    for j in range(min(n, size)):
        whole[j, 2 * n + j] = 1.0
    for k in range(rows - 1, -1, -1):
        if k < rows - 1:
            r = steps[k].T @ r
            N = steps[k].T @ N @ steps[k]
        HL = np.linalg.solve(Ls[k], whole).T  # H' L^-T
        keep = np.eye(n4) - HL @ Gs[k].T
        r = keep @ r + HL @ zs[k]
        N = keep @ N @ keep.T + HL @ HL.T
        states[k] = ms[k] + covs[k] @ r
        moved = covs[k] @ N
        for i in range(n4):
            variances[k, i] = covs[k, i, i] - moved[i] @ covs[k, i]
    return states, variances, zs

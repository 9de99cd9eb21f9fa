"""From one row to the next: Eq. 12 integrated and linearised over each interval, with given friction modes.

Exponential Rosenbrock-Euler substeps (Hochbruck and Ostermann, Acta Numerica 19, 2010) are exact for linear equations,
however stiff. A joint with unknown friction has the acceleration that its smoothed rates give. Missing torque acts
through the inertia of the reference model: its size must not depend on the parameters that are estimated.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.compiled.machine_code import address_of
from continuum.dynamics.integration.compiled_loops import call_at
from continuum.estimation.compiled_loops import compiled, entry_point
from continuum.estimation.friction_modes import FrictionModes, slip_rates
from continuum.estimation.motion_equations import MotionEquations
from continuum.estimation.run import Run, Trajectory


@dataclass(frozen=True)
class Transition:
    """x_(k+1) = end_k + F_k (x_k - way_k) + D_k (d_k - d of way_k) + sum of W_r tau_r over substeps r + noise.

    Attributes:
        end: end of the interval by the model, (n_times - 1, 2 n) [rad, rad/s].
        F: derivative with respect to the state, (n_times - 1, 2 n, 2 n).
        D: derivative with respect to missing torque, (n_times - 1, 2 n, n).
        W: derivative with respect to torque in each substep, (rows, 2 n, n).
        noise: covariance of the process noise, (n_times - 1, 2 n, 2 n).
        slip: rates for dry friction, (rows, n) [rad/s].
        acceleration: acceleration without missing torque in the middle of each substep, (rows, n) [rad/s2].
    """

    end: Array
    F: Array
    D: Array
    W: Array
    noise: Array
    slip: Array
    acceleration: Array


def transition(
    equations: MotionEquations,
    run: Run,
    way: Trajectory,
    modes: FrictionModes,
    values: Array,
    reference: Array,
    held: Array,
) -> Transition:
    """Linearise a run along a trajectory.

    Args:
        equations: equations of the model without states.
        run, way, modes: rows, trajectory, friction modes.
        values: parameter values, (n_p,).
        reference: values of the reference model, (n_p,).
        held: given torque of effects, (rows, n) [N m].
    """
    n, m, rows = run.n, len(run.intervals), int(run.first[-1])
    slip = slip_rates(run, way, modes)
    q, w = run.between(way)
    out = Transition(
        np.empty((m, 2 * n)), np.empty((m, 2 * n, 2 * n)), np.empty((m, 2 * n, n)), np.empty((rows, 2 * n, n)),
        np.empty((m, 2 * n, 2 * n)), slip, np.empty((rows, n)),
    )  # fmt: skip
    _linearise(
        address_of(equations.linear), address_of(equations.inertia), way.q, way.w, way.d, q, w,
        modes.sign, modes.rate_noise, modes.torque_noise, modes.acceleration, run.first, run.length, run.inputs, slip,
        np.ascontiguousarray(values), np.ascontiguousarray(reference), np.ascontiguousarray(held),
        out.end, out.F, out.D, out.W, out.noise, out.acceleration,
    )  # fmt: skip
    return out


@entry_point
def _linearise(  # type: ignore[no-untyped-def]
    linear, inertia, q, w, d, q_mid, w_mid, sign, rate_noise, torque_noise, prescribed_all, first, length, inputs, slip,
    values, reference, held, end, F, D, W, noise, acceleration,
):  # fmt: skip
    n, n_u, n2 = q.shape[1], inputs.shape[1], 2 * q.shape[1]
    given, at_reference = np.empty(3 * n + n_u + n + values.size), np.empty(3 * n + n_u + n + values.size)
    given[4 * n + n_u :] = values
    at_reference[4 * n + n_u :] = reference
    out, out_inertia = np.empty(n + n * n + n * n2), np.empty(n + n * n)
    M, rhs, sensitivities = np.empty((n, n)), np.empty((n, 1)), np.empty((n, n2 + n + n))
    A, E, S = np.zeros((n2, n2)), np.empty((n2, n2)), np.empty((n2, n2))
    for i in range(n):
        A[i, n + i] = 1.0
    state, acc, known = np.empty(n2), np.zeros(n), np.empty(n)
    for k in range(sign.shape[0]):
        h = length[first[k]] * (first[k + 1] - first[k])
        for i in range(n):
            state[i], state[n + i] = q[k, i], w[k, i]
            acc[i] = (w[k + 1, i] - w[k, i]) / h if sign[k, i] != 0.0 else prescribed_all[k, i]
        prescribed = acc.copy()
        total, by_torque, by_rate = np.eye(n2), np.zeros((n2, n)), np.zeros((n2, n))
        for r in range(first[k], first[k + 1]):
            # acceleration in the middle of the substep, for the columns; a joint at rest has none
            for i in range(n):
                known[i] = prescribed[i]
                acceleration[r, i] = known[i]
                given[i], given[n + i], given[2 * n + i] = q_mid[r, i], w_mid[r, i], known[i]
                given[3 * n + n_u + i] = slip[r, i]
            for i in range(n_u):
                given[3 * n + i] = inputs[r, i]
            call_at(inertia, given, out_inertia)
            for i in range(n):
                rhs[i, 0] = held[r, i] - out_inertia[i]
                for j in range(n):
                    M[i, j] = out_inertia[n + n * j + i]
            for i in range(n):
                if sign[k, i] == 0.0:
                    rhs[i, 0] = 0.0
            _constrain(M, sign[k])
            _solve(M, rhs)
            for i in range(n):
                acceleration[r, i] += rhs[i, 0]
            # the substep itself, from the end of the one before
            for i in range(n):
                given[i], given[n + i], given[2 * n + i] = state[i], state[n + i], acc[i]
                at_reference[i], at_reference[n + i], at_reference[2 * n + i] = state[i], state[n + i], 0.0
                at_reference[3 * n + n_u + i] = slip[r, i]
            for i in range(n_u):
                at_reference[3 * n + i] = inputs[r, i]
            call_at(linear, given, out)
            for i in range(n):
                for j in range(n):
                    M[i, j] = out[n + n * j + i]
            sensitivities[:] = 0.0
            for i in range(n):
                rhs[i, 0] = 0.0
                if sign[k, i] != 0.0:
                    rhs[i, 0] = held[r, i] - out[i]
                    for j in range(n2):
                        sensitivities[i, j] = -out[n + n * n + n * j + i]
                    sensitivities[i, n2 + i] = 1.0
                    for j in range(n):
                        if sign[k, j] == 0.0:
                            sensitivities[i, n2 + n + j] = -M[i, j]
                            rhs[i, 0] -= M[i, j] * (prescribed[j] - acc[j])
                else:
                    rhs[i, 0] = prescribed[i] - acc[i]
                    sensitivities[i, n2 + n + i] = 1.0
            _constrain(M, sign[k])
            both = np.concatenate((rhs, sensitivities), axis=1)
            _solve(M, both)
            call_at(inertia, at_reference, out_inertia)
            for i in range(n):
                for j in range(n):
                    M[i, j] = out_inertia[n + n * j + i]
            by_d = np.zeros((n, n))
            for i in range(n):
                if sign[k, i] != 0.0:
                    by_d[i, i] = 1.0
            _constrain(M, sign[k])
            _solve(M, by_d)
            for i in range(n):
                acc[i] += both[i, 0]
                for j in range(n2):
                    A[n + i, j] = both[i, 1 + j]
            _exponential(A, length[r], E, S)
            moved = np.zeros(n2)
            for i in range(n):
                a = acc[i]
                for j in range(n):
                    a += by_d[i, j] * d[k, j]
                moved[n + i] = a
                moved[i] = state[n + i]
            state = state + S @ moved
            rates = np.ascontiguousarray(S[:, n:])
            total = E @ total
            by_torque = E @ by_torque + rates @ by_d
            by_rate = E @ by_rate + rates @ np.ascontiguousarray(both[:, 1 + n2 + n :])
            for earlier in range(first[k], r):
                W[earlier] = E @ W[earlier]
            W[r] = rates @ np.ascontiguousarray(both[:, 1 + n2 : 1 + n2 + n])
        end[k], F[k], D[k] = state, total, by_torque
        for i in range(n2):
            for j in range(n2):
                s = 0.0
                for m in range(n):
                    s += by_torque[i, m] * by_torque[j, m] * torque_noise[k, m] ** 2 / h
                    s += by_rate[i, m] * by_rate[j, m] * (rate_noise[k, m] / h) ** 2
                noise[k, i, j] = s
        for i in range(n):
            noise[k, i, i] += (rate_noise[k, i] * h) ** 2 / 12


@compiled
def _constrain(M, sign):  # type: ignore[no-untyped-def]
    """Replace rows and columns of joints with given acceleration by those of the identity."""
    for i in range(sign.size):
        if sign[i] == 0.0:
            for j in range(sign.size):
                M[i, j] = 0.0
                M[j, i] = 0.0
            M[i, i] = 1.0


@compiled
def _solve(M, R):  # type: ignore[no-untyped-def]
    """Solve M X = R in place, M symmetric and positive definite; its Cholesky factor replaces M."""
    n = M.shape[0]
    for j in range(n):
        s = M[j, j]
        for k in range(j):
            s -= M[j, k] * M[j, k]
        s = np.sqrt(s)
        M[j, j] = s
        for i in range(j + 1, n):
            t = M[i, j]
            for k in range(j):
                t -= M[i, k] * M[j, k]
            M[i, j] = t / s
    for c in range(R.shape[1]):
        for i in range(n):
            t = R[i, c]
            for k in range(i):
                t -= M[i, k] * R[k, c]
            R[i, c] = t / M[i, i]
        for i in range(n - 1, -1, -1):
            t = R[i, c]
            for k in range(i + 1, n):
                t -= M[k, i] * R[k, c]
            R[i, c] = t / M[i, i]


@compiled
def _exponential(A, h, E, S):  # type: ignore[no-untyped-def]
    """Compute E = exp(h A), S = integral of exp(t A) from 0 to h: Taylor series of a scaled matrix, then doubling."""
    n = A.shape[0] // 2
    norm = 0.0
    for i in range(n, 2 * n):
        by_angle, by_rate = 0.0, 0.0
        for j in range(n):
            by_angle += abs(A[i, j])
            by_rate += abs(A[i, n + j])
        norm = max(norm, max(np.sqrt(by_angle), by_rate))
    doublings, part = 0, h
    while norm * part > 0.7 and doublings < 12:
        part *= 0.5
        doublings += 1
    B, unit = A * part, np.eye(2 * n)
    series = unit + B * (1.0 / 7.0)
    for k in range(6, 1, -1):
        series = unit + (B @ series) * (1.0 / k)
    e, s = unit + B @ series, series * part
    for _ in range(doublings):
        s = s + e @ s
        e = e @ e
    E[:] = e
    S[:] = s

"""Log-evidence of a few coefficients with Gaussian priors and lower bounds, compiled: a search needs thousands."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from continuum.compiled_code import entry_point
from continuum.estimation.compiled_loops import compiled


@compiled
def _log_normal(z: float) -> float:
    """Return the log of the standard normal distribution function."""
    if z < -8.0:
        return -0.5 * z * z - math.log(-z * math.sqrt(2 * math.pi))
    return math.log(0.5 * math.erfc(-z / math.sqrt(2.0)))


@entry_point(Path(__file__), error_model="python")
def evidences(L, e, c, G, g, index, sd, least, found, worst):  # type: ignore[no-untyped-def]
    """Compute the log-evidence of the coefficients ``index`` at every level, with bounds applied to their marginals.

    The results are written to ``found``, and to ``worst`` the least of the constraints g + G a >= 0 at the optimum.
    """
    n = index.size
    A, z, x = np.empty((n, n)), np.empty(n), np.empty(n)
    for level in range(c.size):
        value, good = c[level], True
        for i in range(n):
            for j in range(i + 1):
                A[i, j] = L[level, index[i], index[j]]
            A[i, i] += 1.0 / (sd[i] * sd[i])
        for j in range(n):
            t = A[j, j]
            for k in range(j):
                t -= A[j, k] * A[j, k]
            if not t > 0.0:
                good = False
                break
            A[j, j] = math.sqrt(t)
            value -= math.log(A[j, j] * sd[j])
            for i in range(j + 1, n):
                t = A[i, j]
                for k in range(j):
                    t -= A[i, k] * A[j, k]
                A[i, j] = t / A[j, j]
        if not good:
            found[level], worst[level] = -np.inf, 0.0
            continue
        for i in range(n):
            t = e[level, index[i]]
            for k in range(i):
                t -= A[i, k] * z[k]
            z[i] = t / A[i, i]
            value += 0.5 * z[i] * z[i]
        for i in range(n - 1, -1, -1):
            t = z[i]
            for k in range(i + 1, n):
                t -= A[k, i] * z[k]
            z[i] = t / A[i, i]
        for p in range(n):
            if least[p] > -1e300:
                variance = 0.0
                for i in range(p, n):
                    t = 1.0 if i == p else 0.0
                    for k in range(p, i):
                        t -= A[i, k] * x[k]
                    x[i] = t / A[i, i]
                    variance += x[i] * x[i]
                value += _log_normal((z[p] - least[p]) / math.sqrt(variance)) - _log_normal(-least[p] / sd[p])
        found[level] = value
        low = np.inf
        for m in range(G.shape[1]):
            t = g[level, m]
            for i in range(n):
                t += G[level, m, index[i]] * z[i]
            low = min(low, t)
        worst[level] = low

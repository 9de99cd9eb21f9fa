"""Integration over time: SciPy's BDF as the reference, and a fast compiled implicit Runge-Kutta method."""

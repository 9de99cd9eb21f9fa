"""Integration over time: SciPy's BDF as the reference, a compiled implicit Runge-Kutta method as the fast way."""

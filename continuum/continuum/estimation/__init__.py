"""The grey-box state-space model of one recording: physics from Eq. 12 and its effects, the rest as stochastic torque.

State x = (theta, theta', b, d) of n joints: angles [rad], rates [rad/s], slow sensor error [rad], missing torque [N m].

    M(theta) theta'' = tau(theta, theta', u; p) + d,    d' = -d / T_d + noise,
    b' = -b / T_b + noise,                              y = h(theta) + b + e

Friction is not integrated: the smoothed trajectory shows whether each joint slips, sticks, or reverses
(`friction_modes`). The model is linearised along that trajectory (`transition`), its derivatives with respect to all
parameters (`columns`) pass through one augmented Kalman filter (`augmented_filter`), and the result for each run is a
quadratic function of all parameters: the log-likelihood of every hypothesis.
"""

"""Identification: parameters of the dynamic model from recordings, with intervals that hold.

======================  ============================================================================
dataset.py              several runs, split by whole runs into identification and validation
noise.py                how much the sensors err, from the data themselves
free.py                 which parameters a fit may move, shared, per joint or per recording
baseline.py             those that every fit moves: Eq. 12's, and each joint's within its batch
tension_rows.py         how tensions go on between rows; sensors.py: what sensors make of a motion
window_residual.py      one run simulated window by window, less what was measured, in units of the noise
window_settling.py      the first state of each window, the parameters held
arrow_least_squares.py  Levenberg-Marquardt for shared unknowns and unknowns of each run
likeliest.py            of unknowns that mean the same arm those that are likeliest
fit.py                  all of it together; free_run.py: one run simulated from its first instant
several_starts.py       the same from starts over all of the prior
nrmse.py, swarm.py      the thesis's objective (Eq. 19) and its particle swarm (Table 2)
nrmse_interval.py       how well the objective is known of one run
fisher.py               what the data can tell; bootstrap.py: intervals
======================  ============================================================================
"""

"""Identification: parameters of the dynamic model from recordings, with intervals that hold.

======================  ============================================================================
recording.py            what was measured in one run; `recording_csv.py`, `recording_bag.py` read it
dataset.py              several runs, split by whole runs into identification and validation
noise.py                how much the sensors err, from the data themselves
free.py                 which parameters a fit may move, shared, per joint or per recording
window_residual.py      one run simulated window by window, less what was measured, in units of the noise
arrow_least_squares.py  Levenberg-Marquardt for shared unknowns and unknowns of each run
fit.py                  all of it together
nrmse.py, swarm.py      the thesis's objective (Eq. 19) and its particle swarm (Table 2)
fisher.py               what the data can tell; bootstrap.py: intervals
======================  ============================================================================
"""

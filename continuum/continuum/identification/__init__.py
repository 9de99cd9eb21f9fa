"""Identification of an arm's springs and friction, and prediction by the identified model (thesis 3.3 and 4.2).

====================  ============================================================================
free.py               which parameters may change, as coordinates about a model's values
swarm.py              the thesis's particle swarm (Table 2), which lowers Eq. 19
thesis_swarm.py       its five parameters by that swarm
nrmse.py              Eq. 19
scores.py             Eq. 19 of every run, simulated open loop (Table 4, Fig. 9)
estimate.py           one value with its interval
identified.py         the identified model (Table 3)
local_derivatives.py  derivatives of measured signals
====================  ============================================================================

The fit by maximum likelihood needs the grey-box model and is in `continuum.discovery.parameter_fit`.

Public: `identified.Identified`, `estimate.Estimate`, `scores.scores`, `nrmse.nrmse`, `thesis_swarm.swarm_parameters`.
"""

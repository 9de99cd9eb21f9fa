"""Kinematics of sections and arms under the thesis's hypothesis of constant curvature (chapters 2.2, 3.1, appendix B).

Where each equation of the thesis stands:

====================  ==================================================================
Eqs. 1, 2, 3          configuration/eq01_allen_and_jones.py
Eqs. 6, 7             configuration/eq06_arc.py
Eqs. 23, 24           configuration/eq23_allen_rates.py, configuration/eq24_arc_rates.py
Eq. 4, 5              section/eq04_pose.py, section/eq05_configuration_from_point.py
Eqs. 20, 21, 22       section/eq21_jacobian.py, section/eq22_rates_from_point.py
Eqs. 8, 9, 25, 26     cables/eq08_lengths.py, cables/eq09_..., cables/eq26_rates.py
Eqs. 10, 11           chain/eq10_pose.py, chain/eq11_jacobian.py
Eq. 11, J_xq          cable_twist.py (rates of the cables to the twist of the tip)
chapter 2.2.3         routing.py (tangle, untangle), fabrikc.py (inverse kinematics)
====================  ==================================================================

cable_estimate.py estimates configurations from measured lengths; joint_chain.py and discs.py take single joints.

The maps take arrays with any leading axes, so a whole trajectory is one call.
"""

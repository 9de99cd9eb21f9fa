"""Kinematics of sections and arms under the thesis's hypothesis of constant curvature (chapters 2.2, 3.1, appendix B).

The table gives the module that implements each equation of the thesis; each module lists the functions:

=============================  =========================================================
Eqs. 1, 2, 3, 6, 7, 23, 24     configuration.py
Eqs. 4, 5, 20, 21, 22          section.py
Eqs. 8, 9, 25, 26              cables.py
Eqs. 10, 11                    chain.py
Eq. 11, J_xq                   cable_twist.py (rates of the cables to the twist of the tip)
chapter 2.2.3                  routing.py (tangle, untangle), fabrikc.py (inverse kinematics)
=============================  =========================================================

cable_estimate.py estimates configurations from measured lengths; joint_chain.py and discs.py treat joints one by one.

The maps accept arrays with any leading axes, so that one call evaluates a whole trajectory.

Public: `inverse_kinematics.InverseKinematics`, `inverse_kinematics.solve`, `ik_target.Target`, `ik_target.Targets`,
`ik_result.IkStatus`, `fabrikc.solve_fabrikc`, `configuration.allen_from_jones`, `configuration.jones_from_allen`,
`cables.cable_lengths`, `chain.arm_pose`, `chain.arm_jacobian`, `routing.tangle`, `routing.untangle`,
`routing.tangle_rates`, `differential.DifferentialKinematics`, `differential.DIRECTION`,
`cable_twist.tip_cable_jacobian`, `cable_estimate.estimate_configuration`, `joint_chain.tip_pose`,
`joint_chain.tip_twist`.
"""

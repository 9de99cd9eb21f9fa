"""The thesis's dynamic model of one section that bends in a plane, term by term.

====================  ==================================================================
Eq. 12                eq12_inertia_matrix.py (M), eq12_coriolis_matrix.py (C), eq12_spring_torque.py (K),
                      eq12_gravity_torque.py (G), eq12_cable_torque.py (right-hand side), eq12_balance.py (the sum)
Eq. 13                eq13_joint_friction.py (F)
Eqs. 14, 15           eq15_tension_propagation.py (B)
Eq. 16                eq16_link_wrenches.py (W)
Eq. 17                eq17_serial_jacobian.py (J_s)
Eq. 18                eq18_state_space.py
====================  ==================================================================

The plane: z points along the straight arm, as in `base_link`, x to the side towards which positive angles bend; a
link's absolute angle is the sum of the joint angles up to it, and moments turn z towards x. Every function takes
floats or symbols (`continuum.dynamics.expressions`).
"""

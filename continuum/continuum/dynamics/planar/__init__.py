"""The thesis's dynamic model of one section that bends in a plane, term by term.

=======================  =====================================================================================
rigid_body.py            Eq. 12: M inertia_matrix, C coriolis_matrix, G gravity_torque
springs_and_friction.py  Eq. 12: K spring_torque; Eq. 13: F joint_friction
cable_lengths.py         Eq. 8 in the plane: chord_lengths, cable_lengths
capstan_law.py           Eqs. 14, 15: B tension_propagation, wrap_angles
cable_torque.py          Eq. 16: W link_wrenches; Eq. 17: J_s serial_jacobian,
                         serial_jacobian_transposed_times; Eq. 12, right-hand side: cable_torque
backbone.py              points of the arm in its plane: backbone
balance.py               Eq. 12, the sum: torque_balance, rigid_body_torque
instant.py               arguments of these terms: Motion, Instant
=======================  =====================================================================================

Eq. 18, the state space form, is `numpy_state_space` in `continuum.dynamics.balance`, where effects add to the sum.

In the plane, z points along the straight arm, as in `base_link`, and x to the side of positive bends. The absolute
angle of a link is the sum of the joint angles up to it, and positive moments rotate z towards x. Every function accepts
floats or symbols (`continuum.dynamics.expressions`).
"""

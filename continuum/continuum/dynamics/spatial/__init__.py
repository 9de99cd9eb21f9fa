"""Dynamics of a serial chain in space that cables, torques or lengths drive: one set of loops for every arm.

=================  =============================================================================
vectors.py         spatial motion and force vectors about the world's origin
chain.py           placement of the bodies, inverse dynamics, mass matrix, and their derivatives
cable_paths.py     polylines through the holes of discs: lengths and bends
linear_systems.py  symmetric positive definite systems
time_stepping.py   the step in time with set-valued joint friction, and tensions by the capstan law
sensitivities.py   derivatives of a step by state and values
terms.py           mass matrix, bias, cable lengths, poses of one instant
planar_section.py  one section in a plane, as Eq. 12 has it
arm_model.py       all sections of an arm file
simulation.py      the motion of such an arm, with an estimate of its error
compiling.py       how all of it is compiled
=================  =============================================================================
"""

"""Dynamics of a serial chain in space that cables, torques or lengths drive: one set of loops for every arm.

================  ==============================================================================
vectors.py        spatial motion and force vectors about the world's origin
chain.py          placement of the bodies, inverse dynamics, mass matrix, and their derivatives
cable_paths.py    polylines through the holes of discs: lengths, slip, tensions by the capstan law
time_stepping.py  the step in time with set-valued joint friction, and its sensitivities
================  ==============================================================================
"""

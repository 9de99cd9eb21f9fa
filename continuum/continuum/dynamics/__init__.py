"""Dynamics of a planar chain that cables or torques drive: Eqs. 12 to 18 of the thesis, corrected and extensible.

====================  ==================================================================
expressions.py        why every equation works on numbers and on symbols
parameters.py         the physical parameters with units and bounds
planar/               the equations, one file each: its docstring lists them
effect.py, model.py   what extends Eq. 12; balance.py adds all of it up
input_signal.py       what drives the arm over time: tensions.py, joint_torques.py
compiled/             symbols to exact derivatives to machine code
====================  ==================================================================
"""

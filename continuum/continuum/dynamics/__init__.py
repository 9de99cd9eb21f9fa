"""Dynamics of a cable-driven section that bends in a plane: Eqs. 12 to 18 of the thesis, corrected and extensible.

====================  ==================================================================
expressions.py        why every equation works on numbers and on symbols
parameters.py         the physical parameters with units and bounds
planar/               the equations, one file each: its docstring lists them
effect.py, model.py   what extends Eq. 12; balance.py adds all of it up
compiled/             symbols to exact derivatives to machine code
====================  ==================================================================
"""

"""Statics: where the arm rests under gravity, springs and cable tension, and what its friction holds beside that.

==================  ==========================================================================
resting_arm.py      the equations at rest, and which way the cables slid last
equilibrium.py      the posture in which nothing pulls at a joint
sticking_zone.py    all postures that dry friction holds, told as an interval for each joint
==================  ==========================================================================
"""

"""Statics: equilibria of the arm under gravity, springs and cable tension, and postures that friction holds.

==================  ==========================================================================
resting_arm.py      the equations at rest, given the last sliding direction of the cables
equilibrium.py      the posture without a net torque at any joint
sticking_zone.py    all postures that dry friction holds, as an interval for each joint
==================  ==========================================================================
"""

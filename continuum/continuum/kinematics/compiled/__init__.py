"""The inverse kinematics solver, compiled by numba.

This package contains no equation of the arm: :mod:`equations` registers those of the library with the compiler, and
the loops of the solver call them.
"""

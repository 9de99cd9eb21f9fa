"""The inverse kinematics solver, compiled by numba.

No equation of the arm stands here: :mod:`equations` hands the library's own to the compiler, and the loops call them.
"""

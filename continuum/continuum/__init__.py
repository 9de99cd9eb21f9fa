"""Multi-section, cable-driven snake arms: geometry, kinematics and the `continuum` command.

The library does not depend on ROS. All lengths are in m, angles in rad, times in s and forces in N.

Public: `arm.Arm`, `arm.Section`, `arm.load_arm`, `errors.ContinuumError`, `errors.FileError`,
`errors.InvalidValueError`.
"""

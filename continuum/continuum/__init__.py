"""Multi-section, cable-driven snake arms: geometry, kinematics and the `continuum` command.

Free of ROS. Lengths in m, angles in rad, times in s, forces in N throughout.

Public: `arm.Arm`, `arm.Section`, `arm.load_arm`, `errors.ContinuumError`, `errors.FileError`,
`errors.InvalidValueError`.
"""

"""The arm as URDF: xacro macros of one section, called for every section, and expanded.

`segment.urdf.xacro` is the one definition of the arm's kinematics and geometry for ROS; `continuum_description`
installs it with its tools and launch files.
"""

"""Description of the arm for ROS: URDF and xacro of sections and whole arms, parameter files, launch files, RViz."""

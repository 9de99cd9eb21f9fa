"""Cartesian trajectories with rounded corners and trapezoidal speed, sampled at any instant; independent of ROS."""

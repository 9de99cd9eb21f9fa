"""Cartesian trajectories: paths with rounded corners, trapezoidal speed, pose and twist at any instant; free of ROS."""

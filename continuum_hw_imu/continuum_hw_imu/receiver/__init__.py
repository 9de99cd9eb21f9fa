"""What runs in the bench controller, in its reference implementation; free of ROS, ports and clocks."""

"""Reference implementation of the bench controller; independent of ROS, ports and clocks."""

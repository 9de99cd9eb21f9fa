"""A bench without the bench: arm, sensors, actuators and the port, with faults on request; free of ROS."""

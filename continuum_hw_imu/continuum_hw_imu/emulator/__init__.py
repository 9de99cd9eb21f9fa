"""Emulated bench: arm, sensors, actuators and serial port, with faults on request; independent of ROS."""

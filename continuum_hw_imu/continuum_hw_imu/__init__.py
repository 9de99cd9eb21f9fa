"""Bridge between the workspace and a bench with five inertial sensors and cable actuators: a skeleton so far."""

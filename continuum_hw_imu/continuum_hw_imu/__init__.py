"""Bridge between the workspace and a bench with inertial sensors and cable actuators, its protocol and its emulator."""

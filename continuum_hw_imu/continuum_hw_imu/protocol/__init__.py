"""The binary protocol between host and bench controller (docs/bench-protocol.md); free of ROS and of ports."""

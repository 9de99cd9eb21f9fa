"""The binary protocol between host and bench controller (docs/bench-protocol.md); free of ROS and of ports.

`frame.py` is the layout of a frame on the line, `messages` the payloads, `decoder.py` finds frames among bytes.
"""

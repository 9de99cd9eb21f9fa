"""The binary protocol between host and bench controller (docs/bench-protocol.md); independent of ROS and ports.

`frame.py` defines the layout of a frame on the line, `messages` the payloads; `decoder.py` finds frames in bytes.
"""

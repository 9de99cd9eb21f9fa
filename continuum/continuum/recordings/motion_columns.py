"""Names of the columns of an arm's motion in CSV files. Joints and cables count from 1, joints from the base.

Cable 1 bends the arm towards positive angles.
"""

from __future__ import annotations

TIME = "t_s"


def angle_column(joint: int) -> str:
    """Angle of a joint [degrees]."""
    return f"q{joint}_deg"


def rate_column(joint: int) -> str:
    """Rate of a joint [degrees/s]."""
    return f"dq{joint}_deg_s"


def tension_column(cable: int) -> str:
    """Tension of a cable at the base [N]."""
    return f"u{cable}_N"

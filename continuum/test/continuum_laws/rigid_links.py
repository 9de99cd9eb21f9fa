"""The arm as the rigid links that it is made of, by plain products of 4 x 4 matrices: a reference that shares no code.

A section is Rz(phi) [Tz(b) Ry(theta / n) Tz(b)]^n Rz(-phi), a disc after every bracket (thesis appendix A). A cable is
a string through holes; in the straight arm it is parallel to the axis, which says where its holes are.
"""

import numpy as np

from continuum.arm import Arm, Section


def turn(axis: str, angle: float) -> np.ndarray:
    """Rotation about x, y or z by ``angle`` [rad], (4, 4)."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(4)
    matrix[i, i] = matrix[j, j] = np.cos(angle)
    matrix[j, i] = np.sin(angle)
    matrix[i, j] = -np.sin(angle)
    return matrix


def lift(height: float) -> np.ndarray:
    """Translation along z by ``height`` [m], (4, 4)."""
    matrix = np.eye(4)
    matrix[2, 3] = height
    return matrix


def section_discs(phi: float, theta: float, section: Section) -> list[np.ndarray]:
    """Frames (4, 4) of the n_joints + 1 discs in the section's base frame, base disc first, without torsion."""
    pose = turn("z", phi)
    discs = [np.eye(4)]
    for _ in range(section.n_joints):
        pose = pose @ lift(section.b) @ turn("y", theta / section.n_joints) @ lift(section.b)
        discs.append(pose @ turn("z", -phi))
    return discs


def arm_discs(phi: np.ndarray, theta: np.ndarray, arm: Arm) -> list[list[np.ndarray]]:
    """Frames of all discs in ``base_link``, by section."""
    base = np.eye(4)
    result = []
    for i, section in enumerate(arm.sections):
        base = base @ turn("z", section.twist)
        result.append([base @ disc for disc in section_discs(phi[i], theta[i], section)])
        base = result[-1][-1]
    return result


def total_cable_lengths(phi: np.ndarray, theta: np.ndarray, arm: Arm) -> np.ndarray:
    """Length [m] of every cable of the arm from the base plate to its anchor, hole by hole."""
    straight, bent = arm_discs(0 * phi, 0 * theta, arm), arm_discs(phi, theta, arm)
    totals = []
    for last, section in enumerate(arm.sections):
        for azimuth in section.cable_azimuths:
            anchor = straight[last][-1] @ [section.a * np.cos(azimuth), section.a * np.sin(azimuth), 0.0, 1.0]
            holes = []
            for i in range(last + 1):
                for disc_straight, disc in zip(straight[i], bent[i], strict=True):
                    through = [anchor[0], anchor[1], disc_straight[2, 3], 1.0]
                    holes.append((disc @ np.linalg.inv(disc_straight) @ through)[:3])
            totals.append(np.sum(np.linalg.norm(np.diff(holes, axis=0), axis=1)))
    return np.array(totals)

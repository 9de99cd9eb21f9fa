"""A robot of one or more sections: as xacro, one macro call per section, and expanded to URDF."""

from __future__ import annotations

import glob
from collections.abc import Iterable
from importlib.resources import as_file, files
from typing import NamedTuple
from xml.etree import ElementTree

import xacro
from scipy.spatial.transform import Rotation

from continuum.arm import Arm
from continuum.arrays import Array
from continuum.urdf.segment import segment_call

BASE_LINK = "base_link"
"""Root link of the arm: its base plate, z along the straight arm (REP-105)."""

_MACROS = "segment.urdf.xacro"
_PORTABLE_MACROS = f"$(find continuum_description)/urdf/{_MACROS}"


class Sensor(NamedTuple):
    """A sensor in the origin of a link.

    Attributes:
        frame: name of its frame, in whose axes it measures.
        link: name of the link.
        rotation: turns vectors in its axes to those of the link, (3, 3).
    """

    frame: str
    link: str
    rotation: Array


def robot_xacro(
    arm: Arm, base_link: str = BASE_LINK, with_base: bool = True, macros: str = _PORTABLE_MACROS
) -> ElementTree.Element:
    """The arm as a xacro document.

    Args:
        arm: the sections, each on the tip of the one before it.
        base_link: link that the first section stands on.
        with_base: make that link here; False leaves it to the document that includes this one.
        macros: file that defines the macros, as xacro's include takes it.

    Raises:
        InvalidValueError: a section or the base link has a name that links cannot have.
    """
    robot = ElementTree.Element("robot", {"name": "continuum", "xmlns:xacro": "http://www.ros.org/wiki/xacro"})
    ElementTree.SubElement(robot, "xacro:include", filename=macros)
    calls = []
    parent = base_link
    for index, section in enumerate(arm.sections):
        calls.append(segment_call(section, parent, index))
        parent = section.tip_frame
    if with_base:
        first = arm.sections[0]
        base = {"link": base_link, "a": repr(first.a), "b": repr(first.b)}
        ElementTree.SubElement(robot, "xacro:continuum_base", base)
    robot.extend(calls)
    return robot


def robot_urdf(arm: Arm, base_link: str = BASE_LINK, sensors: Iterable[Sensor] = ()) -> ElementTree.Element:
    """The arm as URDF: the macros of :func:`robot_xacro`, expanded; every sensor is a fixed link without a body.

    Raises:
        InvalidValueError: a section or the base link has a name that links cannot have.
    """
    with as_file(files(__package__) / _MACROS) as macros:
        document = xacro.parse(to_text(robot_xacro(arm, base_link, macros=glob.escape(str(macros)))))
        xacro.process_doc(document)
    robot = ElementTree.fromstring(document.toxml())
    for element in robot.iter():
        element.text = None
    for sensor in sensors:
        joint = ElementTree.SubElement(robot, "joint", name=f"{sensor.frame}_joint", type="fixed")
        ElementTree.SubElement(joint, "parent", link=sensor.link)
        ElementTree.SubElement(joint, "child", link=sensor.frame)
        turns = Rotation.from_matrix(sensor.rotation).as_euler("xyz").tolist()
        ElementTree.SubElement(joint, "origin", xyz="0 0 0", rpy=" ".join(map(repr, turns)))
        ElementTree.SubElement(robot, "link", name=sensor.frame)
    return robot


def urdf_text(arm: Arm, sensors: Iterable[Sensor] = ()) -> str:
    """The arm, with its sensors, as the text of a URDF.

    Raises:
        InvalidValueError: a section has a name that links cannot have.
    """
    return to_text(robot_urdf(arm, sensors=sensors))


def to_text(robot: ElementTree.Element) -> str:
    """The document as indented text, the same for the same arm; it names no encoding, all of it is ASCII."""
    ElementTree.indent(robot)
    return f'<?xml version="1.0"?>\n{ElementTree.tostring(robot, encoding="unicode")}\n'

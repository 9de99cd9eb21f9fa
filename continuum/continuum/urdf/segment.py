"""One section of the arm as a call of the xacro macro ``continuum_segment`` (urdf/segment.urdf.xacro)."""

from __future__ import annotations

import re
from xml.etree import ElementTree

from continuum.arm import SECTION_PARAMETERS, Section
from continuum.errors import InvalidValueError

_NUMBER_WORDS = "true|false|inf|infinity|nan"
_NAME = re.compile(rf"(?!(?:{_NUMBER_WORDS})$)[a-z][a-z0-9_]*", re.IGNORECASE | re.ASCII)


def check_name(what: str, name: str) -> str:
    """Return ``name`` if links, joints and frames can be called after it.

    Raises:
        InvalidValueError: with ``what`` as the name of the value.
    """
    if not _NAME.fullmatch(name):
        raise InvalidValueError(what, name, f"a letter, then letters, digits and _; not {_NUMBER_WORDS}")
    return name


def segment_call(section: Section, parent: str, index: int = 0) -> ElementTree.Element:
    """The macro call that makes ``section`` on the link ``parent``, with every parameter written out.

    Args:
        section: lengths in m, angles in rad, mass in kg, inertia in kg m2.
        parent: link that the section's base frame is fixed to, twisted by ``section.twist``.
        index: number of the section from 0; chooses its colour.

    Raises:
        InvalidValueError: a name is none that links and joints can have.
    """
    attributes = {
        "name": check_name("name of section", section.name),
        "parent": check_name("parent", parent),
        "index": str(index),
    }
    for spec in SECTION_PARAMETERS:
        value = getattr(section, spec.name)
        attributes[spec.name] = f"${{{list(value)!r}}}" if spec.is_list else repr(value)
    return ElementTree.Element("xacro:continuum_segment", attributes)

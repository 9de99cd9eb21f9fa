"""What pyproject.toml cannot say: the version of package.xml, the effects' entry points, files of a ROS package."""

import sys
from pathlib import Path
from xml.etree import ElementTree

from setuptools import find_packages, setup

package_name = "continuum"
HERE = Path(__file__).parent


def effects() -> list[str]:
    """Every file of the effects' package but its __init__ is an effect: rest_angle.py holds RestAngle."""
    names = sorted(path.stem for path in HERE.glob("continuum/effects/[!_]*.py"))
    return [f"{name} = continuum.effects.{name}:{name.title().replace('_', '')}" for name in names]


def ros_files() -> list[tuple[str, list[str]]]:
    """Files of an ament package, and the command for the PATH; a wheel has no place for them, pip makes the command."""
    if "bdist_wheel" in sys.argv:
        return []
    return [
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        ("bin", ["bin/continuum"]),
    ]


setup(
    name=package_name,
    version=ElementTree.parse(HERE / "package.xml").findtext("version"),
    python_requires=">=3.12",
    packages=find_packages(exclude=["test"]),
    package_data={
        "continuum": ["arms/*.yaml"],
        "continuum.dynamics": ["models/*.yaml"],
        "continuum.languages": ["*.po", "*.mo"],
        "continuum.discovery.report": ["templates/*", "track_record.json"],
        "continuum.urdf": ["*.xacro"],
    },
    data_files=ros_files(),
    zip_safe=False,
    entry_points={
        "console_scripts": ["continuum = continuum.cli:main"],
        "continuum.effects": effects(),
    },
)

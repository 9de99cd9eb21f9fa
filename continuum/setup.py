from pathlib import Path

from setuptools import find_packages, setup

package_name = "continuum"


def effects() -> list[str]:
    """Every file of the effects' package but its __init__ is an effect: rest_angle.py holds RestAngle."""
    names = sorted(path.stem for path in Path(__file__).parent.glob("continuum/effects/[!_]*.py"))
    return [f"{name} = continuum.effects.{name}:{name.title().replace('_', '')}" for name in names]


setup(
    name=package_name,
    version="0.1.0",
    packages=find_packages(exclude=["test"]),
    package_data={
        "continuum.dynamics": ["models/*.yaml"],
        "continuum.discovery.report": ["templates/*", "track_record.json"],
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        ("bin", ["bin/continuum"]),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    entry_points={
        "console_scripts": [
            "continuum = continuum.cli:main",
        ],
        "continuum.effects": effects(),
    },
)

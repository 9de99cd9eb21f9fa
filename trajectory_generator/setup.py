from glob import glob
from xml.etree import ElementTree

from setuptools import find_packages, setup

package_name = "trajectory_generator"

setup(
    name=package_name,
    version=ElementTree.parse("package.xml").findtext("version"),
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        (f"share/{package_name}/config", glob("config/*.*")),
        (f"share/{package_name}/launch", glob("launch/*.*")),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    entry_points={
        "console_scripts": [
            "trajectory_publisher = trajectory_generator.trajectory_publisher_node:main",
        ],
    },
)

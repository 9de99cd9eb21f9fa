from glob import glob
from xml.etree import ElementTree

from setuptools import find_packages, setup

package_name = "continuum_manipulator"

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
            "section = continuum_manipulator.section_node:main",
            "robot = continuum_manipulator.robot_node:main",
            "dynamics = continuum_manipulator.dynamics_node:main",
            "cable_tangler = continuum_manipulator.cable_tangler_node:main",
            "cable_estimator = continuum_manipulator.cable_estimator_node:main",
            "forward_kinematics = continuum_manipulator.forward_kinematics_node:main",
            "markers = continuum_manipulator.markers_node:main",
            "viewer = continuum_manipulator.viewer_node:main",
            "recorder = continuum_manipulator.recorder_node:main",
        ],
    },
)

from glob import glob
from xml.etree import ElementTree

from setuptools import find_packages, setup

package_name = "continuum_description"

setup(
    name=package_name,
    version=ElementTree.parse("package.xml").findtext("version"),
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        (f"share/{package_name}/config", glob("config/*.*")),
        (f"share/{package_name}/launch", glob("launch/*.*")),
        (f"share/{package_name}/rviz", glob("rviz/*.*")),
        (f"share/{package_name}/urdf", glob("urdf/*.*")),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    entry_points={
        "console_scripts": [
            "create_continuum_robot = continuum_description.create_continuum_robot:main",
            "create_continuum_segment = continuum_description.create_continuum_segment:main",
        ],
    },
)

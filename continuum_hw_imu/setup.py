from glob import glob
from xml.etree import ElementTree

from setuptools import find_packages, setup

package_name = "continuum_hw_imu"

setup(
    name=package_name,
    version=ElementTree.parse("package.xml").findtext("version"),
    packages=find_packages(exclude=["test"]),
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{package_name}"]),
        (f"share/{package_name}", ["package.xml"]),
        (f"share/{package_name}/launch", glob("launch/*.*")),
    ],
    install_requires=["setuptools"],
    zip_safe=True,
    entry_points={
        "console_scripts": [
            "bench_bridge = continuum_hw_imu.bench_bridge_node:main",
            "bench_emulator = continuum_hw_imu.emulator.command:main",
            "bench_order = continuum_hw_imu.emulator.order_command:main",
        ],
    },
)

"""Every package says its name and version alike in the files where ROS's tools and Python's want them."""

import ast
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tools.setup.layout import ROOT, package_folders

PYTHON_PACKAGES = [path for path in package_folders() if (path / "setup.py").exists()]


def setup_arguments(package: Path) -> dict[str, ast.expr]:
    calls = [node for node in ast.walk(ast.parse((package / "setup.py").read_text())) if isinstance(node, ast.Call)]
    (call,) = [call for call in calls if isinstance(call.func, ast.Name) and call.func.id == "setup"]
    return {keyword.arg: keyword.value for keyword in call.keywords if keyword.arg}


def test_all_packages_are_seen() -> None:
    at_the_top = {path.parent for path in ROOT.glob("*/package.xml")}
    assert at_the_top <= set(package_folders())
    assert len(at_the_top) >= 6


def test_packages_of_the_checkout_have_one_version() -> None:
    manifests = ROOT.glob("*/package.xml")
    assert len({ElementTree.parse(manifest).findtext("version") for manifest in manifests}) == 1


@pytest.mark.parametrize("package", PYTHON_PACKAGES, ids=lambda path: path.name)
def test_a_package_has_its_name_and_the_version_of_its_manifest(package: Path) -> None:
    assert ElementTree.parse(package / "package.xml").findtext("name") == package.name
    assert f'package_name = "{package.name}"' in (package / "setup.py").read_text()
    version = ast.unparse(setup_arguments(package)["version"])
    assert re.fullmatch(r"ElementTree\.parse\(.*'package\.xml'\)\.findtext\('version'\)", version)
    assert (package / "resource" / package.name).exists()


@pytest.mark.parametrize("package", PYTHON_PACKAGES, ids=lambda path: path.name)
def test_every_executable_has_its_module(package: Path) -> None:
    entry_points = setup_arguments(package).get("entry_points", ast.Dict([], []))
    assert isinstance(entry_points, ast.Dict)
    groups = {ast.literal_eval(key): value for key, value in zip(entry_points.keys, entry_points.values, strict=True)}
    for line in ast.literal_eval(groups.get("console_scripts", ast.List([]))):
        module, function = line.split("=")[1].strip().split(":")
        path = package / f"{module.replace('.', '/')}.py"
        path = path if path.exists() else path.with_suffix("") / "__init__.py"
        assert path.exists(), line
        assert function in path.read_text(), line

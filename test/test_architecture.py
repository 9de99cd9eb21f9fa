"""docs/architecture.md kept: who imports whom, what is declared in package.xml, floors without cycles."""

import ast
import re
import sys
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path
from xml.etree import ElementTree

import pytest

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = sorted(manifest.parent.name for manifest in ROOT.glob("*/package.xml"))
PAGE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")

CODE = ("*.py", "*.xml", "*.xacro", "*.yaml", "*.msg", "*.cfg", "CMakeLists.txt")

PLAIN_PYTHON = {  # what a module is called in package.xml (rosdep's keys)
    "argcomplete": "python3-argcomplete",
    "casadi": "casadi-pip",
    "jinja2": "python3-jinja2",
    "llvmlite": "python3-numba",  # comes with it
    "markupsafe": "python3-jinja2",  # comes with it
    "matplotlib": "python3-matplotlib",
    "mcap": "mcap-ros2-support",  # brings it
    "numba": "python3-numba",
    "numpy": "python3-numpy",
    "rich": "python3-rich",
    "rosbags": "python3-rosbags-pip",
    "scipy": "python3-scipy",
    "serial": "python3-serial",
    "trimesh": "python3-trimesh-pip",
    "xacro": "xacro",
    "yaml": "python3-yaml",
    "yourdfpy": "python3-yourdfpy-pip",
}
WITHOUT_KEY = {
    "apsw",
    "msgspec",
    "viser",
    "websockets",
    "zstandard",
}  # rosbags brings apsw and zstandard, viser the others: docs/dependencies.md
ONLY_IN_TESTS = {"hypothesis", "mujoco", "pytest", "vqf"}

each_package = pytest.mark.parametrize("package", PACKAGES)


def sources(package: str, part: str = "") -> dict[str, Path]:
    """Modules under ``package/part`` by dotted name; by default those that are installed."""
    folder = ROOT / package
    found = {}
    for path in sorted((folder / (part or package)).rglob("*.py")):
        parts = path.relative_to(folder).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def imports(path: Path) -> Iterator[str]:
    """Dotted names that a file imports, anywhere in it; ``from a import b`` gives ``a.b``."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: a relative import"
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


def modules_imported(modules: dict[str, Path], name: str) -> set[str]:
    """Those of ``modules`` that the module ``name`` imports."""
    wanted = list(imports(modules[name]))
    return {w if w in modules else w.rpartition(".")[0] for w in wanted} & modules.keys()


def declared(package: str, *kinds: str) -> set[str]:
    """Names under the given tags of the package's package.xml."""
    manifest = ElementTree.parse(ROOT / package / "package.xml").getroot()
    return {str(tag.text) for kind in kinds for tag in manifest.findall(kind)}


def allowed_by_the_page() -> dict[str, list[str]]:
    """For every package of the page's table, the packages or modules of the workspace that it may import."""
    table = PAGE.partition("## Packages")[2].partition("##")[0]
    rows = re.findall(r"^\| `(\w+)` \|[^|]*\|([^|]*)\|$", table, re.MULTILINE)
    return {package: re.findall(r"`([\w.]+)`", cell) for package, cell in rows}


def floors_of_the_page() -> list[list[str]]:
    """The floors of ``continuum`` from the lowest, as the page's sentence names them."""
    sentence = re.search(r"floors import downwards only: (.+?)\.\s", PAGE, re.DOTALL)
    assert sentence is not None
    return [re.findall(r"`(\w+)`", floor) for floor in sentence[1].split("<")]


def undeclared(modules: dict[str, Path], known: set[str]) -> list[str]:
    """Imports of what is neither Python's own nor in ``known``, by the names of package.xml."""
    return [
        f"{module} imports {wanted}"
        for module, path in modules.items()
        for wanted in sorted({name.split(".")[0] for name in imports(path)} - sys.stdlib_module_names)
        if PLAIN_PYTHON.get(wanted, wanted) not in known
    ]


def part_of_continuum(module: str) -> str:
    """The module or package right under ``continuum`` that ``module`` belongs to."""
    return ".".join(module.split(".")[:2])


def test_the_page_names_every_package() -> None:
    assert sorted(allowed_by_the_page()) == PACKAGES


@each_package
def test_a_package_imports_of_the_workspace_what_the_page_allows(package: str) -> None:
    allowed = (package, *allowed_by_the_page()[package])
    wrong = [
        f"{module} imports {wanted}"
        for module, path in sources(package).items()
        for wanted in imports(path)
        if wanted.split(".")[0] in PACKAGES and not f"{wanted}.".startswith(tuple(f"{name}." for name in allowed))
    ]
    assert wrong == []


@each_package
def test_what_a_package_imports_is_declared(package: str) -> None:
    known = declared(package, "depend", "exec_depend") | {package} | WITHOUT_KEY
    assert undeclared(sources(package), known) == []


@each_package
def test_what_its_tests_import_is_declared(package: str) -> None:
    tests = sources(package, "test")
    siblings = {*tests.values(), *(ROOT / "test").iterdir()}
    helpers = {path.stem for path in siblings} | {path.parent.name for path in siblings}
    known = declared(package, "depend", "exec_depend", "test_depend") | {package} | WITHOUT_KEY | ONLY_IN_TESTS
    assert undeclared(tests, known | helpers) == []


def test_continuum_knows_nothing_of_ros() -> None:
    """It needs plain Python, so it cannot import ROS without declaring it, which this forbids."""
    needs = declared("continuum", "depend", "exec_depend", "build_depend", "build_export_depend")
    assert needs <= {*PLAIN_PYTHON.values()}


def test_floors_of_continuum_import_downwards() -> None:
    """A module that no floor names stands on the lowest."""
    floors = floors_of_the_page()
    height = {f"continuum.{part}": at for at, floor in enumerate(floors) for part in floor}
    modules = sources("continuum")
    wrong = [
        f"{module} imports {wanted}"
        for module in modules
        for wanted in modules_imported(modules, module)
        if height.get(part_of_continuum(wanted), 0) > height.get(part_of_continuum(module), 0)
    ]
    assert len(floors) > 3
    assert wrong == []


@each_package
def test_no_module_imports_itself_round_a_circle(package: str) -> None:
    modules = sources(package)
    TopologicalSorter({module: modules_imported(modules, module) for module in modules}).prepare()


def test_no_part_of_continuum_imports_itself_round_a_circle() -> None:
    """Not by way of other modules either: kinematics and dynamics, say, may not import each other."""
    modules = sources("continuum")
    graph: dict[str, set[str]] = {}
    for module in modules:
        wanted = {part_of_continuum(name) for name in modules_imported(modules, module)}
        graph.setdefault(part_of_continuum(module), set()).update(wanted)
    TopologicalSorter({part: wanted - {part} for part, wanted in graph.items()}).prepare()


def test_no_merge_left_its_marks() -> None:
    """In documents and docstrings nothing else would fail on them."""
    mark = re.compile(r"^(<{7}|>{7}) ", re.MULTILINE)
    folders = [ROOT / folder for folder in (*PACKAGES, "docs", "test", "tools", ".ci")]
    kinds = (*CODE, "*.md", "*.toml", "*.sh")
    files = [path for folder in folders for kind in kinds for path in folder.rglob(kind)]
    files += [path for kind in kinds for path in ROOT.glob(kind)] + [ROOT / "Makefile"]
    assert [str(path) for path in files if mark.search(path.read_text(encoding="utf-8", errors="replace"))] == []


@each_package
def test_a_package_that_lists_its_files_lists_files_that_are_there(package: str) -> None:
    for path in (ROOT / package).rglob("__init__.py"):
        words = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
        missing = [name for name in re.findall(r"\w+\.py\b", words) if not any(path.parent.rglob(name))]
        assert missing == [], path

"""The library by `pip install` alone: from its sdist, without ROS, colcon or a compiler."""

import re
import shutil
import subprocess
import sys
import tomllib
from importlib.metadata import packages_distributions, requires
from pathlib import Path

import pytest
from colcon_python_setup_py.package_identification.python_setup_py import get_setup_information
from test_architecture import imports, sources

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "continuum"
SITE = next(Path(entry) for entry in sys.path if entry.endswith("site-packages") and ".venv" in entry)
"""The workspace's environment: the dependencies in their pinned versions."""


def distribution(requirement: str) -> str:
    return re.split(r"[ <>=!~;\[(]", requirement, maxsplit=1)[0].lower().replace("_", "-")


def test_every_import_is_of_a_declared_dependency_or_of_what_one_brings() -> None:
    project = tomllib.loads((PACKAGE / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    declared = {distribution(one) for one in project["dependencies"]}
    brought = {distribution(one) for name in declared for one in requires(name) or []}
    modules = {name.partition(".")[0] for path in sources("continuum").values() for name in imports(path)}
    foreign = modules - {*sys.stdlib_module_names, "continuum", "__future__"}
    providers = {name: {one.lower().replace("_", "-") for one in packages_distributions()[name]} for name in foreign}
    assert {name for name, theirs in providers.items() if not theirs & (declared | brought)} == set()
    assert declared <= set().union(*providers.values())


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where pip put the library, and next to it an empty folder for the PATH."""
    folder = tmp_path_factory.mktemp("pip")
    build = f"import setuptools.build_meta as backend; print(backend.build_sdist({str(folder)!r}))"
    copied = folder / "checkout"
    shutil.copytree(PACKAGE, copied, ignore=shutil.ignore_patterns("__pycache__", "*.egg-info", "build"))
    run([sys.executable, "-c", build], cwd=copied)
    (sdist,) = folder.glob("*.tar.gz")
    install = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--no-build-isolation"]
    run([*install, "--target", str(folder / "site"), str(sdist)], cwd=folder)
    (folder / "empty").mkdir()
    return folder


def run(words: list[str], cwd: Path, **environment: str) -> str:
    done = subprocess.run(words, cwd=cwd, env=environment or None, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{words}: {done.stdout}\n{done.stderr}"
    return done.stdout + done.stderr


def alone(installed: Path, *words: str) -> str:
    """Run Python with the installed library, no ROS in the environment and nothing on the PATH."""
    return run(
        [sys.executable, *words], installed, PYTHONPATH=f"{installed / 'site'}:{SITE}", HOME=str(installed),
        PATH=str(installed / "empty"), OPENBLAS_NUM_THREADS="1",
    )  # fmt: skip


def command(installed: Path, *words: str) -> str:
    return alone(installed, "-c", "import sys; from continuum.cli import main; sys.exit(main())", *words)


@pytest.mark.slow
def test_the_library_is_the_installed_one_with_its_data(installed: Path) -> None:
    file = alone(installed, "-c", "import continuum; print(continuum.__file__)")
    assert file.startswith(str(installed / "site"))
    wanted = {path.relative_to(PACKAGE) for pattern in ("*.yaml", "*.html", "*.css", "*.json", "*.xacro", "*.mo")
              for path in (PACKAGE / "continuum").rglob(pattern)}  # fmt: skip
    assert wanted
    assert all((installed / "site" / path).exists() for path in wanted)


@pytest.mark.slow
def test_pip_refuses_an_older_python(installed: Path) -> None:
    (metadata,) = (installed / "site").glob("continuum-*.dist-info/METADATA")
    assert "\nRequires-Python: >=3.12\n" in metadata.read_text(encoding="utf-8")


def test_colcon_can_read_the_setup() -> None:
    """It evaluates a dry run of setup.py as literals; the `SpecifierSet` that pyproject.toml would give is none."""
    assert get_setup_information(PACKAGE / "setup.py")["python_requires"] == ">=3.12"


@pytest.mark.slow
def test_it_simulates_without_a_compiler_and_says_once_what_one_would_gain(installed: Path) -> None:
    # SciPy's integrator, as numba's loops take half a minute to compile
    printed = command(installed, "simulate", "--release", "60", "--integrator", "bdf", "--csv", "run.csv")
    assert "complete" in printed
    assert printed.count("no C compiler") == 1
    assert (installed / "run.csv").exists()


@pytest.mark.slow
def test_it_knows_every_effect_and_draws_an_arm(installed: Path) -> None:
    effects = "from continuum.dynamics.effect_lookup import effect_names; print(*effect_names())"
    files = {path.stem for path in (PACKAGE / "continuum" / "effects").glob("[!_]*.py")}
    assert {*alone(installed, "-c", effects).split()} == files
    arm = ROOT / "continuum_description" / "config" / "three_sections.yaml"
    links = (
        "import sys; from continuum.arm import load_arm; from continuum.viewer.description import arm_description; "
        "print(*(link.name for link in arm_description(load_arm(sys.argv[1])).robot.links))"
    )
    assert {"base_link", "section_3_tip"} <= {*alone(installed, "-c", links, str(arm)).split()}

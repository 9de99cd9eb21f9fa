"""Import the workspace's packages before any test module; give every module a separate ROS domain.

pytest's importlib mode names a test by its path from here, ``continuum.test.test_arm``, and would else take the folder
``continuum/`` for the package ``continuum``, which is ``continuum/continuum/``. It does so already for the conftest.py
files below, before it calls any hook: hence at import.
"""

import importlib
import re
import signal
import sys
from collections.abc import Collection, Iterator
from functools import cache
from pathlib import Path

import pytest
from hypothesis import settings

for manifest in sorted(Path(__file__).parent.glob("*/package.xml")):
    name = manifest.parent.name
    if importlib.import_module(name).__file__ is None:
        pytest.exit(f"{name} is not installed; run `make test`, or `source install/setup.bash` first", returncode=2)


def pytest_configure(config: pytest.Config) -> None:
    """Let ROS's message support import its parser, which uses a module that Python is about to drop; no deadlines.

    Shells start what runs in the background deaf to interrupts, and so would be every process that a test interrupts.
    """
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    config.addinivalue_line("filterwarnings", "ignore:module 'sre_.*' is deprecated:DeprecationWarning")
    settings.register_profile("untimed", deadline=None)  # a busy machine makes no test fail
    settings.load_profile("untimed")


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let ``make test`` run the tests in parts, and ``make exam`` one of them with more seeds."""
    parser.addoption("--part", choices=("nodes", "units", "hidden-effects", "quick"), help="run this part alone")
    parser.addoption("--rounds", type=int, default=1, help="of hidden effects, each with other seeds")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave out what ``--part`` does not name."""
    if (part := config.getoption("part")) is None:
        return
    kept: list[pytest.Item] = []
    left_out: list[pytest.Item] = []
    for item in items:
        if parts_of(item)[0] not in _parts_in(item.path):
            raise pytest.UsageError(f"{item.nodeid}: its marker is not seen in the text; write pytest.mark.NAME there")
        (kept if part in parts_of(item) else left_out).append(item)
    config.hook.pytest_deselected(items=left_out)
    items[:] = kept


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out modules that hold nothing of the part, before they are imported: that takes longer than their text."""
    part = config.getoption("part")
    if part is None or not re.fullmatch(r"test_.*\.py", collection_path.name):
        return None
    return part not in _parts_in(collection_path) or None


@cache
def _parts_in(path: Path) -> frozenset[str]:
    """Parts that a module may hold some of, by the markers in its text."""
    text = path.read_text(encoding="utf-8")
    whole = _WHOLE_MODULE.findall(text)
    single = [(), *((name,) for name in _MARK.findall(text))]
    return frozenset(part for marks in single for part in _parts({*marks, *whole}))


_MARK = re.compile(r"\bmark\.(ros|hidden_effects|slow)\b")
_WHOLE_MODULE = re.compile(r"^pytestmark = .*\bmark\.(ros|hidden_effects|slow)\b", re.MULTILINE)


def parts_of(item: pytest.Item) -> tuple[str, ...]:
    """The part of a test, and "quick" where it is one of the fast ones."""
    return _parts({name for name in ("ros", "hidden_effects", "slow") if item.get_closest_marker(name)})


def _parts(markers: Collection[str]) -> tuple[str, ...]:
    if "ros" in markers:
        return ("nodes",)
    if "hidden_effects" in markers:
        return ("hidden-effects",)
    return ("units",) if "slow" in markers else ("units", "quick")


sys.path.append(str(Path(__file__).parent / "test"))  # for the package harness


@pytest.fixture(scope="module")
def domain() -> Iterator[int]:
    """Give a ROS domain that no other test on this machine uses meanwhile."""
    from domain_coordinator import domain_id

    with domain_id() as number:
        yield number

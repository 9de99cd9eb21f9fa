"""Import the workspace's packages before any test module; give every module a separate ROS domain.

pytest's importlib mode names a test by its path from here, ``continuum.test.test_arm``, and would else take the folder
``continuum/`` for the package ``continuum``, which is ``continuum/continuum/``. It does so already for the conftest.py
files below, before it calls any hook: hence at import.
"""

import importlib
import signal
import sys
from collections.abc import Iterator
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


sys.path.append(str(Path(__file__).parent / "test"))  # for the package harness


@pytest.fixture(scope="module")
def domain() -> Iterator[int]:
    """Give a ROS domain that no other test on this machine uses meanwhile."""
    from domain_coordinator import domain_id

    with domain_id() as number:
        yield number

"""Compiled functions are kept where they may be: beside their sources, in the user's folder, or nowhere."""

import gc
import importlib.util
import os
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from continuum.compiled_code import caching, entry_point, sources_digest

SOURCE = """
def build(digest):
    def run(x):
        _ = digest
        return 2.0 * x

    return run
"""


@pytest.fixture
def make(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], Any]:
    """Makes the entry point of a file as a new program would, which has nothing of an earlier one."""
    file = tmp_path / "installed" / "doubling.py"
    file.parent.mkdir()
    file.write_text(SOURCE)

    def fresh() -> Any:
        spec = importlib.util.spec_from_file_location("doubling", file)
        module = importlib.util.module_from_spec(spec)
        monkeypatch.setitem(sys.modules, "doubling", module)
        spec.loader.exec_module(module)
        gc.collect()
        return entry_point(module.build, sources_digest(file.parent))

    return fresh


@pytest.fixture
def read_only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], None]:
    """Makes a folder refuse files, as it would to whoever is not its owner."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))

    def refuse(part: str) -> None:
        ensure, save = caching.InTreeCacheLocator.ensure_cache_path, os.replace

        def ensured(locator: Any) -> None:
            if part in locator.get_cache_path():
                raise PermissionError(locator.get_cache_path())
            ensure(locator)

        def replaced(old: Any, new: Any) -> None:
            if part in str(new):
                raise PermissionError(new)
            save(old, new)

        monkeypatch.setattr(caching.InTreeCacheLocator, "ensure_cache_path", ensured)
        monkeypatch.setattr(os, "replace", replaced)

    return refuse


def hits(function: Any) -> int:
    """Versions of the function that were found compiled, after it has doubled a number."""
    assert function(3.0) == 6.0
    return sum(function.stats.cache_hits.values())


def test_beside_the_sources(make: Callable[[], Any]) -> None:
    assert hits(make()) == 0
    assert hits(make()) == 1


def test_a_read_only_installation_is_read(make: Callable[[], Any], read_only: Callable[[str], None]) -> None:
    hits(make())
    read_only("installed/")
    assert hits(make()) == 1
    assert make()(3) == 6.0  # another type than was installed: compiled, and kept nowhere


def test_without_anything_installed_the_user_s_folder_keeps_it(
    make: Callable[[], Any], read_only: Callable[[str], None], tmp_path: Path
) -> None:
    read_only("installed/")
    assert hits(make()) == 0
    assert hits(make()) == 1
    assert list((tmp_path / "cache" / "continuum" / "compiled").rglob("*.nbi"))


def test_where_nothing_can_be_written_it_works_all_the_same(
    make: Callable[[], Any], read_only: Callable[[str], None], tmp_path: Path
) -> None:
    read_only(str(tmp_path))
    assert hits(make()) == 0
    assert hits(make()) == 0


def test_other_sources_are_compiled_anew(make: Callable[[], Any], tmp_path: Path) -> None:
    hits(make())
    (tmp_path / "installed" / "equation.py").write_text("one = 1\n")
    assert hits(make()) == 0

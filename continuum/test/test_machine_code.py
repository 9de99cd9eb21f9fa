"""Machine code of a model is found again if its file is sound, and compiled if not."""

import threading
import warnings
from collections.abc import Callable
from pathlib import Path

import casadi
import numpy as np
import pytest

from continuum import compile_cache
from continuum.dynamics.compiled import machine_code
from continuum.dynamics.compiled.machine_code import compile_function


@pytest.fixture
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(compile_cache, "_warned", threading.Event())
    return tmp_path / "cache"


@pytest.fixture
def compilations(monkeypatch: pytest.MonkeyPatch) -> list[object]:
    """Grows with every call of the compiler."""
    calls: list[object] = []
    compile_code = machine_code._compile

    def counted(*arguments: object) -> object:
        calls.append(arguments)
        return compile_code(*arguments)

    monkeypatch.setattr(machine_code, "_compile", counted)
    return calls


def triple(number: float) -> float:
    """Three times the number, by a function that is made or found."""
    x = casadi.SX.sym("x")
    given, found = np.array([number]), np.empty(1)
    compile_function(casadi.Function("triple", [x], [3 * x]))(given.ctypes.data, found.ctypes.data)
    return float(found[0])


def test_it_is_compiled_once(cache: Path, compilations: list[object]) -> None:
    assert [triple(2.0), triple(4.0)] == [6.0, 12.0]
    assert len(compilations) == 1
    assert len(list(cache.rglob("*.so"))) == 1


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: b"",
        lambda data: data[:1000],
        lambda data: data[:-32],
        lambda data: data[:-33] + bytes([data[-33] ^ 1]) + data[-32:],
        lambda data: bytes(len(data)),
    ],
    ids=["empty", "cut", "without a digest", "a bit", "zeros"],
)
def test_a_damaged_file_is_made_again(
    cache: Path, compilations: list[object], damage: Callable[[bytes], bytes]
) -> None:
    triple(1.0)
    (library,) = cache.rglob("*.so")
    data = library.read_bytes()
    library.unlink()  # what is loaded must stay as it is
    library.write_bytes(damage(data))
    assert [triple(2.0), triple(4.0)] == [6.0, 12.0]
    assert len(compilations) == 2


def test_a_file_of_another_kind_of_machine_is_not_loaded(
    cache: Path, compilations: list[object], monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as context:
        context.setattr("platform.machine", lambda: "another")
        triple(1.0)
    assert triple(2.0) == 6.0
    assert len(compilations) == 2


def test_where_it_cannot_be_kept_it_works_all_the_same_with_one_warning(
    cache: Path, compilations: list[object]
) -> None:
    cache.write_text("a file, no folder")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert [triple(2.0), triple(4.0)] == [6.0, 12.0]
    assert [one.category for one in caught] == [RuntimeWarning]
    assert len(compilations) == 2

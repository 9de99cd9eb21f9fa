"""Machine code of a model is found again if its file is sound, and compiled if not."""

import itertools
import threading
import warnings
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import casadi
import numpy as np
import pytest

from continuum import compile_cache
from continuum.dynamics.compiled import machine_code
from continuum.dynamics.compiled.machine_code import compile_function, found_or_compiled
from continuum.dynamics.compiled.structure_key import structure_key
from continuum.dynamics.compiled.symbolic_balance import SymbolicBalance
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model import ActiveEffect
from continuum.dynamics.model_file import load_model


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


def twice(key: str | None, traced: list[str], number: float) -> float:
    """Twice the number, by a function that ``key`` may lead to; ``traced`` grows where it is traced."""

    def trace() -> casadi.Function:
        traced.append(str(key))
        x = casadi.SX.sym("x")
        return casadi.Function("twice", [x], [2 * x])

    given, found = np.array([number]), np.empty(1)
    found_or_compiled(key, "twice", trace)(given.ctypes.data, found.ctypes.data)
    return float(found[0])


def test_what_a_key_leads_to_is_not_traced_again(cache: Path, compilations: list[object]) -> None:
    traced: list[str] = []
    assert [twice(key, traced, 2.0) for key in ("one", "one", "other", None, None)] == [4.0] * 5
    assert traced == ["one", "other", "None", "None"]
    assert len(compilations) == 1  # it is the same code


@pytest.mark.parametrize("suffix", [".index", ".so"])
@pytest.mark.parametrize("damage", [lambda data: b"", lambda data: data[:-1], lambda data: b"x" + data[1:]])
def test_a_damaged_index_or_library_is_made_again(cache: Path, suffix: str, damage: Callable[[bytes], bytes]) -> None:
    traced: list[str] = []
    assert twice("one", traced, 2.0) == 4.0
    (file,) = cache.rglob(f"*{suffix}")
    data = file.read_bytes()
    file.unlink()  # the library is loaded
    file.write_bytes(damage(data))
    assert [twice("one", traced, 3.0), twice("one", traced, 3.0)] == [6.0, 6.0]
    assert len(traced) == 2


def test_models_of_one_key_have_the_same_equations() -> None:
    arm = load_model("lamecc_prototype.yaml")
    drag = ActiveEffect(effect_named("quadratic_drag"), {"drag": np.array([0.1])})
    heavier = arm.with_values({"mass": 0.3})
    models = [arm, heavier, replace(arm, effects=(*arm.effects, drag)), replace(arm, effects=())]
    keys = [structure_key(model) for model in models]
    codes = [machine_code._c_code(SymbolicBalance(model).residual) for model in models]
    for one, other in itertools.combinations(range(len(models)), 2):
        assert (keys[one] == keys[other]) == (codes[one] == codes[other])


def test_an_effect_of_another_package_has_no_key() -> None:
    class Other(type(effect_named("quadratic_drag"))):  # type: ignore[misc]
        """An effect that is written here."""

    arm = load_model("lamecc_prototype.yaml")
    drag = ActiveEffect(Other(), {"drag": np.array([0.1])})
    assert structure_key(replace(arm, effects=(*arm.effects, drag))) is None

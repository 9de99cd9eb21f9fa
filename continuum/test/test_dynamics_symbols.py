"""The equations traced with symbols, as machine code, and in floats are the same; their derivatives are exact."""

import threading
from functools import lru_cache

import casadi
import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import LaggingDrive, TipLoad, TurningBase, Wind, active, random_model

from continuum.dynamics.balance import balance
from continuum.dynamics.compiled import code_in_parts, machine_code
from continuum.dynamics.compiled.machine_code import CompilerError, compile_function
from continuum.dynamics.compiled.symbolic_balance import SymbolicBalance
from continuum.dynamics.expressions import positive_part, smooth_sign, suffix_sum, where_positive
from continuum.dynamics.model import ActiveEffect, Model
from continuum.dynamics.values import parameter_slots, parameter_vector

pytestmark = pytest.mark.slow

EFFECTS = (
    active(TipLoad(), mass=0.1),
    active(LaggingDrive(), lag=0.05),
    active(TurningBase(), tilt=0.3, frequency=4.0),
)
MODELS: dict[str, tuple[int, tuple[ActiveEffect, ...]]] = {
    "one joint": (1, ()),
    "five joints": (5, ()),
    "three joints with effects": (3, EFFECTS),
}
each_model = pytest.mark.parametrize("name", MODELS)


@lru_cache
def model_and_symbols(name: str) -> tuple[Model, SymbolicBalance]:
    n, effects = MODELS[name]
    effects = (*effects, active(Wind(), n, torque=0.2)) if effects else ()
    model = random_model(11, n, effects)
    return model, SymbolicBalance(model)


def random_point(model: Model, seed: int) -> np.ndarray:
    """State, rates, tensions, parameters and h g, packed."""
    random, n = np.random.default_rng(seed), model.n_joints
    x = np.concatenate([random.uniform(-0.5, 0.5, n), random.normal(size=n), random.uniform(0.5, 2.0, model.n_states)])
    return np.concatenate([x, 5 * random.normal(size=n + model.n_states), [4.0, 2.0], parameter_vector(model), [0.3]])


def numeric(model: Model, packed: np.ndarray) -> np.ndarray:
    """The balance of floats at a packed point."""
    nx, nv = 2 * model.n_joints + model.n_states, model.n_joints + model.n_states
    x, v, u, p = np.split(packed[:-1], [nx, nx + nv, nx + nv + 2])
    return balance(model.built_from({name: p[at] for name, at in parameter_slots(model).items()}), x, v, u)


@each_model
def test_derivatives_are_derivatives_of_the_balance(name: str) -> None:
    model, symbols = model_and_symbols(name)
    nx, nv = 2 * model.n_joints + model.n_states, model.n_joints + model.n_states
    for seed in range(2):
        packed = random_point(model, seed)
        step = 1e-3 * np.minimum(1.0, np.where(packed == 0, 1.0, np.abs(packed)))
        expected = differences(lambda s: numeric(model, packed + s * step), np.zeros(packed.size), 1.0) / step  # noqa: B023
        by_x, by_v, _, by_p, _ = np.split(expected, [nx, nx + nv, nx + nv + 2, packed.size - 1], axis=1)
        n, hg = model.n_joints, packed[-1]
        stage = by_v + hg * by_x[:, n:]
        stage[:, :n] += hg**2 * by_x[:, :n]
        for function, matrices in (
            (symbols.residual, []),
            (symbols.stage, [stage]),
            (symbols.newton, [by_v, by_x]),
            (symbols.sensitivities, [stage, by_x, by_p]),
        ):
            found = function(packed).full().reshape(-1, nv).T
            wanted = np.concatenate([numeric(model, packed)[:, None], *matrices], axis=1)
            scale = np.abs(wanted).max(axis=0) + 1e-3
            np.testing.assert_allclose(found / scale, wanted / scale, rtol=0, atol=1e-7)


@each_model
def test_machine_code_computes_what_the_interpreter_does(name: str) -> None:
    model, symbols = model_and_symbols(name)
    for function in (symbols.residual, symbols.stage, symbols.newton, symbols.sensitivities):
        code = compile_function(function)
        for seed in range(5):
            packed = random_point(model, seed)
            out = np.full(function.nnz_out(), np.nan)
            code(packed.ctypes.data, out.ctypes.data)
            np.testing.assert_allclose(out, function(packed).full().ravel(), rtol=1e-12, atol=1e-13)


@each_model
def test_code_cut_into_parts_computes_the_same(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    model, symbols = model_and_symbols(name)
    whole = compile_function(symbols.stage)
    monkeypatch.setattr(code_in_parts, "_LONGEST", 100)
    monkeypatch.setattr(code_in_parts, "_PART", 70)
    parts = compile_function(symbols.stage)
    assert parts is not whole
    packed, size = random_point(model, 1), symbols.stage.nnz_out()
    found, expected = np.full(size, np.nan), np.full(size, np.nan)
    parts(packed.ctypes.data, found.ctypes.data)
    whole(packed.ctypes.data, expected.ctypes.data)
    np.testing.assert_allclose(found, expected, rtol=1e-13, atol=1e-13)


def test_tracing_does_not_look_at_the_values() -> None:
    model, _ = model_and_symbols("five joints")
    packed = random_point(model, 3)
    other = SymbolicBalance(random_model(12, 5)).newton(packed).full()
    np.testing.assert_array_equal(other, SymbolicBalance(model).newton(packed).full())


def test_without_a_compiler_equations_are_the_same_and_the_slower_way_is_said_once(
    monkeypatch: pytest.MonkeyPatch, tmp_path: object
) -> None:
    model, symbols = model_and_symbols("one joint")
    packed, by_c, found = (
        random_point(model, 1),
        compile_function(symbols.newton),
        np.empty((2, symbols.newton.nnz_out())),
    )
    monkeypatch.setattr(machine_code, "_warned", threading.Event())
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    with pytest.warns(RuntimeWarning, match="build-essential") as warned:
        by_llvm, _ = (compile_function(symbols.newton) for _ in range(2))
    assert len(warned) == 1
    for function, out in zip((by_c, by_llvm), found, strict=True):
        function(packed.ctypes.data, out.ctypes.data)
    np.testing.assert_array_equal(*found)


def test_a_compiler_that_fails_is_one_clear_error(monkeypatch: pytest.MonkeyPatch, tmp_path: object) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("CC", "false")
    with pytest.raises(CompilerError, match="failed"):
        compile_function(model_and_symbols("one joint")[1].newton)


def test_elementwise_functions_on_symbols_and_floats() -> None:
    numbers = np.array([-2.0, -0.5, 0.0, 0.5, 2.0])
    names = [casadi.SX.sym(f"x{i}") for i in range(5)]
    symbols = np.array(names, dtype=object)
    for function in (
        positive_part,
        suffix_sum,
        lambda x: smooth_sign(x, np.array([3.0])),
        lambda x: where_positive(x, x, 2 * x),
        lambda x: where_positive(x, 1.0, x[:1]),
    ):
        traced = casadi.Function("f", [casadi.vertcat(*names)], [casadi.vertcat(*function(symbols))])
        found = traced(numbers).full().ravel()
        np.testing.assert_allclose(found, np.array(function(numbers), dtype=float), rtol=1e-15)

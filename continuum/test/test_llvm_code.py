"""Machine code by LLVM against that of the C compiler."""

import casadi
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum.dynamics.compiled.llvm_code import compile_by_llvm
from continuum.dynamics.compiled.machine_code import compile_function
from continuum.dynamics.compiled.symbolic_balance import SymbolicBalance
from continuum.dynamics.model_file import load_model

UNARY = [
    casadi.sin, casadi.cos, casadi.tan, casadi.atan, casadi.sinh, casadi.cosh, casadi.tanh, casadi.exp, casadi.fabs,
    casadi.sign, casadi.floor, casadi.ceil, casadi.sqrt, casadi.log, casadi.expm1, casadi.log1p, casadi.erf,
    casadi.asinh, casadi.acosh, casadi.atanh, casadi.asin, casadi.acos, casadi.logic_not,
]  # fmt: skip
BINARY = [
    casadi.plus, casadi.minus, casadi.times, casadi.rdivide, casadi.power, casadi.atan2, casadi.fmin, casadi.fmax,
    casadi.lt, casadi.le, casadi.eq, casadi.ne, casadi.logic_and, casadi.logic_or, casadi.hypot, casadi.copysign,
    casadi.fmod,
]  # fmt: skip


def evaluated(function: casadi.Function, x: np.ndarray) -> list[np.ndarray]:
    """By LLVM and by C."""
    found = []
    for compiled in (compile_by_llvm(function), compile_function(function)):
        out = np.full(function.nnz_out(0), 7.0)
        compiled(x.ctypes.data, out.ctypes.data)
        found.append(out)
    return found


def every_operation() -> casadi.Function:
    x = casadi.SX.sym("x", 2)
    a, b = x[0], x[1]
    found = [f(a) for f in UNARY] + [f(a, b) for f in BINARY]
    found += [casadi.if_else(a > b, a, b), a**2, 2 * a, 1 / a, a**3, -a, casadi.SX(0.1)]
    return casadi.Function("f", [x], [casadi.vertcat(*found)])


@pytest.fixture(scope="module")
def both() -> tuple[casadi.Function, object, object]:
    function = every_operation()
    return function, compile_by_llvm(function), compile_function(function)


@settings(max_examples=200)
@given(st.floats(-3, 3), st.floats(-3, 3))
def test_every_operation_is_that_of_c_to_the_last_bit(both: tuple, a: float, b: float) -> None:
    function, by_llvm, by_c = both
    x, found = np.array([a, b]), np.full((2, function.nnz_out(0)), 7.0)
    for compiled, out in zip((by_llvm, by_c), found, strict=True):
        compiled(x.ctypes.data, out.ctypes.data)
    np.testing.assert_array_equal(*found)


@pytest.mark.parametrize("name", ["residual", "stage", "newton", "sensitivities"])
def test_equations_of_the_arm_are_those_of_c_to_the_last_bit(name: str) -> None:
    function = getattr(SymbolicBalance(load_model("lamecc_prototype.yaml")), name)
    x = np.random.default_rng(3).uniform(0.05, 1.0, function.nnz_in(0))
    np.testing.assert_array_equal(*evaluated(function, x))


def test_an_operation_that_is_not_known_is_named() -> None:
    x = casadi.SX.sym("x")
    with pytest.raises(NotImplementedError, match="ERFINV"):
        compile_by_llvm(casadi.Function("f", [x], [casadi.erfinv(x)]))

"""Compilation of the integrator's loops, and their calls of a model's machine code.

The cache depends on the source files of this folder. Loops call machine code by its address, so that they are compiled
once for all models.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from continuum import compiled_code
from continuum.compiled_code import compiled

__all__ = ["call_at", "compiled", "entry_point"]

entry_point = compiled_code.entry_point(Path(__file__).parent)
"""Decorator of the function that Python calls."""


@compiled
def call_at(address, given, wanted):  # type: ignore[no-untyped-def]
    """Call ``void f(const double *given, double *wanted)`` with contiguous arrays of floats."""
    _call(address, given.ctypes.data, wanted.ctypes.data)


def _generated(typing: Any, address: Any, given: Any, wanted: Any) -> Any:
    """Give numba the signature and the generated code of a call with the addresses of the data."""
    _ = typing, address, given, wanted

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        _ = signature
        pointer = ir.DoubleType().as_pointer()
        function = ir.FunctionType(ir.VoidType(), [pointer, pointer]).as_pointer()
        address, *data = arguments
        builder.call(builder.inttoptr(address, function), [builder.inttoptr(one, pointer) for one in data])
        return context.get_dummy_value()

    return types.void(types.int64, types.int64, types.int64), generate


_call: Any = intrinsic(_generated)

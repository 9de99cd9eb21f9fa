"""A call from compiled code to machine code at an address, so that loops compiled once serve every model."""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic


def _call_at(typing: Any, address: Any, given: Any, wanted: Any) -> Any:
    """``call_at(address, given, wanted)`` in numba's terms: its signature, and the code that it becomes."""
    _ = typing, address

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        double_pointer = ir.DoubleType().as_pointer()
        function = ir.FunctionType(ir.VoidType(), [double_pointer, double_pointer])
        pointers = [
            cgutils.create_struct_proxy(kind)(context, builder, value=value).data  # type: ignore[no-untyped-call]
            for kind, value in zip(signature.args[1:], arguments[1:], strict=True)
        ]
        builder.call(builder.inttoptr(arguments[0], function.as_pointer()), pointers)
        return context.get_dummy_value()

    return types.void(types.int64, given, wanted), generate


call_at: Any = intrinsic(_call_at)
"""``call_at(address, given, wanted)``: ``void f(const double *given, double *wanted)``, contiguous arrays of floats."""

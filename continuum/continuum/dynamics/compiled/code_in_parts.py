"""Split CasADi's C code of a long arm into functions: compile time grows at least quadratically with their length.

CasADi writes one function, a list of assignments to local variables a0 to ak. When it is split, the variables become
one array that all parts share. The code of arms with at most twenty joints is shorter than the limit and is not split.
"""

from __future__ import annotations

import re

_LONGEST = 40_000  # most statements of a function that is not split
_PART = 500  # statements of a part

_HEAD = re.compile(r"static int casadi_f0\(.*\) \{\n(?:  casadi_real [^;]*;\n)+")
_END = "  return 0;\n}\n"
_VARIABLE = re.compile(r"\ba(\d+)\b")


def in_parts(code: str) -> str:
    """Return C code of one function, as CasADi generates it, with the function split into parts if it is long."""
    head = _HEAD.search(code)
    if head is None:
        return code
    end = code.index(_END, head.end())
    statements = code[head.end() : end].splitlines(keepends=True)
    if len(statements) <= _LONGEST:
        return code
    cut = [_as_array("".join(statements[at : at + _PART])) for at in range(0, len(statements), _PART)]
    given = "const casadi_real** arg, casadi_real** res, casadi_real* restrict a"
    parts = "".join(f"static void part_{k}({given}) {{\n{part}}}\n" for k, part in enumerate(cut))
    calls = "".join(f"  part_{k}(arg, res, a);\n" for k in range(len(cut)))
    first_line = head[0].partition("\n")[0]
    shared = f"  static _Thread_local casadi_real a[{1 + _largest(head[0])}];\n"
    return f"{code[: head.start()]}{parts}{first_line}\n{shared}{calls}{code[end:]}"


def _as_array(statements: str) -> str:
    return _VARIABLE.sub(lambda found: f"a[{int(found[1])}]", statements)


def _largest(declarations: str) -> int:
    return max(int(number) for number in _VARIABLE.findall(declarations))

"""CasADi functions as machine code: C by CasADi's generator, compiled by the system's compiler, kept in a cache."""

from __future__ import annotations

import ctypes
import hashlib
import os
import shutil
import subprocess
import tempfile
from importlib.metadata import version
from pathlib import Path
from typing import Any

import casadi

from continuum.dynamics.compiled.code_in_parts import in_parts
from continuum.errors import ContinuumError, FileError


class CompilerError(ContinuumError, RuntimeError):
    """There is no C compiler, or it did not take the generated code."""


def compile_function(function: casadi.Function) -> Any:
    """The function as ``void f(const double *in, double *out)``; it must have one dense input and one dense output.

    Raises:
        CompilerError: no C compiler is found (named by the environment's CC, else cc or gcc), or it fails.
        FileError: the cache folder cannot be made.
    """
    code = _c_code(function)
    compiler = _compiler()
    key = hashlib.sha256("\0".join((code, compiler, version("casadi"))).encode()).hexdigest()[:32]
    library = _cache_folder() / f"{key}.so"
    if not library.exists():
        _compile(code, compiler, library)
    loaded = ctypes.CDLL(str(library))
    found = loaded["flat"]
    found.argtypes, found.restype = [ctypes.c_void_p, ctypes.c_void_p], None
    return found


def address_of(function: Any) -> int:
    """Where a compiled function stands in memory, for calls from compiled loops; the function must be kept alive."""
    return ctypes.cast(function, ctypes.c_void_p).value or 0


def _c_code(function: casadi.Function) -> str:
    generator = casadi.CodeGenerator("model.c")
    generator.add(function)
    return f"""{in_parts(generator.dump())}
void flat(const double *in, double *out)
{{ const double *arg[1] = {{in}}; double *res[1] = {{out}}; {function.name()}(arg, res, 0, 0, 0); }}
"""


def _compiler() -> str:
    for name in (os.environ.get("CC"), "cc", "gcc"):
        if name and shutil.which(name):
            return name
    raise CompilerError("no C compiler is found (CC, cc, gcc); the dynamics need one, on Debian: build-essential")


def _compile(code: str, compiler: str, library: Path) -> None:
    try:
        library.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(library.parent, f"cannot keep compiled models ({error}); set XDG_CACHE_HOME") from error
    with tempfile.TemporaryDirectory(dir=library.parent) as folder:
        source, built = Path(folder, "model.c"), Path(folder, "model.so")
        source.write_text(code, encoding="utf-8")
        command = [compiler, "-O1", "-fPIC", "-shared", "-o", str(built), str(source), "-lm"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise CompilerError(f"{' '.join(command)} failed: {' '.join(done.stderr.split())[:500]}")
        built.replace(library)


def _cache_folder() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base, "continuum", "models")

"""CasADi functions as machine code: C from CasADi's generator, compiled by the system's compiler and cached.

The digest of its code names a library. For equations of a known structure an index stores that name, so that a program
that finds both need not trace the equations. Without a C compiler, LLVM compiles the code anew in every program.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import platform
import shutil
import subprocess
import tempfile
import threading
import warnings
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import casadi

from continuum.checked_file import read_checked, write_checked
from continuum.compile_cache import user_cache_folder, warn_not_kept
from continuum.dynamics.compiled.code_in_parts import in_parts
from continuum.dynamics.compiled.llvm_code import compile_by_llvm
from continuum.errors import ContinuumError, FileError

_warned = threading.Event()


class CompilerError(ContinuumError, RuntimeError):
    """The C compiler rejected the generated code."""


def compile_function(function: casadi.Function) -> Any:
    """Compile a function to ``void f(const double *in, double *out)``; it must have one dense input and one output.

    The compiler is the one in the environment variable CC, otherwise cc or gcc, otherwise LLVM.

    Raises:
        CompilerError: the C compiler fails.
        FileError: there is neither a cache folder nor a temporary one.
    """
    compiler = _compiler()
    return _by_llvm(function) if compiler is None else _flat(_library_of(function, compiler)[0])


def found_or_compiled(structure: str | None, name: str, trace: Callable[[], casadi.Function]) -> Any:
    """As `compile_function` for the result of ``trace``, which is called only if no library is known for it.

    Args:
        structure: key that identifies the equations before they are traced; None if there is none.
        name: name of the function among those of the equations.
        trace: returns the function.

    Raises:
        CompilerError, FileError: as `compile_function`.
    """
    compiler = _compiler()
    if structure is None or compiler is None:
        return compile_function(trace())
    key = f"{structure}\n{name}"
    index = _folder() / f"{_digest(key, compiler, version('casadi'))}.index"
    known = read_checked(index, key)
    if known is not None and read_checked(library := _folder() / known.decode(), platform.machine()) is not None:
        return _flat(ctypes.CDLL(str(library)))
    loaded, library = _library_of(trace(), compiler)
    try:
        write_checked(index, library.name.encode(), key)
    except OSError as error:
        warn_not_kept(error)
    return _flat(loaded)


def address_of(function: Any) -> int:
    """Return the address of a compiled function, for calls from compiled loops; the caller must keep it alive."""
    return ctypes.cast(function, ctypes.c_void_p).value or 0


def _flat(library: ctypes.CDLL) -> Any:
    found = library["flat"]
    found.argtypes, found.restype = [ctypes.c_void_p, ctypes.c_void_p], None
    return found


def _by_llvm(function: casadi.Function) -> Any:
    if not _warned.is_set():
        _warned.set()
        warnings.warn(
            "no C compiler is found (CC, cc, gcc): LLVM compiles the equations in every program again, and simulations "
            "take up to twice as long; on Debian and Ubuntu: apt install build-essential", RuntimeWarning, stacklevel=2,
        )  # fmt: skip
    return compile_by_llvm(function)


def _library_of(function: casadi.Function, compiler: str) -> tuple[ctypes.CDLL, Path]:
    """Return the library of a function, and its file, which is missing if it cannot be stored."""
    code = _c_code(function)
    library = _folder() / f"{_digest(code, compiler, version('casadi'))}.so"
    return _loaded(code, compiler, library), library


def _folder() -> Path:
    return user_cache_folder() / "models"


def _digest(*parts: str) -> str:
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:32]


def _c_code(function: casadi.Function) -> str:
    generator = casadi.CodeGenerator("model.c")
    generator.add(function)
    return f"""{in_parts(generator.dump())}
void flat(const double *in, double *out)
{{ const double *arg[1] = {{in}}; double *res[1] = {{out}}; {function.name()}(arg, res, 0, 0, 0); }}
"""


def _compiler() -> str | None:
    return next((name for name in (os.environ.get("CC"), "cc", "gcc") if name and shutil.which(name)), None)


def _loaded(code: str, compiler: str, library: Path) -> ctypes.CDLL:
    """Load the library; compile it first if its file is missing, damaged or for another kind of machine."""
    if read_checked(library, platform.machine()) is None:
        with _temporary_folder() as folder:
            built = _compile(code, compiler, Path(folder))
            try:
                write_checked(library, built.read_bytes(), platform.machine())
            except OSError as error:
                warn_not_kept(error)
                return ctypes.CDLL(str(built))  # stays loaded after its file is deleted
    return ctypes.CDLL(str(library))


def _temporary_folder() -> tempfile.TemporaryDirectory[str]:
    try:
        return tempfile.TemporaryDirectory(prefix="continuum-")
    except OSError as error:
        raise FileError("TMPDIR", f"models cannot be compiled ({error})") from error


def _compile(code: str, compiler: str, folder: Path) -> Path:
    source, built = folder / "model.c", folder / "model.so"
    source.write_text(code, encoding="utf-8")
    command = [compiler, "-O1", "-fPIC", "-shared", "-o", str(built), str(source), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise CompilerError(f"{' '.join(command)} failed: {' '.join(done.stderr.split())[:500]}")
    return built

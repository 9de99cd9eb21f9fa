"""Compiled functions are kept where they may be, found again if their files are sound, and always right."""

import importlib.util
import os
import shutil
import subprocess
import sys
import threading
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
import pytest

from continuum import compile_cache
from continuum.compiled_code import sources_digest

pytestmark = pytest.mark.slow

SOURCE = """
from pathlib import Path
from continuum.compiled_code import entry_point

@entry_point(Path(__file__).parent)
def run(x):
    return 2.0 * x
"""
PROGRAM = """
import importlib.util, os, resource, signal, sys, warnings
spec = importlib.util.spec_from_file_location("doubling", sys.argv[1])
module = importlib.util.module_from_spec(spec)
sys.modules["doubling"] = module
spec.loader.exec_module(module)
if len(sys.argv) > 2:
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]), -1))
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    results = [module.run(3.0), module.run(3), module.run(3)]
if len(sys.argv) > 3:
    print("killed", flush=True)
    os.kill(os.getpid(), signal.SIGKILL)
print(results == [6.0, 6.0, 6.0], module.run.n_compiled, len(caught))
"""


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A source file with an entry point, in an installation and with a user of its own; no warning was given yet."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(compile_cache, "_warned", threading.Event())
    file = tmp_path / "installed" / "doubling.py"
    file.parent.mkdir()
    file.write_text(SOURCE)
    return file


@pytest.fixture
def make(file: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[], Any]:
    """Makes the entry point as a new program would, which has nothing of an earlier one."""

    def fresh() -> Any:
        sources_digest.cache_clear()
        spec = importlib.util.spec_from_file_location("doubling", file)
        module = importlib.util.module_from_spec(spec)
        monkeypatch.setitem(sys.modules, "doubling", module)
        spec.loader.exec_module(module)
        return module.run

    return fresh


def compiled_by(function: Any, *numbers: float) -> int:
    """How often the function had to be compiled to double the numbers."""
    for number in numbers or (3.0,):
        assert function(number) == 2 * number
    return int(function.n_compiled)


def kept(folder: Path) -> list[Path]:
    return sorted(folder.rglob("*.compiled"))


def in_another_program(
    file: Path, *arguments: str, within: tuple[str, ...] = (), **variables: str
) -> subprocess.Popen[str]:
    command = [*within, sys.executable, "-c", PROGRAM, str(file), *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, **variables})


def said(program: subprocess.Popen[str]) -> str:
    with program:
        return program.communicate(timeout=120)[0].strip()


def test_it_is_kept_next_to_the_sources_for_every_type(make: Callable[[], Any], file: Path) -> None:
    assert compiled_by(make(), 3.0) == 1
    assert compiled_by(make(), 3.0, 3) == 1
    assert compiled_by(make(), 3, 3.0) == 0
    assert len(kept(file.parent)) == 1


def test_where_the_installation_cannot_be_written_the_user_s_folder_keeps_it(
    make: Callable[[], Any], file: Path, tmp_path: Path
) -> None:
    (file.parent / "__pycache__").write_text("a file, no folder")
    assert compiled_by(make()) == 1
    assert compiled_by(make()) == 0
    assert len(kept(tmp_path / "cache")) == 1


def test_what_was_installed_is_read_and_more_is_kept_elsewhere(
    make: Callable[[], Any], file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiled_by(make(), 3.0)
    write = compile_cache.write_checked

    def refused(path: Path, content: bytes, key: str) -> None:
        if path.is_relative_to(file.parent):
            raise PermissionError(path)
        write(path, content, key)

    monkeypatch.setattr(compile_cache, "write_checked", refused)
    assert compiled_by(make(), 3.0) == 0
    assert compiled_by(make(), 3) == 1
    assert compiled_by(make(), 3.0, 3) == 0


def test_a_folder_that_numba_is_configured_to_use_is_used(
    make: Callable[[], Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(numba.config, "CACHE_DIR", str(tmp_path / "named"))
    assert compiled_by(make()) == 1
    assert kept(tmp_path) == kept(tmp_path / "named") != []
    assert compiled_by(make()) == 0


@pytest.mark.parametrize("nowhere", ["to keep it", "for temporary files", "at all"])
def test_where_it_cannot_be_kept_it_works_all_the_same_with_one_warning(
    make: Callable[[], Any], file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, nowhere: str
) -> None:
    if nowhere != "for temporary files":
        (file.parent / "__pycache__").write_text("a file, no folder")
        (tmp_path / "cache").write_text("a file, no folder")
    if nowhere != "to keep it":
        monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "missing"))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert [compiled_by(make(), 3.0, 3), compiled_by(make(), 3.0, 3)] == [2, 2]
    assert [one.category for one in caught] == [RuntimeWarning]
    assert kept(tmp_path) == []


def test_on_a_full_disk_it_works_all_the_same_with_one_warning(file: Path) -> None:
    for room in ("0", "3000"):  # for nothing, and for numba's index but no machine code [bytes]
        right, _, n_warnings = said(in_another_program(file, room)).split()
        assert (right, n_warnings) == ("True", "1"), room


def test_other_sources_are_compiled(make: Callable[[], Any], file: Path) -> None:
    compiled_by(make())
    equation = file.parent / "section" / "equation.py"
    equation.parent.mkdir()
    for text, times in (("one = 1\n", 1), ("one = 2\n", 1), ("one = 2\n", 0)):
        equation.write_text(text)
        assert compiled_by(make()) == times
    equation.unlink()
    assert compiled_by(make()) == 1


@pytest.mark.parametrize("damage", [lambda data: data[: len(data) // 2], lambda data: data[:-1] + b"\0"])
def test_what_was_damaged_is_compiled_again(
    make: Callable[[], Any], file: Path, damage: Callable[[bytes], bytes]
) -> None:
    compiled_by(make())
    (archive,) = kept(file.parent)
    archive.write_bytes(damage(archive.read_bytes()))
    assert compiled_by(make()) == 1
    assert compiled_by(make()) == 0


def test_what_another_numba_wrote_is_not_loaded(
    make: Callable[[], Any], file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as context:
        context.setattr(numba, "__version__", "0.1")
        compiled_by(make())
    (other,) = kept(file.parent)
    assert compiled_by(make()) == 1
    assert compiled_by(make()) == 0
    (ours,) = {*kept(file.parent)} - {other}  # both stay, each for its environment
    other.replace(ours)
    assert compiled_by(make()) == 1


def test_what_was_compiled_for_another_processor_is_not_loaded(file: Path) -> None:
    another = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
    assert said(in_another_program(file, **another)) == "True 2 0"
    assert said(in_another_program(file)) == "True 2 0"
    assert said(in_another_program(file, **another)) == "True 0 0"


def test_programs_that_start_at_the_same_time_do_not_disturb_each_other(file: Path, tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    programs = [in_another_program(file, TMPDIR=str(temporary)) for _ in range(3)]
    assert all(said(program).startswith("True") for program in programs)
    assert said(in_another_program(file, TMPDIR=str(temporary))) == "True 0 0"
    assert list(temporary.iterdir()) == []


def test_a_program_that_is_killed_leaves_nothing_for_long(file: Path, tmp_path: Path) -> None:
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    foreign = temporary / "continuum-compiled-by-hand"
    foreign.mkdir()
    killed = in_another_program(file, "-1", "kill", TMPDIR=str(temporary))
    assert said(killed) == "killed"
    assert len(list(temporary.iterdir())) == 2
    assert said(in_another_program(file, TMPDIR=str(temporary))).startswith("True")
    assert list(temporary.iterdir()) == [foreign]


def test_a_program_whose_process_another_cannot_see_keeps_its_folder(
    make: Callable[[], Any], file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Containers may share the folder for temporary files, but do not see each other's processes."""
    contained = ("unshare", "--user", "--map-root-user", "--pid", "--fork")
    if shutil.which("unshare") is None or subprocess.run([*contained, "true"], check=False).returncode:
        pytest.skip("this user may not make a namespace of processes")
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    function = make()
    compiled_by(function, 3.0)
    held = list(temporary.iterdir())
    assert said(in_another_program(file, within=contained, TMPDIR=str(temporary))).startswith("True")
    assert list(temporary.iterdir()) == held != []
    assert compiled_by(function, 3) == 2


def test_compilation_is_logged_once_and_only_where_nothing_is_cached(
    make: Callable[[], Any], caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    caplog.set_level("INFO", logger="continuum")
    counts = []
    for _ in range(2):
        monkeypatch.setattr(compile_cache, "_announced", threading.Event())
        first, second = make(), make()
        compiled_by(first)
        compiled_by(second)
        counts.append(len(caplog.records))
    assert counts == [1, 1]

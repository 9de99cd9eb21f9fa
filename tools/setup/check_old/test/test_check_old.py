"""`make check-old`: its checkout follows this one, and a step passes by its exit code."""

from pathlib import Path

import pytest

from tools.setup.check_old import __main__ as command
from tools.setup.check_old.checkout import bring_up_to_date
from tools.setup.check_old.steps import Step
from tools.setup.layout import LOCK, OLD_LOCK, ROOT


def write(root: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text(text)


def test_the_second_checkout_follows_the_first_and_keeps_what_was_made_there(tmp_path: Path) -> None:
    lock, old_lock = str(LOCK.relative_to(ROOT)), str(OLD_LOCK.relative_to(ROOT))
    source, target = tmp_path / "source", tmp_path / "source" / "out" / "second"
    write(
        source, {"a.py": "1", "b/c.py": "2", lock: "new", old_lock: "old", ".venv/x": "3", "b/__pycache__/c.pyc": "4"}
    )
    bring_up_to_date(source, target)
    write(target, {".venv/y": "5", "b/__pycache__/d.compiled": "6"})
    write(source, {"a.py": "changed", "e.py": "7"})
    (source / "b" / "c.py").unlink()
    bring_up_to_date(source, target)
    found = {str(path.relative_to(target)): path.read_text() for path in target.rglob("*") if path.is_file()}
    assert found == {
        "a.py": "changed", "e.py": "7", lock: "old", old_lock: "old", ".venv/y": "5", "b/__pycache__/d.compiled": "6"
    }  # fmt: skip


@pytest.mark.parametrize("code", [0, 3, 7])
def test_a_step_passes_by_its_exit_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], code: int
) -> None:
    monkeypatch.setattr(command.checkout, "FOLDER", tmp_path)
    write(tmp_path, {"install/setup.bash": "word=something"})
    step = Step("a try", f"echo $word is wrong; exit {code}", codes=(0, 3))
    assert command._passes(step, tmp_path / "log") == (code != 7)
    assert ("something is wrong" in capsys.readouterr().out) == (code == 7)  # shown where it helps
    assert "something is wrong" in (tmp_path / "log").read_text()

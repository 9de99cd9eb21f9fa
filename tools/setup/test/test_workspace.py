"""What is amended before and after a linked build."""

from pathlib import Path

import pytest

from tools.setup import workspace


def test_scripts_run_in_a_path_with_a_space(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(workspace, "INSTALL", tmp_path)
    script = tmp_path / "nodes" / "lib" / "nodes" / "node"
    script.parent.mkdir(parents=True)
    script.write_text('#!"/a path/.venv/bin/python3"\nprint(1)\n')
    script.chmod(0o755)
    library = script.with_name("data.so")
    library.write_bytes(b"\x7fELF\n")

    workspace._free_scripts()

    assert script.read_text() == "#!/usr/bin/env python3\nprint(1)\n"
    assert script.stat().st_mode & 0o111
    assert library.read_bytes() == b"\x7fELF\n"


def test_links_to_a_file_that_is_gone_are_removed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("BUILD", "INSTALL"):
        monkeypatch.setattr(workspace, name, tmp_path / name)
        (tmp_path / name / "launch").mkdir(parents=True)
    (tmp_path / "kept").touch()
    for file in ("gone", "kept"):
        built = tmp_path / "BUILD" / "launch" / file
        built.symlink_to(tmp_path / file)
        (tmp_path / "INSTALL" / "launch" / file).symlink_to(built)

    workspace._remove_dead_links()

    assert [path.name for path in sorted(tmp_path.glob("*/launch/*"))] == ["kept", "kept"]

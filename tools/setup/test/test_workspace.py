"""What is amended after a linked build."""

from pathlib import Path

import pytest

from tools.setup import workspace


def test_scripts_run_in_a_path_with_a_space_and_dead_links_go(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    install = tmp_path / "in stall"
    script = install / "nodes" / "lib" / "nodes" / "node"
    script.parent.mkdir(parents=True)
    script.write_text(f'#!"{tmp_path}/.venv/bin/python3"\nprint(1)\n')
    script.chmod(0o755)
    library = install / "nodes" / "lib" / "nodes" / "data.so"
    library.write_bytes(b"\x7fELF\n")
    shared = install / "nodes" / "share" / "nodes" / "launch"
    shared.mkdir(parents=True)
    (shared / "gone.launch.xml").symlink_to(tmp_path / "gone")
    (shared / "kept.launch.xml").symlink_to(script)
    monkeypatch.setattr(workspace, "INSTALL", install)

    workspace._tidy()

    assert script.read_text() == "#!/usr/bin/env python3\nprint(1)\n"
    assert script.stat().st_mode & 0o111
    assert library.read_bytes() == b"\x7fELF\n"
    assert [path.name for path in shared.iterdir()] == ["kept.launch.xml"]

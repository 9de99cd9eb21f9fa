"""What makes the set-up build again, and what does not."""

from pathlib import Path

import pytest

from tools.setup import stamp


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A checkout of one message package and one Python package."""
    files = {
        "msgs/package.xml": "<package/>",
        "msgs/msg/One.msg": "int32 a",
        "nodes/package.xml": "<package/>",
        "nodes/setup.py": "setup()",
        "nodes/launch/one.launch.xml": "<launch/>",
        "nodes/nodes/__init__.py": "",
        "nodes/nodes/node.py": "a = 1",
        "nodes/test/test_node.py": "a = 1",
        "requirements.lock": "numpy==1",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.setattr(stamp, "LOCK", tmp_path / "requirements.lock")
    monkeypatch.setattr(stamp, "package_folders", lambda: [tmp_path / "msgs", tmp_path / "nodes"])
    return tmp_path


def stale_after(checkout: Path, name: str) -> set[str]:
    """The packages to build again once the file ``name`` has new content."""
    before = stamp.wanted()
    (checkout / name).parent.mkdir(exist_ok=True)
    (checkout / name).write_text("something else")
    after = stamp.wanted()
    return {package for package in after.packages if after.packages[package] != before.packages[package]}


@pytest.mark.parametrize("name", ["msgs/msg/One.msg", "msgs/msg/Two.msg", "msgs/package.xml"])
def test_any_change_of_a_message_package_builds_it(checkout: Path, name: str) -> None:
    assert stale_after(checkout, name) == {"msgs"}


@pytest.mark.parametrize(
    "name", ["nodes/setup.py", "nodes/package.xml", "nodes/launch/two.launch.xml", "nodes/nodes/effects/new.py"]
)
def test_a_change_of_what_is_installed_builds_a_python_package(checkout: Path, name: str) -> None:
    assert stale_after(checkout, name) == {"nodes"}


@pytest.mark.parametrize(
    "name", ["nodes/nodes/node.py", "nodes/nodes/new.py", "nodes/launch/one.launch.xml", "nodes/test/test_new.py"]
)
def test_code_tests_and_linked_files_need_no_build(checkout: Path, name: str) -> None:
    assert stale_after(checkout, name) == set()


def test_another_lock_makes_everything_again(checkout: Path) -> None:
    before = stamp.wanted().environment
    assert stale_after(checkout, "requirements.lock") == {"msgs", "nodes"}
    assert stamp.wanted().environment != before


def test_a_stamp_is_read_back_and_counts_only_while_its_products_are_there(
    checkout: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stamp, "BUILD", checkout / "build")
    monkeypatch.setattr(stamp, "STAMP", checkout / "build" / "stamp.json")
    monkeypatch.setattr(stamp, "INSTALL", checkout / "install")
    for name in ("msgs", "nodes"):
        manifest = checkout / "install" / name / "share" / name / "package.xml"
        manifest.parent.mkdir(parents=True)
        manifest.touch()
    (checkout / "install" / "setup.bash").touch()
    wanted = stamp.wanted()
    wanted.write()
    assert stamp.made() == wanted
    (checkout / "install" / "nodes" / "share" / "nodes" / "package.xml").unlink()
    assert stamp.made().packages.keys() == {"msgs"}
    (checkout / "build" / "stamp.json").write_text("{broken")
    assert stamp.made() == stamp.Stamp()

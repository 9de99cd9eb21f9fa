"""Files that commands write: folders are made, every file is announced, and an error leaves nothing behind."""

from pathlib import Path

import pytest
from command_line import Captured, code, refused

from continuum.errors import FileError
from continuum.output_files import check_page, check_writable, folder_of

MODEL_VALUES = ("--joints", 1, "--mass", 1, "--inertia", 0.1, "--center-of-mass", 0.1, "--link-length", 0.2)


def tree(folder: Path) -> set[Path]:
    return {path.relative_to(folder) for path in folder.rglob("*")}


@pytest.mark.parametrize("deep", ["a", "a/b/c"])
def test_folders_of_outputs_are_made_and_files_announced(capsys: Captured, tmp_path: Path, deep: str) -> None:
    folder = tmp_path / deep
    files = [folder / "one.csv", folder / "two" / "x.png"]
    assert code("simulate", "--duration", 0.05, "--csv", files[0], "--picture", files[1]) == 0
    assert code("model", "new", *MODEL_VALUES, "--out", folder / "three" / "arm.yaml") == 0
    written = [*files, folder / "three" / "arm.yaml"]
    assert all(file.stat().st_size > 0 for file in written)
    lines = capsys.readouterr().out.splitlines()
    assert [line for line in lines if line.startswith("written")] == [f"written: {file}" for file in written]


NEW = "{new}/a/"
CSV, PNG, JSON, YAML, HTML = (f"{NEW}x.{ending}" for ending in ("csv", "png", "json", "yaml", "html"))
FAULTS = [
    ("--release is 'much'", ("simulate", "--release", "much", "--csv", CSV, "--picture", PNG)),
    ("cannot be drawn", ("simulate", "--csv", CSV, "--picture", f"{NEW}x.unknown")),
    ("Not a directory", ("simulate", "--csv", CSV, "--picture", "{file}/b/x.png")),
    ("would be written twice", ("simulate", "--csv", PNG, "--picture", PNG)),
    ("would be overwritten", ("simulate", "--tensions", "{file}", "--csv", "{file}")),
    ("--pulled needs --release", ("simulate", "--pulled", "--csv", CSV)),
    ("mass", ("model", "new", *MODEL_VALUES, "--mass", "-1", "--out", YAML)),
    ("as a URDF", ("model", "from-urdf", "{file}", "--out", YAML)),
    ("is not a readable rosbag2 recording", ("report", "nowhere", "--arm", "three_sections", "--out", NEW)),
    ("Xsens", ("import-dot", "{file}", "--out", CSV, "--save-calibration", YAML)),
    ("0 usable rows", ("curvature", "{file}", "--csv", CSV, "--json", JSON)),
    ("0 usable rows", ("diagnose", "{file}", "--json", JSON, "--report", HTML, "--extended", YAML)),
    ("does not end in .html", ("diagnose", "{file}", "--json", JSON, "--report", f"{NEW}x.htm")),
    ("0 usable rows", ("identify", "{file}", "--out", YAML, "--report", HTML)),
    ("does not end in .html", ("identify", "{file}", "--out", YAML, "--report", f"{NEW}x")),
    ("--seed is 1; allowed: only with --method swarm", ("identify", "{file}", "--seed", 1, "--out", YAML)),
]


@pytest.mark.parametrize(("problem", "given"), FAULTS, ids=[" ".join((words[0], said)) for said, words in FAULTS])
def test_an_error_leaves_nothing_behind(
    capsys: Captured, tmp_path: Path, problem: str, given: tuple[object, ...]
) -> None:
    (tmp_path / "file").write_text("t_s,q1_deg\n", encoding="utf-8")
    names = {"new": tmp_path / "new", "file": tmp_path / "file"}
    assert problem in refused(capsys, *(str(word).format(**names) for word in given))
    assert tree(tmp_path) == {Path("file")}
    assert (tmp_path / "file").read_text(encoding="utf-8") == "t_s,q1_deg\n"


@pytest.mark.parametrize("command", ["diagnose", "identify"])
def test_a_report_that_is_no_page_is_refused_before_the_data_are_read(capsys: Captured, command: str) -> None:
    for name in ("report.pdf", "report", "html", ".html"):
        assert "does not end in .html" in refused(capsys, command, "nowhere.csv", "--report", name)
    assert "nowhere.csv" in refused(capsys, command, "nowhere.csv", "--report", "report.HTML")


def test_the_checks_change_nothing(tmp_path: Path) -> None:
    check_writable(tmp_path / "a" / "b" / "c.csv")
    check_page(tmp_path / "a" / "c.html")
    with pytest.raises(FileError, match="cannot be written"):
        check_writable(tmp_path / "a" / ("b" * 300) / "c.csv")
    assert tree(tmp_path) == set()


def test_a_folder_stays_where_something_was_written(tmp_path: Path) -> None:
    with folder_of(tmp_path / "a" / "b" / "c"):
        (tmp_path / "a" / "other").touch()
    assert tree(tmp_path) == {Path("a"), Path("a/other")}
    with pytest.raises(KeyboardInterrupt), folder_of(tmp_path / "d" / "e"):
        raise KeyboardInterrupt
    assert not (tmp_path / "d").exists()

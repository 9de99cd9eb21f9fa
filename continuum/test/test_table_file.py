"""One reader for tables, however another program wrote them."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from csv_runs import sway, text_of, write

from continuum.errors import FileError
from continuum.recordings.recording_csv import read_recording_csv
from continuum.recordings.tension_table import read_tension_table


@pytest.mark.parametrize(("separator", "decimal"), [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ",")])
@pytest.mark.parametrize("before", ["", "sep=,\n", "# of the bench\n\n", "Logger 2.1\nDate: 2026-01-01, noon\n"])
@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1"])
def test_a_table_says_the_same_however_it_was_written(
    tmp_path: Path, separator: str, decimal: str, before: str, encoding: str
) -> None:
    wanted = read_recording_csv(write(tmp_path, sway()))
    rows = [line.split(",") for line in text_of(sway()).splitlines()]
    text = "".join(separator.join(cell.replace(".", decimal) for cell in row) + "\n" for row in rows)
    path = tmp_path / "other.csv"
    path.write_bytes(f"{before.replace('sep=,', 'sep=' + separator)}{text}".encode(encoding))
    found = read_recording_csv(path)
    np.testing.assert_array_equal(found.times, wanted.times)
    np.testing.assert_array_equal(found.theta, wanted.theta)
    np.testing.assert_array_equal(found.pull.values, wanted.pull.values)


def test_joints_counted_from_0_are_the_same_and_it_is_told(tmp_path: Path) -> None:
    wanted = read_recording_csv(write(tmp_path, sway()))
    names = {"q1_rad": "q0_rad", "q2_rad": "q1_rad", "dq1_rad_s": "dq0_rad_s", "dq2_rad_s": "dq1_rad_s"}
    found = read_recording_csv(write(tmp_path, {names.get(name, name): column for name, column in sway().items()}))
    np.testing.assert_array_equal(found.theta, wanted.theta)
    np.testing.assert_array_equal(found.theta_rate, wanted.theta_rate)
    assert len([note for note in found.notes if "count from 0" in note]) == 2


def test_angles_that_wrap_at_360_degrees_are_refused_in_their_unit(tmp_path: Path) -> None:
    wrapped = {name: column for name, column in sway().items() if name.startswith(("t_", "u"))}
    for joint in (1, 2):
        wrapped[f"q{joint}_deg"] = [f"{np.degrees(float(cell)) % 360:.4f}" for cell in sway()[f"q{joint}_rad"]]
    with pytest.raises(FileError, match=r"3\d\d.* degrees.* wrap at 360"):
        read_recording_csv(write(tmp_path, wrapped))


def test_a_table_of_a_million_columns_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "wide.csv"
    path.write_text("t_s," + ",".join(f"c{k}" for k in range(1_000_000)) + "\n")
    with pytest.raises(FileError, match="columns"):
        read_recording_csv(path)


@pytest.mark.parametrize(
    "written",
    [
        lambda text: text.replace("\n", "\r"),
        lambda text: text.replace("\n", "\r\n"),
        lambda text: "# " + text,
        lambda text: 'tube of 5" \u2026\n' + text,
        lambda text: '"two\nlines"\n' + text,
        lambda text: "page 1\x0c\n" + text,
    ],
    ids=["old Mac", "Windows", "savetxt", "quote and dots", "two lines", "form feed"],
)
def test_line_ends_and_remarks_do_not_move_the_heading(tmp_path: Path, written: Callable[[str], str]) -> None:
    wanted = read_recording_csv(write(tmp_path, sway()))
    path = tmp_path / "other.csv"
    path.write_bytes(written(text_of(sway())).encode("cp1252"))
    np.testing.assert_array_equal(read_recording_csv(path).theta, wanted.theta)


def test_decimal_commas_between_commas_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "tensions.csv"
    path.write_text("t_s,u1_N,u2_N\n0,12,5,0,0\n1,13,5,0,0\n")
    with pytest.raises(FileError, match="row 2 has 5 cells, the header 3; decimal commas"):
        read_tension_table(path)

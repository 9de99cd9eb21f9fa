"""One reader for tables, however another program wrote them."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from csv_runs import sway, text_of, write

from continuum.errors import FileError
from continuum.inertial.dot_export import read_dot_export
from continuum.recordings.input_table import read_tension_table
from continuum.recordings.recording_csv import read_recording_csv


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


def test_joints_counted_from_0_are_the_same_and_it_is_reported(tmp_path: Path) -> None:
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
        lambda text: "# t_s, and angles, rates and tensions\n" + text,
    ],
    ids=["old Mac", "Windows", "savetxt", "quote and dots", "two lines", "form feed", "names twice"],
)
def test_line_ends_and_remarks_do_not_move_the_heading(tmp_path: Path, written: Callable[[str], str]) -> None:
    wanted = read_recording_csv(write(tmp_path, sway()))
    path = tmp_path / "other.csv"
    path.write_bytes(written(text_of(sway())).encode("cp1252"))
    np.testing.assert_array_equal(read_recording_csv(path).theta, wanted.theta)


def with_every_line(change: Callable[[str], str], heading: str, text: str) -> str:
    """A table with another heading and other rows."""
    first, *rows = text.splitlines()
    return "".join(line + "\n" for line in [heading.replace("HEADING", first), *map(change, rows)])


@pytest.mark.parametrize(
    ("heading", "row"),
    [("HEADING", "{},"), ("HEADING,", "{}"), ("HEADING,,", "{},,"), (",HEADING", "7,{}"), (",HEADING,", "7,{},")],
)
def test_cells_without_a_name_and_a_value_at_the_end_are_none(tmp_path: Path, heading: str, row: str) -> None:
    path = tmp_path / "other.csv"
    path.write_text(with_every_line(row.format, heading, text_of(sway())))
    found = read_recording_csv(path)
    np.testing.assert_array_equal(found.theta, read_recording_csv(write(tmp_path, sway())).theta)
    assert len(found.notes) == row.startswith("7")  # a column of numbers without a name is noted


def test_the_heading_may_stand_below_any_number_of_remarks(tmp_path: Path) -> None:
    path = tmp_path / "other.csv"
    path.write_text("a remark\n" * 300 + text_of(sway()))
    np.testing.assert_array_equal(read_recording_csv(path).theta, read_recording_csv(write(tmp_path, sway())).theta)


@pytest.mark.parametrize("missing", ["#N/A", "NA", "n/a", "null", "None", "<NA>", "NaN", ""])
def test_cells_by_which_programs_say_that_there_is_no_value(tmp_path: Path, missing: str) -> None:
    table = sway()
    table["q2_rad"][5] = missing
    found = read_recording_csv(write(tmp_path, table))
    np.testing.assert_array_equal(found.times, np.delete(read_recording_csv(write(tmp_path, sway())).times, 5))
    assert len(found.notes) == 1


READERS = (read_recording_csv, read_tension_table, read_dot_export)


@pytest.mark.parametrize("read", READERS)
@pytest.mark.parametrize(
    ("text", "output"),
    [
        ("KEY u1_N\n0 1\n", "row 1 is 'KEY u1_N'; commas, semicolons or tabs"),
        ("KEY|u1_N\n0|1\n", "row 1 is 'KEY|u1_N'; commas, semicolons or tabs"),
        ("0,1,2\n1,2,3\n", "row 1 holds numbers; .*: KEY"),
        ("LabVIEW Measurement\t\nA\tB\tC\n1\t2\t3\n", "has no column KEY; row 1 has LabVIEW Measurement"),
        ('{"KEY": [0, 1], "u1_N": [0, 1]}\n', "has no column KEY; row 1 has"),
        ("KEY,u1_N\n0;1\n", "row 2 has 1 cells, the header 2: '0;1'"),
        ("KEY,u1_N\n0,1\n# released\n", "row 3 has 1 cells, the header 2: '# released'"),
        ("K\0E\0Y\0,\0", "is not a text file"),
        ("KEY,u1_N\n0,1\nKEY,u1_N\n0,1\n", "row 3 is a header again; are these two recordings"),
        ("sep=,\n\nKEY,u1_N\n0,1\nsep=,\n\nKEY,u1_N\n", "row 7 is a header again; are these two recordings"),
    ],
)
def test_what_is_no_table_is_refused_alike_by_all_readers(
    tmp_path: Path, read: Callable[[Path], object], text: str, output: str
) -> None:
    key = "SampleTimeFine" if read is read_dot_export else "t_s"
    path = tmp_path / "other.csv"
    path.write_text(text.replace("KEY", key))
    with pytest.raises(FileError, match=output.replace("KEY", key).replace("|", r"\|")):
        read(path)


@pytest.mark.parametrize("cell", ["1_0.5", "0,5"])
def test_cells_that_python_or_another_country_reads_otherwise_are_refused(tmp_path: Path, cell: str) -> None:
    table = sway()
    table["q2_rad"][5] = f'"{cell}"'
    with pytest.raises(FileError, match=f"row 7, column q2_rad: '{cell}' is not a number"):
        read_recording_csv(write(tmp_path, table))
    path = tmp_path / "tensions.csv"
    path.write_text(f't_s,u1_N,u2_N\n0,"{cell}",0\n')
    with pytest.raises(FileError, match=f"row 2: u1_N is '{cell}'"):
        read_tension_table(path)


def test_decimal_commas_between_commas_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "tensions.csv"
    path.write_text("t_s,u1_N,u2_N\n0,12,5,0,0\n1,13,5,0,0\n")
    with pytest.raises(FileError, match="row 2 has 5 cells, the header 3; decimal commas"):
        read_tension_table(path)


@pytest.mark.parametrize(("unit", "factor"), [("milliseconds", 1e3), ("microseconds", 1e6), ("nanoseconds", 1e9)])
@pytest.mark.parametrize("begun", [0, 1_700_000_000])
def test_times_in_a_smaller_unit_are_refused_and_the_unit_is_named(
    tmp_path: Path, unit: str, factor: float, begun: int
) -> None:
    table = sway()
    table["t_s"] = [str(round(factor * (begun + float(t)))) for t in table["t_s"]]
    with pytest.raises(FileError, match=f"is the time in {unit}"):
        read_recording_csv(write(tmp_path, table))
    path = tmp_path / "tensions.csv"
    path.write_text(f"t_s,u1_N,u2_N\n{table['t_s'][0]},0,0\n{table['t_s'][-1]},5,0\n")
    if begun:
        with pytest.raises(FileError, match=f"row 2: t_s is .*; allowed: seconds; .*{unit}"):
            read_tension_table(path)


@pytest.mark.parametrize("begun", [1e3, 5e4, 1.7e9])
def test_tensions_of_a_clock_count_from_the_first_row(tmp_path: Path, begun: float) -> None:
    path = tmp_path / "tensions.csv"
    path.write_text(f"t_s,u1_N,u2_N\n{begun},0,0\n{begun + 1},5,0\n")
    np.testing.assert_allclose(read_tension_table(path).times, [0, 1])


@pytest.mark.parametrize("more", ["u3_N", "u0_N", "u1_kN"])
def test_no_tension_is_left_out_silently(tmp_path: Path, more: str) -> None:
    path = tmp_path / "tensions.csv"
    path.write_text(f"t_s,u1_N,u2_N,{more}\n0,0,0,5\n1,0,0,5\n")
    with pytest.raises(FileError, match=f"has {more}"):
        read_tension_table(path)

"""Recordings from CSV: what is read back, repaired with a note, or refused by row. The header is row 1."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from csv_runs import ANGLES, PULL, RATES, ROWS, Cells, T, cells, sway, text_of, write
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from identification_laws import PULLS, small_simulator

from continuum.dynamics.trajectory import Trajectory
from continuum.errors import FileError
from continuum.recordings.motion_table import write_motion_table
from continuum.recordings.recording_csv import read_recording_csv


def without(table: Cells, *names: str) -> Cells:
    return {name: column for name, column in table.items() if name not in names}


def renamed(table: Cells, **names: str) -> Cells:
    return {names.get(name, name): column for name, column in table.items()}


@pytest.mark.parametrize("unit", ["deg", "rad"])
def test_what_was_written_is_read(tmp_path: Path, unit: str) -> None:
    found = read_recording_csv(write(tmp_path, sway(unit)))
    assert (found.name, found.notes, found.is_driven) == ("swing 7", (), True)
    np.testing.assert_array_equal(found.times, T)
    np.testing.assert_allclose(found.theta, ANGLES, rtol=1e-14, atol=1e-15)
    np.testing.assert_allclose(found.theta_rate, RATES, rtol=1e-14, atol=1e-15)
    np.testing.assert_array_equal(found.pull.values, PULL)
    np.testing.assert_array_equal(found.pull.times, T)


def test_angles_alone_are_a_free_run(tmp_path: Path) -> None:
    found = read_recording_csv(write(tmp_path, without(sway(), "dq1_rad_s", "dq2_rad_s", "u1_N", "u2_N")))
    assert (found.theta_rate, found.tensions, found.is_driven) == (None, None, False)


def test_columns_that_are_not_understood_are_reported_and_need_not_hold_numbers(tmp_path: Path) -> None:
    found = read_recording_csv(write(tmp_path, sway() | {"q3deg": sway()["q2_rad"], "comment": ["let go"] * ROWS}))
    assert found.notes == ("unknown columns, not used: q3deg, comment",)


def test_units_may_differ_from_column_to_column(tmp_path: Path) -> None:
    table = sway("rad") | {"q2_deg": sway("deg")["q2_deg"]}
    found = read_recording_csv(write(tmp_path, without(table, "q2_rad")))
    np.testing.assert_allclose(found.theta, ANGLES, rtol=1e-14, atol=1e-15)


def test_a_simulated_motion_is_read_as_written(tmp_path: Path) -> None:
    simulator = small_simulator()
    motion: Trajectory = simulator.run(np.array([0.3, 0.2]), T, PULLS)
    write_motion_table(motion, PULLS, tmp_path / "motion.csv")
    found = read_recording_csv(tmp_path / "motion.csv")
    np.testing.assert_allclose(found.times, motion.times, rtol=0, atol=1e-9)
    np.testing.assert_allclose(found.theta, motion.theta, rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(found.theta_rate, motion.theta_rate, rtol=1e-8, atol=1e-10)
    np.testing.assert_allclose(found.pull.values, [PULLS.at(t) for t in T], rtol=1e-8)


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace(",", " , "),
        lambda text: text.replace("\n", "\n\n"),
        lambda text: "\n\n" + text + "\n,,,,,,\n\n",
        lambda text: '"' + text.replace(",", '","').replace("\n", '"\n"').removesuffix('"'),
    ],
    ids=["spaces", "every second line blank", "blank lines around", "quotes"],
)
def test_how_a_table_is_laid_out_does_not_matter(tmp_path: Path, change: Callable[[str], str]) -> None:
    found = read_recording_csv(write(tmp_path, change(text_of(sway()))))
    assert found.notes == ()
    np.testing.assert_array_equal(found.theta, ANGLES)


def test_rows_are_counted_as_in_the_file_blank_lines_included(tmp_path: Path) -> None:
    table = sway()
    table["q1_rad"][10] = "abc"
    lines = text_of(table).split("\n")
    with pytest.raises(FileError, match="row 12, column q1_rad: 'abc' is not a number"):
        read_recording_csv(write(tmp_path, "\n".join(lines)))
    with pytest.raises(FileError, match="row 15, column q1_rad: 'abc' is not a number"):
        read_recording_csv(write(tmp_path, "\n".join(["", *lines[:4], "", " ", *lines[4:]])))


@pytest.mark.parametrize("cell", ["", "nan", "-INF"])
@pytest.mark.parametrize("column", ["t_s", "u2_N"])
def test_rows_that_are_not_whole_are_left_out_and_reported(tmp_path: Path, cell: str, column: str) -> None:
    table = sway()
    for row in (4, 70):
        table[column][row] = cell
    found = read_recording_csv(write(tmp_path, table))
    assert found.notes == ("rows 6, 72 without a finite value in every column, left out",)
    np.testing.assert_array_equal(found.theta, np.delete(ANGLES, (4, 70), axis=0))


@pytest.mark.parametrize("later", [0.0, 1e-12])
def test_a_repeated_time_is_left_out_and_reported(tmp_path: Path, later: float) -> None:
    table = sway()
    table["t_s"][9] = repr(float(table["t_s"][8]) + later)
    found = read_recording_csv(write(tmp_path, table))
    assert found.notes == ("row 11 with the time of the row before, left out",)
    np.testing.assert_array_equal(found.times, np.delete(T, 9))


def test_rates_at_the_end_of_their_range_are_left_out_and_reported(tmp_path: Path) -> None:
    table = sway()
    table["dq1_rad_s"] = [repr(float(value)) for value in np.clip(RATES[:, 0], -1.75, 3.0)]
    clipped = np.flatnonzero(RATES[:, 0] < -1.75)
    assert 3 <= clipped.size <= ROWS / 10
    found = read_recording_csv(write(tmp_path, table))
    output = ", ".join(str(row + 2) for row in clipped[:8]) + (", .." if clipped.size > 8 else "")
    assert found.notes == (f"rows {output} with a clipped rate, left out",)
    np.testing.assert_array_equal(found.times, np.delete(T, clipped))


@pytest.mark.parametrize("value", ["0.0", "0.25"])
def test_rates_that_never_change_were_not_measured(tmp_path: Path, value: str) -> None:
    table = sway()
    table["dq2_rad_s"] = [value] * ROWS
    with pytest.raises(FileError, match=r"joint 2: its rate is .* throughout while its angle changes"):
        read_recording_csv(write(tmp_path, table))
    table["dq1_rad_s"] = [value] * ROWS
    found = read_recording_csv(write(tmp_path, table))
    assert found.theta_rate is None
    assert len(found.notes) == 1
    np.testing.assert_array_equal(found.theta, ANGLES)


@pytest.mark.parametrize("every", [2, 4])
def test_rows_between_readings_of_a_slower_sensor_are_left_out_and_counted(tmp_path: Path, every: int) -> None:
    read = np.arange(ROWS) // every * every
    table = sway()
    for name in ("q1_rad", "q2_rad", "dq1_rad_s", "dq2_rad_s"):
        table[name] = [table[name][row] for row in read]
    found = read_recording_csv(write(tmp_path, table))
    np.testing.assert_array_equal(found.theta, ANGLES[::every])
    np.testing.assert_array_equal(found.times, T[::every])
    assert [note for note in found.notes if note.startswith(f"{ROWS - ROWS // every} rows repeat")]


def test_an_arm_at_rest_is_kept(tmp_path: Path) -> None:
    table = sway()
    for name in ("q1_rad", "q2_rad"):
        table[name] = [table[name][0]] * 60 + table[name][60:]
    assert read_recording_csv(write(tmp_path, table)).times.size == ROWS


def test_a_rate_in_coarse_steps_is_not_taken_for_a_clipped_one(tmp_path: Path) -> None:
    table = sway()
    table["dq1_rad_s"] = [f"{value:.1f}" for value in RATES[:, 0]]
    found = read_recording_csv(write(tmp_path, table))
    assert (found.notes, found.times.size) == ((), ROWS)


def changed(column: str, rows: slice, values: str | Callable[[float], float]) -> Cells:
    """The sway with some cells of one column changed."""
    table = sway()
    at = range(ROWS)[rows]
    for i in at:
        table[column][i] = values if isinstance(values, str) else repr(float(values(float(table[column][i]))))
    return table


@pytest.mark.parametrize(
    ("table", "message"),
    [
        (changed("t_s", slice(50, None), lambda t: t - 0.3), "row 52: time runs backward, to 0.116667 s; are these"),
        (changed("t_s", slice(50, None), lambda t: t + 0.3), "rows 51 to 52: a gap of 0.308 s"),
        (changed("u2_N", slice(33, 63), "1e300"), r"row 35, u2: a tension of 1e\+300 N; .*: another unit"),
        (changed("q1_rad", slice(None), np.degrees), "row .*: a joint angle of 17.2 rad; .* degrees taken for"),
        (changed("q2_rad", slice(2, 30), ""), r"has 28 bad rows of 120; at most a tenth .* 10, 11, \.\. without"),
        (changed("dq1_rad_s", slice(None), np.degrees), "joint 1: its rate is 57.* times .* mixed"),
        (changed("dq2_rad_s", slice(None), np.radians), "joint 2: its rate is 0.017.* times .* mixed"),
        (changed("dq2_rad_s", slice(None), np.negative), "joint 2: its rate is negative where its angle grows"),
        (changed("q1_rad", slice(40, 60), "5.2"), "row 42, q1: a joint angle of 5.2 rad; no joint turns by more"),
        (changed("dq2_rad_s", slice(None), lambda rate: 500 * rate), "row 2, dq2: a joint rate of 505 rad/s"),
        (renamed(sway(), q1_rad="q1_deg", q2_rad="q2_deg"), "no joint angle above 0.3 degrees: radians taken for"),
        (cells(q1_rad=0.2 + 0.0 * T, q2_rad=0.1 + 1e-3 * np.sin(9 * T)), "joints that move by at most 0.11 degrees"),
        (without(sway(), "t_s"), "has no column t_s; row 1 has q1_rad, q2_rad"),
        (without(sway(), "q1_rad"), "has q of 2: numbers must run from 1 without a gap"),
        (without(sway(), "q1_rad", "q2_rad"), "has no joint angles q1_deg .. or q1_rad"),
        (without(sway(), "dq2_rad_s"), "has 2 joint angles but 1 joint rates"),
        (without(sway(), "u2_N"), "has tensions of 1 cables; a planar section has u1_N and u2_N"),
        (renamed(sway(), q2_rad="q2"), "has the column q2; allowed units of q: deg, rad"),
        (renamed(sway(), dq2_rad_s="dq2_rad"), "has the column dq2_rad; allowed units of dq: deg_s, rad_s"),
        (renamed(sway(), u1_N="u1_mN"), "has the column u1_mN; allowed units of u: N"),
        (sway() | {"q1_deg": sway()["q1_rad"]}, "has q1 twice, in two units"),
        (
            without(sway(), "q1_rad") | {"q1rad": sway()["q1_rad"]},
            "has q of 2: numbers must run from 1 without a gap; unknown: q1rad",
        ),
        ({name: column[:20] for name, column in sway().items()}, "has 20 usable rows; at least 30 are needed"),
        (text_of(sway()).replace("dq1_rad_s", "q1_rad"), "has the column 'q1_rad' twice"),
        ("", "is empty"),
        ("t_s,q1_deg\n", "has 0 usable rows"),
    ],
)  # fmt: skip
def test_what_cannot_be_repaired_is_refused(tmp_path: Path, table: Cells | str, message: str) -> None:
    path = write(tmp_path, table)
    with pytest.raises(FileError, match="^" + re.escape(str(path)) + f": .*{message}"):
        read_recording_csv(path)


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(FileError, match=r"none\.csv: cannot be read: No such file"):
        read_recording_csv(tmp_path / "none.csv")
    with pytest.raises(FileError, match="cannot be read: Is a directory"):
        read_recording_csv(tmp_path)


NUMBERS = st.floats(width=64).map(repr) | st.integers(-(10**30), 10**30).map(str)
NAMES = st.sampled_from(["t_s", "q1_deg", "q1_rad", "q2_deg", "dq1_deg_s", "u1_N", "u2_N", "note", "", "q1", "q99_x"])


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    column=st.sampled_from(list(sway())),
    rows=st.lists(st.integers(0, ROWS - 1), min_size=1, max_size=5),
    cell=NUMBERS | st.text(max_size=8),
)
@example(column="dq1_rad_s", rows=[3], cell="1e308")
@example(column="t_s", rows=[0], cell="-1e308")
@example(column="q1_rad", rows=[119], cell="\x00")
def test_any_cell_is_read_repaired_or_refused(tmp_path: Path, column: str, rows: list[int], cell: str) -> None:
    table = sway()
    for row in rows:
        table[column][row] = cell
    path = tmp_path / "run.csv"
    path.write_text(text_of(table), encoding="utf-8", errors="surrogatepass", newline="")
    try:
        found = read_recording_csv(path)
    except FileError:
        return
    assert np.all(np.isfinite(found.theta))
    assert np.all(np.diff(found.times) > 0)


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(header=st.lists(NAMES | st.text(max_size=6), min_size=1, max_size=7), data=st.data())
def test_any_table_is_read_or_refused(tmp_path: Path, header: list[str], data: st.DataObject) -> None:
    column = st.lists(st.floats(-1, 1), min_size=40, max_size=40)
    columns = [sorted(column_) if name == "t_s" else column_ for name in header for column_ in [data.draw(column)]]
    lines = [",".join(header), *(",".join(map(repr, row)) for row in zip(*columns, strict=True))]
    path = tmp_path / "run.csv"
    path.write_text("\n".join(lines), encoding="utf-8", errors="surrogatepass", newline="")
    try:
        found = read_recording_csv(path)
    except FileError:
        return
    assert found.n_joints >= 1
    assert found.times.size >= 30

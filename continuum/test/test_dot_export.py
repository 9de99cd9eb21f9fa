"""The vendor's files of one sensor each: what is read of them, and how they come to one clock."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from inertial_arm import TAGS, SensorModel, pull_and_release, sensed, with_losses, write_exports

from continuum.errors import FileError, MeasurementError
from continuum.inertial.common_clock import on_one_clock
from continuum.inertial.dot_export import WRAP, DotExport, read_dot_export
from continuum.inertial.imu_recording import ImuRecording

STORED = 120.0


@pytest.fixture(scope="module")
def recording() -> ImuRecording:
    return sensed(pull_and_release(), STORED, SensorModel(), seed=3)[0]


@pytest.fixture
def short(recording: ImuRecording) -> ImuRecording:
    return recording.part(0.0, 1.0)


def test_a_file_gives_what_the_sensor_read(tmp_path: Path, short: ImuRecording) -> None:
    clipped = short.clipped.copy()
    clipped[7, 0] = True
    found = [read_dot_export(path) for path in write_exports(tmp_path, replace(short, clipped=clipped))]
    assert [export.tag for export in found] == list(TAGS)
    for i, export in enumerate(found):
        np.testing.assert_allclose(export.rates, short.rates[:, i], atol=1e-12)
        np.testing.assert_allclose(export.forces, short.forces[:, i], atol=1e-12)
        np.testing.assert_allclose(np.diff(export.ticks), 1e6 / STORED, atol=1)
        assert np.flatnonzero(export.clipped).tolist() == ([7] if i == 0 else [])
        assert export.notes == ()


def test_time_goes_on_where_the_clock_begins_again(tmp_path: Path, short: ImuRecording) -> None:
    plain = on_one_clock([read_dot_export(path) for path in write_exports(tmp_path, short)])
    lost = np.zeros(short.valid.shape, dtype=bool)
    lost[:80, 2] = True  # it starts after the others, when its clock has begun again
    wrapped = [read_dot_export(path) for path in write_exports(tmp_path, with_losses(short, lost), WRAP - 500_000)]
    found = on_one_clock(wrapped)
    for i, (before, after) in enumerate(zip(plain, found, strict=True)):
        np.testing.assert_allclose(after.times, before.times[80 if i == 2 else 0 :], atol=2e-6)


def test_starts_far_apart_are_refused(tmp_path: Path, short: ImuRecording) -> None:
    found = [read_dot_export(path) for path in write_exports(tmp_path, short)]
    found[3] = replace(found[3], ticks=found[3].ticks + 3_000_000_000)
    with pytest.raises(MeasurementError, match="not synchronised, or another test"):
        on_one_clock(found)


HEAD = "sep=,\nDeviceTag:,joint 1\nStartTime: ,x\n\n"
COLUMNS = "PacketCounter,SampleTimeFine,Gyr_X,Gyr_Y,Gyr_Z,Acc_X,Acc_Y,Acc_Z"


def parsed(folder: Path, text: str, encoding: str = "utf-8") -> DotExport:
    path = folder / "one.csv"
    path.write_bytes(text.encode(encoding))
    return read_dot_export(path)


def test_columns_in_any_order_other_columns_and_other_separators(tmp_path: Path) -> None:
    row = "4,100,1,2,3,4,5,6"
    for text in (
        f"{HEAD}{COLUMNS}\n{row}\n",
        f"{HEAD}Euler_X,{COLUMNS}\n7,{row}\n",
        f"{COLUMNS}\n{row}",
        f"{HEAD}{COLUMNS}\r\n\r\n{row}\r\n,,,\r\n".replace("\n", "\r\n").replace("\r\r", "\r"),
        f"{HEAD}{COLUMNS}\n{row}\n".replace(",", ";"),
    ):
        found = parsed(tmp_path, text)
        np.testing.assert_allclose(np.degrees(found.rates), [[1, 2, 3]])
        np.testing.assert_allclose(found.forces, [[4, 5, 6]])
    assert parsed(tmp_path, f"{HEAD}\xa9 the vendor\n{COLUMNS}\n{row}\n", "latin-1").tag == "joint 1"


@pytest.mark.parametrize(
    ("extra", "clips"),
    [("Status", {0: False, 1: True, 8: True, 0x20: True, 0x40: False, 0x100: False, 0x200: False, 0x210: True}),
     ("ClipCountAcc", {0: False, 1: True, 255: True}), ("ClipCountGyr", {0: False, 3: True})],
)  # fmt: skip
def test_clips_by_the_vendors_flags(tmp_path: Path, extra: str, clips: dict[int, bool]) -> None:
    rows = [f"{k},{100 * k},1,2,3,4,5,6,{value}" for k, value in enumerate(clips)]
    found = parsed(tmp_path, "\n".join([COLUMNS + "," + extra, *rows]))
    assert found.clipped.tolist() == list(clips.values())


def test_empty_and_repeated_rows_are_left_out_and_reported(tmp_path: Path) -> None:
    rows = ["0,100,0,0,0,0,0,0", "1,200,1,1,1,1,1,1", "2,200,2,2,2,2,2,2", "3,300,3,3,3,3,3,3"]
    found = parsed(tmp_path, "\n".join([COLUMNS, *rows]))
    assert found.ticks.tolist() == [200, 300]
    assert found.notes == (
        "1 row of nothing but zeros, left out (first: row 2)",
        "1 row with the time of the row before, left out (first: row 4)",
    )


@pytest.mark.parametrize(
    ("text", "output"),
    [
        ("", "is empty"),
        (HEAD + COLUMNS.replace("Gyr_Y", "Mag_Y"), "has no column Gyr_Y: choose them at the export"),
        (HEAD + COLUMNS, "has no rows"),
        (f"{COLUMNS},Gyr_X\n1,2,3,4,5,6,7,8,9", "has the column Gyr_X twice"),
        (f"{COLUMNS}\n1,2,3,x,5,6,7,8", "row 2, column Gyr_Y: 'x' is not a number"),
        (f"{COLUMNS}\n1,2,3,,5,6,7,8", "row 2, column Gyr_Y: '' is not a number"),
        (f"{COLUMNS}\n1,2,3,nan,5,6,7,8", "'nan' is not a number"),
        (f"{COLUMNS}\n1,-2,3,4,5,6,7,8", "SampleTimeFine is -2"),
        (f"{COLUMNS}\n1,2.5,3,4,5,6,7,8", "SampleTimeFine is 2.5"),
        (f"{COLUMNS}\n1,4294967296,3,4,5,6,7,8", "SampleTimeFine is 4.29497e\\+09"),
        (f"{COLUMNS}\n1,900,3,4,5,6,7,8\n2,100,3,4,5,6,7,8", "row 3: time jumps by -0.0008 s; are these two"),
        (f"{COLUMNS}\n1,900,3,4,5,6,7,8\n2,900000000,3,4,5,6,7,8", "row 3: time jumps by 899.999 s"),
        (f"{COLUMNS}\n1,9,3,4,5,6,7,8\n\n3,\"", "no number|cells|cannot be read"),
    ],
)  # fmt: skip
def test_damaged_files_are_refused_by_row(tmp_path: Path, text: str, output: str) -> None:
    with pytest.raises(FileError, match=output):
        parsed(tmp_path, text)


GOOD = "\n".join([HEAD + COLUMNS, *(f"{k},{8333 * k},1.5,2,3,4,5,9.81" for k in range(5))])


@settings(max_examples=300)
@given(st.data())
def test_whatever_is_in_a_file_it_is_read_or_refused(
    tmp_path_factory: pytest.TempPathFactory, data: st.DataObject
) -> None:
    at = data.draw(st.integers(0, len(GOOD)))
    length = data.draw(st.integers(0, 40))
    text = GOOD[:at] + data.draw(st.text(max_size=30)) + GOOD[at + length :]
    path = tmp_path_factory.getbasetemp() / "damaged.csv"
    path.write_bytes(text.encode("utf-8", errors="surrogatepass"))
    try:
        found = read_dot_export(path)
    except FileError as error:
        assert str(path) in str(error)  # noqa: PT017  (either outcome is right)
    else:
        assert np.isfinite(found.rates).all()
        assert np.isfinite(found.forces).all()
        assert (np.diff(found.ticks) > 0).all()


def table(ticks: np.ndarray, header: str = "", separator: str = ",", decimal: str = ".") -> str:
    rows = [[str(int(t)), *(str(0.5 + k).replace(".", decimal) for k in range(6))] for t in ticks]
    names = ["SampleTimeFine", "Gyr_X", "Gyr_Y", "Gyr_Z", "Acc_X", "Acc_Y", "Acc_Z"]
    return header + "".join(separator.join(cells) + "\n" for cells in [names, *rows])


@given(
    rate=st.sampled_from([10, 12, 15, 20, 30, 60, 120]),
    unit=st.sampled_from([1, 100]),
    form=st.sampled_from([(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ",")]),
    lost=st.lists(st.integers(1, 58), max_size=5),
    one_line=st.booleans(),
)
def test_every_unit_separator_and_header_gives_the_same_times(
    tmp_path_factory: pytest.TempPathFactory,
    rate: int,
    unit: int,
    form: tuple[str, str],
    lost: list[int],
    one_line: bool,
) -> None:
    times = np.delete(np.arange(60) / rate, lost)
    separator, decimal = form
    head = {"DeviceTag": "one", "OutputRate": f"{rate}Hz"}
    header = (
        separator.join(f"{name}: {value}" for name, value in head.items()) + "\n"
        if one_line
        else "".join(f"{name}:{separator}{value}\n" for name, value in head.items())
    )
    found = parsed(
        tmp_path_factory.mktemp("dot"), table(np.rint(times * 1e6 / unit) + 5000, header, separator, decimal)
    )
    assert found.tag == "one"
    np.testing.assert_allclose((found.ticks - found.ticks[0]) / 1e6, times, atol=1.1e-6 * unit)
    np.testing.assert_allclose(np.degrees(found.rates[0]), [0.5, 1.5, 2.5])


@pytest.mark.parametrize(
    ("step", "header", "figures"),
    [
        (1e6 / 60, "OutputRate:,30Hz\n", ("60", "30")),  # the header says otherwise
        (1e4 / 60, "", ("6000", "60")),  # of the SDK, and nothing says so
        (1e6 / 50, "", ("50", "60")),  # no rate of such a sensor
    ],
)
def test_stamps_that_cannot_be_the_sensor_s_are_refused_with_both_figures(
    tmp_path: Path, step: float, header: str, figures: tuple[str, str]
) -> None:
    with pytest.raises(FileError) as error:
        parsed(tmp_path, table(np.rint(np.arange(60) * step), header))
    assert all(figure in str(error.value) for figure in figures)


@pytest.mark.parametrize("digits", [5, 6])
def test_stamps_rounded_by_a_float_format_are_refused(tmp_path: Path, digits: int) -> None:
    stamps = np.array([float(f"{3.343e9 + k * 1e6 / 60:.{digits}g}") for k in range(120)])
    with pytest.raises(FileError, match="SampleTimeFine"):
        parsed(tmp_path, table(stamps, "OutputRate:,60Hz\n"))


@pytest.mark.parametrize("rate", [50, 100, 6000])
@pytest.mark.parametrize("unit", [1, 100])
def test_rates_that_no_such_sensor_has_are_refused_though_header_and_stamps_agree(
    tmp_path: Path, rate: int, unit: int
) -> None:
    with pytest.raises(FileError, match=f"OutputRate is {rate}; a DOT stores"):
        parsed(tmp_path, table(np.rint(np.arange(60) * 1e6 / rate / unit), f"OutputRate:,{rate}Hz\n"))


@pytest.mark.parametrize(
    ("status", "notes"), [("Synced", 0), ("synced", 0), ("Un-synced", 1), ("Not Synchronized", 1), ("Unknown", 1)]
)
def test_whatever_is_not_synced_is_reported(tmp_path: Path, status: str, notes: int) -> None:
    found = parsed(tmp_path, table(np.rint(np.arange(60) * 1e6 / 60), f"SyncStatus:,{status}\n"))
    assert len([note for note in found.notes if status in note]) == notes


def test_accelerations_in_multiples_of_gravity_are_refused(tmp_path: Path, short: ImuRecording) -> None:
    (path, *_) = write_exports(tmp_path, replace(short, forces=short.forces / 9.81))
    with pytest.raises(FileError, match=r"Acc_X\.\.Z have a norm of 1"):
        read_dot_export(path)

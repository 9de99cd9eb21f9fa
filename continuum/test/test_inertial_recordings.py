"""Streams on one grid, the vendor's files, and angles of whole recordings."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from inertial_arm import (
    RELEASE,
    REST,
    TAGS,
    Motion,
    N,
    SensorModel,
    calibrated,
    pull_and_release,
    rms,
    sensed,
    with_losses,
    write_exports,
)

from continuum.arrays import Array
from continuum.errors import FileError, InvalidValueError, MeasurementError
from continuum.inertial.clock_check import check_common_clock
from continuum.inertial.common_clock import on_one_clock
from continuum.inertial.dot_export import WRAP, DotExport, read_dot_export
from continuum.inertial.estimator_settings import EstimatorSettings
from continuum.inertial.imu_recording import ImuRecording
from continuum.inertial.recorded_angles import recorded_angles
from continuum.inertial.time_grid import Stream, on_one_grid

STORED = 120.0
AT_120 = EstimatorSettings(period=1 / STORED)


@pytest.fixture(scope="module")
def motion() -> Motion:
    return pull_and_release()


@pytest.fixture(scope="module")
def recording(motion: Motion) -> ImuRecording:
    return sensed(motion, STORED, SensorModel(), seed=3)[0]


def streams(recording: ImuRecording) -> list[Stream]:
    return [
        Stream(f"s{i}", recording.times, recording.rates[:, i], recording.forces[:, i], recording.clipped[:, i])
        for i in range(recording.n_sensors)
    ]


def some(stream: Stream, rows: Array | slice) -> Stream:
    """Of its readings."""
    return Stream(stream.name, stream.times[rows], stream.rates[rows], stream.forces[rows], stream.clipped[rows])


def off_phase(motion: Motion, by: int) -> ImuRecording:
    """Readings of the same sensors at instants that are ``by`` fine steps later."""
    later = Motion(motion.times[by:], motion.theta[by:], motion.rate[by:])
    return sensed(later, STORED, SensorModel(rate_noise=0.0, force_noise=0.0), seed=3)[0]


def test_streams_of_the_same_instants_come_through(recording: ImuRecording) -> None:
    found = on_one_grid(streams(recording))
    np.testing.assert_allclose(found.times, recording.times, atol=1e-9)
    np.testing.assert_allclose(found.rates, recording.rates, atol=1e-8)
    np.testing.assert_allclose(found.forces, recording.forces, atol=1e-6)
    assert found.valid.all()


@pytest.mark.parametrize("by", [1, 4, 7])
def test_instants_in_between_give_the_means_of_the_grid(motion: Motion, by: int) -> None:
    plain, late = off_phase(motion, 0), off_phase(motion, by)
    first, second = streams(plain)[4], streams(late)[4]
    found = on_one_grid([first, second])
    turn = np.cumsum(found.rates[:, 1] - found.rates[:, 0], axis=0) / STORED  # of the same link, by both streams
    assert np.degrees(np.abs(turn).max()) < 0.5  # where the cable is let go within half a period
    assert np.degrees(np.sqrt(np.mean(turn**2))) < 0.05


def test_what_a_stream_misses_is_not_valid_and_the_rest_is(recording: ImuRecording) -> None:
    whole = streams(recording)
    keep = np.ones(recording.times.size, dtype=bool)
    keep[[400, 900, 901, 902]] = False
    whole[2] = some(whole[2], keep)
    found = on_one_grid(whole)
    assert np.flatnonzero(~found.valid[:, 2]).tolist() == [400, 900, 901, 902]
    assert found.valid[:, [0, 1, 3, 4]].all()


def test_clips_are_carried_over(recording: ImuRecording) -> None:
    whole = streams(recording)
    clipped = np.zeros(recording.times.size, dtype=bool)
    clipped[777] = True
    whole[1] = replace(whole[1], clipped=clipped)
    assert np.flatnonzero(on_one_grid(whole).clipped[:, 1]).tolist() == [777]
    whole[0] = replace(whole[0], times=whole[0].times + 0.4 / STORED)  # whose instants are the grid's now
    found = on_one_grid(whole)
    at = np.flatnonzero(found.clipped[:, 1])
    assert at.size == 2
    assert abs(found.times[at].mean() - recording.times[777]) < 1 / STORED


def test_streams_that_do_not_belong_together_are_refused(recording: ImuRecording) -> None:
    whole = streams(recording)
    with pytest.raises(MeasurementError, match="no time is common to all sensors"):
        on_one_grid([whole[0], replace(whole[1], times=whole[1].times + 100)])
    with pytest.raises(MeasurementError, match=r"s1 has 60\.0 readings a second, s0 120\.0"):
        on_one_grid([whole[0], some(whole[1], slice(None, None, 2))])
    with pytest.raises(MeasurementError, match="s1 has only 2 readings"):
        on_one_grid([whole[0], some(whole[1], slice(2))])


def test_clocks_that_were_not_synchronised_are_noticed(recording: ImuRecording) -> None:
    check_common_clock(recording)
    check_common_clock(recording.part(0.0, REST - 0.5))  # at rest there is nothing to notice
    rates = recording.rates.copy()
    rates[:, 1] = np.roll(rates[:, 1], round(0.5 * STORED), axis=0)
    with pytest.raises(MeasurementError, match=r"move at different times \(.*synchronised"):
        check_common_clock(replace(recording, rates=rates))


def angle_errors(recording: ImuRecording, motion: Motion) -> Array:
    """Of a whole recording, (n_times, n) [degrees]."""
    found = recorded_angles(recording, calibrated(recording), AT_120)
    assert np.array_equal(np.isfinite(found.theta), found.good)
    assert np.array_equal(np.isfinite(found.theta_rate), found.good)
    return np.degrees(found.theta - motion.at(recording.times)[0])


def test_angles_of_a_whole_recording(motion: Motion, recording: ImuRecording) -> None:
    off = angle_errors(recording, motion)
    swing = (recording.times > RELEASE) & (recording.times < RELEASE + 2)
    assert np.isfinite(off).all()
    assert rms(off[swing]).max() < 0.5
    assert rms(off[~swing]).max() < 0.3


def test_rest_at_either_end_is_enough(motion: Motion, recording: ImuRecording) -> None:
    calibration = calibrated(recording)
    for begin, end in ((RELEASE + 0.1, 99.0), (0.0, RELEASE + 0.4)):
        cut = recording.part(begin, end)
        found = recorded_angles(cut, calibration, AT_120)
        off = np.degrees(found.theta - motion.at(cut.times)[0])
        assert np.isfinite(off).all()
        assert rms(off).max() < 0.5


def test_gaps_offline_give_nothing_wrong(motion: Motion, recording: ImuRecording) -> None:
    rng = np.random.default_rng(5)
    lost = rng.random((recording.times.size, N)) < 0.005
    lost[int((RELEASE + 0.2) * STORED) : int((RELEASE + 0.3) * STORED), 3] = True
    off = angle_errors(with_losses(recording, lost), motion)
    assert np.nanmax(np.abs(off)) < 1.0
    assert rms(off).max() < 0.5
    assert not np.isfinite(off[lost]).any()


def test_rates_at_instants_are_refused_offline(recording: ImuRecording) -> None:
    with pytest.raises(InvalidValueError, match="rates_are_means"):
        recorded_angles(recording, calibrated(recording), replace(AT_120, rates_are_means=False))


# --- the vendor's files ---


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


def test_empty_and_repeated_rows_are_left_out_and_told(tmp_path: Path) -> None:
    rows = ["0,100,0,0,0,0,0,0", "1,200,1,1,1,1,1,1", "2,200,2,2,2,2,2,2", "3,300,3,3,3,3,3,3"]
    found = parsed(tmp_path, "\n".join([COLUMNS, *rows]))
    assert found.ticks.tolist() == [200, 300]
    assert found.notes == (
        "1 rows of nothing but zeros, left out (first: row 2)",
        "1 rows with the time of the row before, left out (first: row 4)",
    )


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "no line with the column SampleTimeFine"),
        ("t,x\n1,2\n", "no line with the column SampleTimeFine"),
        (HEAD + COLUMNS.replace("Gyr_Y", "Mag_Y"), "has no column Gyr_Y: choose them at the export"),
        (HEAD + COLUMNS, "has no rows"),
        (f"{COLUMNS},Gyr_X\n1,2,3,4,5,6,7,8,9", "has the column Gyr_X twice"),
        (f"{COLUMNS}\n1,2,3,4,5,6,7", "row 2 has 7 cells"),
        (f"{COLUMNS}\n1,2,3,x,5,6,7,8", "row 2, column Gyr_Y: 'x' is no number"),
        (f"{COLUMNS}\n1,2,3,,5,6,7,8", "row 2, column Gyr_Y: '' is no number"),
        (f"{COLUMNS}\n1,2,3,nan,5,6,7,8", "'nan' is no number"),
        (f"{COLUMNS}\n1,-2,3,4,5,6,7,8", "SampleTimeFine is -2"),
        (f"{COLUMNS}\n1,2.5,3,4,5,6,7,8", "SampleTimeFine is 2.5"),
        (f"{COLUMNS}\n1,4294967296,3,4,5,6,7,8", "SampleTimeFine is 4.29497e\\+09"),
        (f"{COLUMNS}\n1,900,3,4,5,6,7,8\n2,100,3,4,5,6,7,8", "row 3: time jumps by -0.0008 s; are these two"),
        (f"{COLUMNS}\n1,900,3,4,5,6,7,8\n2,900000000,3,4,5,6,7,8", "row 3: time jumps by 899.999 s"),
        (f"{COLUMNS}\n1,9,3,4,5,6,7,8\n\n3,\"", "no number|cells|cannot be read"),
    ],
)  # fmt: skip
def test_damaged_files_are_refused_by_row(tmp_path: Path, text: str, told: str) -> None:
    with pytest.raises(FileError, match=told):
        parsed(tmp_path, text)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FileError, match="cannot be read"):
        read_dot_export(tmp_path / "no.csv")


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

"""How often verdicts were right: of hand-made results, and of those that are kept."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tools.benchmarks.discovery.__main__ import RECORD, RESULTS
from tools.benchmarks.discovery.result import Result, load
from tools.benchmarks.discovery.test.results_by_hand import effect, named, result, verdict
from tools.benchmarks.discovery.track_record import is_right, track_record, write_track_record

DELAY, TILT, MAGNET = effect("sensor_delay"), effect("base_tilt"), effect("magnet", 3)
IS_DELAY, IS_TILT, IS_SCALE = [named("sensor_delay")], [named("base_tilt")], [named("sensor_scale", 1)]

CASES = [
    (True, [DELAY], verdict("cause", IS_DELAY)),
    (True, [DELAY, TILT], verdict("cause", IS_TILT, complete=False)),
    (False, [DELAY], verdict("cause", IS_TILT)),
    (False, [DELAY], verdict("cause", IS_DELAY + IS_TILT)),
    (False, [], verdict("cause", IS_DELAY)),
    (False, [MAGNET], verdict("cause", IS_DELAY, complete=False)),
    (True, [DELAY], verdict("ambiguous", IS_SCALE, IS_DELAY)),
    (False, [DELAY], verdict("ambiguous", IS_SCALE, IS_TILT)),
    (False, [MAGNET], verdict("ambiguous", IS_SCALE, IS_TILT, complete=False)),
    (True, [], verdict("adequate")),
    (False, [DELAY], verdict("adequate")),
    (False, [MAGNET], verdict("adequate", complete=False)),
    (True, [MAGNET], verdict("unknown", complete=False)),
    (False, [DELAY], verdict("unknown", complete=False)),
    (False, [], verdict("unknown", complete=False)),
]


@pytest.mark.parametrize(("right", "hidden", "given"), CASES)
def test_a_verdict_is_right_where_all_that_it_says_is_so(right: bool, hidden: list, given: dict) -> None:
    assert is_right(hidden, given) is right


def test_verdicts_are_counted_by_kind(tmp_path: Path) -> None:
    results = [result(hidden, given, half="held-out") for _, hidden, given in CASES]
    others = [result([], verdict("adequate")), result([], None, half="held-out")]
    record = track_record(results + others)
    assert record["cases"] == len(CASES)
    for kind, counts in record["verdicts"].items():
        mine = [right for right, _, given in CASES if given["verdict"] == kind]
        assert (counts["n"], counts["right"]) == (len(mine), sum(mine))
        assert 0 <= counts["low"] < counts["right"] / counts["n"] < counts["high"] <= 1
    assert write_track_record(results, tmp_path / "record.json")
    assert json.loads((tmp_path / "record.json").read_text()) == track_record(results)


def test_without_held_out_results_the_file_stays_as_it_is(tmp_path: Path) -> None:
    assert not write_track_record([result([], verdict("adequate"))], tmp_path / "record.json")
    assert not (tmp_path / "record.json").exists()


def test_what_the_page_of_a_diagnosis_says_is_what_the_kept_results_say() -> None:
    root = Path(__file__).resolve().parents[4]
    record = json.loads((root / RECORD).read_text(encoding="utf-8"))
    mine: list[Result] = [one for one in load(root / RESULTS) if one.digest == record["sources"]]
    assert track_record(mine) == record

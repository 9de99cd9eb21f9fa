"""`--json` of `info`, `simulate` and `report`: one line on stdout, with the figures of the table."""

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import CONFIG, Captured, code, rows_of
from recorded_runs import arm_file, run, write

from continuum.arm import arm_from_mapping, load_arm

ARM_FILES = sorted(CONFIG.glob("*.yaml"))


def pairs(output: str) -> dict[str, str]:
    """What the lines of a table say, by their names."""
    return dict(re.findall(r"^(\S.*?\S) {2,}(\S.*?) *$", output, re.MULTILINE))


def numbers(text: str) -> list[float]:
    return [float(one) for one in re.findall(r"-?\d+\.?\d*(?:e[-+]\d+)?", text)]


def result_of(capsys: Captured, *words: object) -> tuple[dict[str, Any], str]:
    """The one line of JSON on stdout, and what stands on stderr; NaN and the like are no JSON."""
    assert code(*words, "--json") == 0
    captured = capsys.readouterr()
    (line,) = captured.out.splitlines()

    def refuse(constant: str) -> None:
        raise AssertionError(constant)

    return json.loads(line, parse_constant=refuse), captured.err


def table_of(capsys: Captured, *words: object) -> str:
    assert code(*words) == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("file", ARM_FILES, ids=lambda path: path.stem)
def test_info_gives_the_arm_back_and_the_figures_of_the_table(capsys: Captured, file: Path) -> None:
    (result, errors), table = result_of(capsys, "info", file), table_of(capsys, "info", file)
    assert errors == ""
    assert arm_from_mapping(result["arm"]) == load_arm(file)
    assert f" {1e3 * result['length']:.1f} mm long, {len(result['cables'])} cables" in table
    names = result["arm"]["sections"]
    for row, name in zip(rows_of(table, names), names, strict=True):
        section = result["arm"][name]
        angles = np.degrees([section["twist"], *section["cable_azimuths"], section["bend_limit"]])
        lengths = 1e3 * np.array([result["section_lengths"][name], section["b"], section["a"]])
        shown = np.array(row[1:], dtype=float)
        np.testing.assert_allclose(shown, [section["n_joints"], *lengths, *angles], atol=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("how", [("--release", "60", "--pulled"), ("--release", "5,10,-5,20,7.5")])
def test_simulate_gives_the_figures_of_the_table(capsys: Captured, tmp_path: Path, how: tuple[str, ...]) -> None:
    out = tmp_path / "new" / "run.csv"
    words = ("simulate", *how, "--duration", 0.3, "--csv", out)
    result, errors = result_of(capsys, *words)
    assert errors == f"written: {out}\n"
    shown = pairs(table_of(capsys, *words))
    rows = np.loadtxt(out, delimiter=",", skiprows=1)
    angles, rates = np.radians(rows[:, 1:6]), np.radians(rows[:, 6:11])
    bend = angles.sum(axis=1)
    found = [result[f"bend_{one}"] for one in ("first", "last", "least", "greatest")] + [result["fastest_rate"]]
    of_rows = [bend[0], bend[-1], bend.min(), bend.max(), np.abs(rates).max()]
    np.testing.assert_allclose(found, of_rows, rtol=1e-6, atol=1e-8)
    assert result["status"] == "COMPLETE" == shown["integration"].upper()
    assert numbers(shown["simulated"]) == [result["duration"], result["samples"]]
    bends = np.degrees([result[f"bend_{one}"] for one in ("first", "last", "least", "greatest")])
    np.testing.assert_allclose(numbers(shown["bend in total"]), bends, atol=0.0051)
    joint, speed, time = numbers(shown["fastest joint"].replace("degrees/s", ""))
    assert joint == result["fastest_joint"]
    np.testing.assert_allclose([speed, time], [np.degrees(result["fastest_rate"]), result["fastest_time"]], atol=0.51)
    assert (result["held_tension"] is None) == ("held by" not in shown) == ("--pulled" not in how)
    if "held by" in shown:
        np.testing.assert_allclose(numbers(shown["held by"]), [result["held_tension"]], atol=0.0051)
        np.testing.assert_allclose(numbers(shown["joint angles"]), np.degrees(result["held_angles"]), atol=0.0051)
        assert math.isclose(sum(result["held_angles"]), result["bend_first"])


@pytest.mark.slow
def test_a_simulation_that_fails_says_so_in_json(capsys: Captured, tmp_path: Path) -> None:
    """Tensions that fold the arm: no figure is a number that JSON does not have."""
    (tmp_path / "pull.csv").write_text("t_s,u1_N,u2_N\n0,0,0\n1,20000,0\n", encoding="utf-8")
    out = tmp_path / "out.csv"
    assert code("simulate", "--tensions", tmp_path / "pull.csv", "--csv", out, "--json") == 1
    captured = capsys.readouterr()
    assert json.loads(captured.out)["samples"] == 121
    assert "nothing is written" in captured.err
    assert not out.exists()


@pytest.mark.slow
def test_report_gives_the_figures_of_the_table(capsys: Captured, tmp_path: Path) -> None:
    topics = run()
    del topics["/section_config_states"][30:32], topics["/cable_states"][5]
    words = ("report", write(tmp_path / "run", topics), "--arm", arm_file(tmp_path / "arm.yaml"))
    result, errors = result_of(capsys, *words, "--out", tmp_path / "new" / "out")
    assert sorted(errors.splitlines()) == [
        f"written: {tmp_path}/new/out/{name}" for name in ("cable_states.csv", "cables.png")
    ]
    shown = pairs(table_of(capsys, *words))
    assert numbers(shown["poses"])[0] == result["n_targets"]
    np.testing.assert_allclose(numbers(shown["poses"])[1:], [result["rate"], result["duration"]], atol=0.051)
    assert shown["poses reached"] == str(result["n_solved"])
    errors_m = [result["tip_error_median"], result["tip_error_max"]]
    np.testing.assert_allclose(numbers(shown["tip error of the reached poses"]), 1e3 * np.array(errors_m), rtol=0.06)
    (rate,) = numbers(shown["cable rate against slope of length"])
    np.testing.assert_allclose(rate, 1e3 * result["rate_disagreement"], atol=0.00051)
    assert shown["messages lost"] == str(result["n_lost"]) == "3"
    lost = {name.removeprefix("lost on "): int(n) for name, n in shown.items() if name.startswith("lost on ")}
    assert lost == {name: count for name, count in result["lost"].items() if count}


@pytest.mark.slow
def test_what_was_not_recorded_is_null(capsys: Captured, tmp_path: Path) -> None:
    topics = run()
    for status, state in zip(topics["/ik_status"], topics["/cable_states"], strict=True):
        status.status, state.velocity = 2, np.zeros(0)
    words = ("report", write(tmp_path / "run", topics), "--arm", arm_file(tmp_path / "arm.yaml"))
    result, _ = result_of(capsys, *words)
    assert result["tip_error_max"] is None
    assert result["largest_rate"] is None

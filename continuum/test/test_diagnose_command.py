"""`continuum diagnose` from files to files: what it refuses in one line, what it writes, and its exit codes."""

from __future__ import annotations

import json
import shlex
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from dynamics_laws import prototype_model
from identification_laws import BENDS, FINE, N, recorded

from continuum.cli import main, view
from continuum.cli.diagnose import EXIT_CODES
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.simulator import Simulator
from continuum.recordings.motion_table import write_measured_motion
from continuum.viewer.page import Page

pytestmark = pytest.mark.slow

type Captured = pytest.CaptureFixture[str]


def test_bad_data_are_refused_in_one_line(tmp_path: Path, capsys: Captured) -> None:
    table = tmp_path / "run.csv"
    table.write_text("t_s,q1_deg\n0,1\n")
    assert main(["diagnose", str(table), "--json", str(tmp_path / "out.json")]) == 2
    output = capsys.readouterr().err
    assert "run.csv: has 1 usable rows" in output
    assert output.count("\n") == 1
    assert not (tmp_path / "out.json").exists()


def test_what_was_not_understood_is_reported_before_the_search(
    tmp_path: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A pulled run whose tensions have another name is another run."""
    table = tmp_path / "run.csv"
    rows = [f"{i / 120},{10 * np.cos(i / 9)},3" for i in range(60)]
    table.write_text("\n".join(["t_s,q1_deg,pull", *rows]))

    def stopped(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("continuum.discovery.diagnose", stopped)
    main(["diagnose", str(table)])
    assert capsys.readouterr().err.startswith("continuum: run: unknown columns, not used: pull\n")


@pytest.fixture
def model(tmp_path: Path) -> Path:
    """File of a small arm."""
    save_model(prototype_model(N), tmp_path / "small.yaml")
    return tmp_path / "small.yaml"


def releases(folder: Path, **truth: float) -> list[str]:
    """Files of two releases of an arm that may differ from the nominal one, noisy."""
    random = np.random.default_rng(5)
    simulator = Simulator(prototype_model(N).with_values(truth), FINE)
    files = []
    for number, bend in enumerate(BENDS[:2], start=1):
        run = recorded(simulator, (2 * bend[0], 2 * bend[1]), random, seconds=0.7)
        assert run.theta_rate is not None
        files.append(str(folder / f"run_{number}.csv"))
        write_measured_motion(run.times, run.theta, run.theta_rate, files[-1])
    return files


def test_a_diagnosis_is_reported_and_written(
    tmp_path: Path, model: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = releases(tmp_path, stiffness=1.3)
    out = {name: tmp_path / "new" / f"out.{name}" for name in ("json", "html", "yaml")}
    words = ["--json", str(out["json"]), "--report", str(out["html"]), "--extended", str(out["yaml"])]
    code = main(["diagnose", *files, "--model", str(model), *words])
    output = json.loads(out["json"].read_text(encoding="utf-8"))
    assert code == EXIT_CODES[output["verdict"]]
    printed = capsys.readouterr().out
    assert printed.startswith(output["verdict"].upper() + "\n")
    *_, last = printed.splitlines()
    assert {f"written: {file}" for file in out.values()} == {*printed.splitlines()[-4:-1]}
    made = output["made"]
    assert (made["recordings"], made["model"]) == (["run_1.csv", "run_2.csv"], "small.yaml")
    page = unescape(out["html"].read_text(encoding="utf-8"))
    assert "Recordings: run_1.csv, run_2.csv. Model: small.yaml." in page
    assert "<svg" in page
    assert load_model(out["yaml"]).n_joints == N
    monkeypatch.setattr(view.signal, "signal", lambda *_: None)
    monkeypatch.setattr(Page, "run", lambda page, stop: page.draw())
    program, *command = shlex.split(last.removeprefix("see before and after: "))
    assert program == "continuum"
    assert main([*command, "--port", "0", "--no-browser"]) == 0


def test_what_is_known_besides_the_recordings_is_used_and_said(
    tmp_path: Path, model: Path, capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A recording is one by any path that leads to it; what was measured is in the files that are written."""
    files = releases(tmp_path)
    monkeypatch.chdir(tmp_path)
    words = ["--measured", "tip_payload.mass=3+-0.5g", "--zeroed", "./run_2.csv", "--without", "sensor_cable"]
    out = {name: tmp_path / f"out.{name}" for name in ("json", "html", "yaml")}
    words += ["--json", str(out["json"]), "--report", str(out["html"]), "--extended", str(out["yaml"])]
    assert main(["diagnose", *files, "--model", str(model), *words]) in EXIT_CODES.values()
    found = json.loads(out["json"].read_text(encoding="utf-8"))
    assert (found["zeroed"], found["made"]["without"]) == (["run_2"], ["sensor_cable"])
    assert "sensor_cable" not in {one["effect"] for one in found["power"]}
    (text,) = found["measured"]
    assert text in capsys.readouterr().out
    assert text in unescape(out["html"].read_text(encoding="utf-8"))
    (payload,) = (one for one in load_model(out["yaml"]).effects if one.effect.name == "tip_payload")
    assert 0.001 < payload.values["mass"][0] < 0.005


@pytest.mark.parametrize(
    "words",
    [
        ["--measured", "tip_payload.mass=3"], ["--measured", "tip_payload.mass[1]=3g"], ["--measured", "tip_payload"],
        ["--measured", "rest_angle.angle[9]=1deg"], ["--zeroed", "run_3.csv"], ["--without", "payload"],
    ],
)  # fmt: skip
def test_what_cannot_be_known_is_refused_in_one_line(
    tmp_path: Path, model: Path, capsys: Captured, words: list[str]
) -> None:
    assert main(["diagnose", *releases(tmp_path), "--model", str(model), *words]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_an_arm_of_another_number_of_joints_is_refused(tmp_path: Path, capsys: Captured) -> None:
    assert main(["diagnose", *releases(tmp_path)]) == 2
    output = capsys.readouterr().err
    assert "run_1: number of joints is 2; allowed: 5" in output
    assert "--model" in output


@pytest.mark.parametrize("option", ["--json", "--report", "--extended"])
def test_what_cannot_be_written_is_refused_before_the_search(tmp_path: Path, capsys: Captured, option: str) -> None:
    (tmp_path / "file").touch()
    words = [option, str(tmp_path / "file" / "folder" / "out.html")]
    assert main(["diagnose", *releases(tmp_path), *words]) == 2
    output = capsys.readouterr().err
    assert "cannot be written" in output
    assert output.count("\n") == 1

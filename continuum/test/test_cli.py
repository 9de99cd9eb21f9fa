"""The command `continuum`: its output, its exit codes, and errors in one line."""

import os
import re
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml
from command_line import CONFIG, THREE, Captured, code, refused, rows_of
from recorded_runs import ARM, arm_file, run, tips, write

from continuum.arm import Arm, arm_to_mapping, load_arm
from continuum.cli import main
from continuum.shipped_files import MODELS

pytestmark = pytest.mark.slow

MODEL = MODELS / "lamecc_prototype.yaml"
ARM_FILES = sorted(CONFIG.glob("*.yaml"))


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> str:
    return str(arm_file(tmp_path_factory.mktemp("arm") / "arm.yaml"))


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> str:
    topics = run()
    del topics["/section_config_states"][30:32], topics["/cable_states"][5]
    return str(write(tmp_path_factory.mktemp("run") / "recording", topics))


def test_help_says_what_can_be_done_next(capsys: Captured) -> None:
    assert code("--help") == 0
    text = capsys.readouterr().out
    commands = re.findall(r"^  (continuum|ros2) (\w+)", text, re.MULTILINE)
    assert {("continuum", name) for name in ("info", "solve", "simulate", "report")} <= set(commands)
    assert {("ros2", "launch"), ("ros2", "bag")} <= set(commands)
    assert (CONFIG.parents[1] / re.search(r"like (\S+\.yaml)", text)[1]).is_file()
    for package, file in re.findall(r"ros2 launch (\w+) (\S+)", text):
        assert (CONFIG.parents[1] / package / "launch" / file).is_file()


@pytest.mark.parametrize(
    "words", [(), ("nonsense",), ("solve", THREE, "1", "x", "0"), ("solve", THREE), ("diagnose", "--foo", "run.csv")]
)
def test_wrong_usage(capsys: Captured, words: tuple[str, ...]) -> None:
    refused(capsys, *words)


def test_the_installed_command() -> None:
    command = shutil.which("continuum")
    assert command is not None
    done = subprocess.run([command, "info", "nowhere.yaml"], capture_output=True, text=True, env=os.environ)
    assert done.returncode == 2
    assert done.stderr.startswith("continuum: nowhere.yaml: cannot be read")
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize("words", [("--help",), ("solve", THREE, "0.1", "0", "0.4", "--json")])
def test_nobody_reads_on(words: tuple[str, ...]) -> None:
    reader, writer = os.pipe()
    os.close(reader)
    command = [str(shutil.which("continuum")), *words]
    done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, env=os.environ)
    os.close(writer)
    assert done.stderr == ""
    assert done.returncode in (0, 1)  # argparse ends with 0, read or not


@pytest.mark.parametrize("kind", [SystemError, RuntimeError])
def test_an_interrupt_of_what_is_at_work_is_one_and_a_fault_is_none(
    kind: type[Exception], capsys: Captured, monkeypatch: pytest.MonkeyPatch
) -> None:
    """numba tells of a `KeyboardInterrupt` by a `SystemError`, a lock that was being given back by a `RuntimeError`."""

    def interrupted(_arguments: list[str]) -> int:
        try:
            raise KeyboardInterrupt
        except KeyboardInterrupt as cause:
            raise kind("returned a result with an exception set") from cause

    def faulty(_arguments: list[str]) -> int:
        raise kind("a fault")

    monkeypatch.setattr("continuum.cli._run", interrupted)
    assert main(["diagnose"]) == 130
    assert capsys.readouterr().err == "continuum: stopped\n"
    monkeypatch.setattr("continuum.cli._run", faulty)
    with pytest.raises(kind, match="a fault"):
        main(["diagnose"])


def test_a_diagnosis_overwrites_neither_what_it_reads_nor_what_it_writes(capsys: Captured, tmp_path: Path) -> None:
    data, model, folder = tmp_path / "run.csv", tmp_path / "model.yaml", tmp_path / "bag"
    data.write_text("measured"), model.write_text("n_joints: 5"), folder.mkdir()
    for words in (("--json", data), ("--extended", tmp_path / "." / "run.csv"), ("--report", folder / "report.html")):
        assert "is read, and would be overwritten" in refused(capsys, "diagnose", data, folder, *words)
    assert "is read" in refused(capsys, "diagnose", data, "--model", model, "--extended", model)
    both = ("--json", tmp_path / "out.html", "--report", tmp_path / "out.html")
    assert "would be written twice" in refused(capsys, "diagnose", data, *both)
    assert data.read_text() == "measured"


def test_a_simulation_overwrites_neither_what_it_reads_nor_what_it_writes(capsys: Captured, tmp_path: Path) -> None:
    tensions = tmp_path / "pull.csv"
    tensions.write_text(pulled := "t_s,u1_N,u2_N\n0,1,0\n1,1,0\n")
    words = ("simulate", "--model", MODEL, "--tensions", tensions)
    assert "is read, and would be overwritten" in refused(capsys, *words, "--csv", tmp_path / "." / "pull.csv")
    both = ("--csv", tmp_path / "out.png", "--picture", tmp_path / "out.png")
    assert "would be written twice" in refused(capsys, *words, *both)
    assert tensions.read_text() == pulled


def test_a_model_is_no_arm_and_an_arm_no_model(capsys: Captured) -> None:
    for words in (("info", "lamecc_prototype.yaml"), ("solve", MODEL, 0, 0, 0.1)):
        assert "lamecc_prototype.yaml: is a model file, of `simulate` and `diagnose`; " in refused(capsys, *words)
    arm = str(CONFIG / "prototype.yaml")
    assert refused(capsys, "simulate", "--model", arm).startswith(f"{arm}: is an arm file, of `info` and `solve`; ")


@pytest.mark.parametrize("file", ARM_FILES, ids=lambda path: path.stem)
def test_info_prints_the_file_s_values_in_80_columns(capsys: Captured, file: Path) -> None:
    assert code("info", file) == 0
    output = capsys.readouterr().out
    arm = load_arm(file)
    assert max(map(len, output.splitlines())) <= 80
    assert output.startswith(f"{arm.n_sections} section{'' if arm.n_sections == 1 else 's'}, ")
    assert f"{1e3 * arm.length:.1f} mm long, {len(arm.cable_names)} cables" in output
    rows = rows_of(output, [section.name for section in arm.sections])
    assert len(rows) == arm.n_sections
    for section, (name, *figures) in zip(arm.sections, rows, strict=True):
        azimuths, limit = np.degrees(section.cable_azimuths), np.degrees(section.bend_limit)
        millimetres = 1e3 * np.array([section.length, section.b, section.a])
        expected = [section.n_joints, *millimetres, np.degrees(section.twist), *azimuths, limit]
        assert name == section.name
        np.testing.assert_allclose(np.array(figures, dtype=float), expected, atol=0.05)
    assert output.count("[mm]") == 3
    assert output.count("[deg]") == 3


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("a: [1", "is not valid YAML"),
        ("sections: [s]\ns: {n_joints: 2, b: -0.1, a: 0.02}", "arm.s.b is -0.1; allowed: "),
    ],
)
def test_every_command_refuses_a_bad_arm_file(
    capsys: Captured, tmp_path: Path, recording: str, text: str, problem: str
) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(text, encoding="utf-8")
    for words in (("info", file), ("solve", file, 0, 0, 0.1), ("report", recording, "--arm", file)):
        assert problem in refused(capsys, *words)


def test_every_command_refuses_a_missing_file(capsys: Captured, tmp_path: Path, recording: str) -> None:
    for path in (tmp_path, tmp_path / "nowhere"):
        for words in (("info", path), ("solve", path, 0, 0, 0.1), ("report", recording, "--arm", path)):
            assert refused(capsys, *words).startswith(f"{path}: cannot be read")
        assert "is not a readable rosbag2 recording" in refused(capsys, "report", path, "--arm", THREE)


def test_report_prints_figures_and_losses(capsys: Captured, recording: str, arm: str, tmp_path: Path) -> None:
    assert code("report", recording, "--arm", arm, "--out", tmp_path / "new" / "out") == 0
    output = capsys.readouterr().out
    assert max(len(line) for line in output.splitlines() if not line.startswith("written: ")) <= 80
    n = len(tips())
    output = dict(re.findall(r"^(\S.*?\S) {2,}(\S.*?) *$", output, re.MULTILINE))
    assert output["poses"] == f"{n} at 100.0 Hz over {(n - 1) / 100:.1f} s"
    assert output["poses reached"] == str(n)
    errors = re.fullmatch(r"median (\S+) mm, max (\S+) mm", output["tip error of the reached poses"])
    assert errors is not None
    assert 0.0 <= float(errors[1]) <= float(errors[2]) < 1e-6
    assert output["cable rate against slope of length"].endswith(" mm/s at worst,")
    assert output["messages lost"] == "3"
    assert {name: count for name, count in output.items() if name.startswith("lost on")} == {
        "lost on /cable_states": "1",
        "lost on /section_config_states of section 1": "1",
        "lost on /section_config_states of section 2": "1",
    }
    files = {path.name: path.stat().st_size for path in (tmp_path / "new" / "out").iterdir()}
    assert files.keys() == {"cable_states.csv", "cables.png"}
    assert min(files.values()) > 5_000


def test_report_of_unreached_poses_without_rates(capsys: Captured, tmp_path: Path, arm: str) -> None:
    topics = run()
    for status, state in zip(topics["/ik_status"], topics["/cable_states"], strict=True):
        status.status, state.velocity = 2, np.zeros(0)
    assert code("report", write(tmp_path / "recording", topics), "--arm", arm) == 0
    output = capsys.readouterr().out
    assert "no pose was reached" in output
    assert "no rates were recorded" in output


def test_report_refuses(capsys: Captured, recording: str, arm: str, tmp_path: Path) -> None:
    in_the_way = tmp_path / "file"
    in_the_way.touch()
    assert "--expected is -1; allowed: a whole number >= 0" in refused(
        capsys, "report", recording, "--arm", arm, "--expected", -1
    )
    assert "cannot be written (Not a directory)" in refused(
        capsys, "report", recording, "--arm", arm, "--out", in_the_way
    )


@pytest.mark.parametrize("command", ["report", "view"])
def test_an_arm_of_which_a_recording_is_not_is_refused(
    capsys: Captured, recording: str, arm: str, tmp_path: Path, command: str
) -> None:
    """Fewer sections, more sections, and sections of other lengths."""
    of_both = [f"{section.name} ({section.n_joints} joints)" for section in ARM.sections]
    output = f"{recording}: is of another arm: it has {', '.join(of_both)}; the arm file "
    shorter, first = tmp_path / "arm.yaml", ARM.sections[0]
    for sections in ((first,), (first, replace(ARM.sections[1], n_joints=4))):
        shorter.write_text(yaml.safe_dump({"arm": arm_to_mapping(Arm(sections))}), encoding="utf-8")
        words = ", ".join(f"{section.name} ({section.n_joints} joints)" for section in sections)
        assert refused(capsys, command, recording, "--arm", shorter) == f"{output}{words}\n"
    assert refused(capsys, command, recording, "--arm", THREE).startswith(output)

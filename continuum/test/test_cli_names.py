"""Names of what comes with the library: taken wherever a file is, and suggested where they are misspelt."""

import re
from pathlib import Path

import pytest
from command_line import CONFIG, Captured, code, refused
from edits import misspelt
from hypothesis import assume, given
from hypothesis import strategies as st

from continuum.arm import load_arm
from continuum.cli.models import read_model
from continuum.dynamics.effect_lookup import effect_names
from continuum.dynamics.model_file import load_model
from continuum.errors import FileError
from continuum.shipped_files import ARMS, MODELS, find_file, shipped_names

NAMED = [(folder, name) for folder in (ARMS, MODELS) for name in shipped_names(folder)]


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder without any of these files."""
    monkeypatch.chdir(tmp_path)


def test_the_links_of_the_description_are_the_arms_of_the_library() -> None:
    assert [path.name for path in sorted(CONFIG.glob("*.yaml"))] == shipped_names(ARMS)
    for path in CONFIG.glob("*.yaml"):
        assert path.samefile(ARMS / path.name)


@pytest.mark.parametrize("ending", ["", ".yaml"])
def test_a_name_is_the_file(ending: str) -> None:
    for name in shipped_names(ARMS):
        assert load_arm(name.removesuffix(".yaml") + ending) == load_arm(ARMS / name)
    for name in shipped_names(MODELS):
        assert read_model(name.removesuffix(".yaml") + ending).sources == load_model(MODELS / name).sources


def test_a_file_here_comes_before_a_shipped_one(tmp_path: Path) -> None:
    (tmp_path / "prototype.yaml").write_text((ARMS / "three_sections.yaml").read_text(), encoding="utf-8")
    assert load_arm("prototype.yaml") == load_arm(ARMS / "three_sections.yaml")
    assert load_arm("prototype") == load_arm(ARMS / "prototype.yaml")
    with pytest.raises(FileError, match="cannot be read"):
        load_arm("./three_sections.yaml")  # a path, which leads to nothing


def test_commands_take_names(capsys: Captured) -> None:
    assert code("info", "three_sections") == 0
    assert code("solve", "three_sections.yaml", 0.15, 0, 0.2) == 0
    assert code("simulate", "--model", "double_pendulum", "--duration", 0.1, "--release", "10,5") == 0
    assert capsys.readouterr().err == ""
    assert "is an arm file" in refused(capsys, "simulate", "--model", "prototype")
    assert "is a model file" in refused(capsys, "info", "double_pendulum.yaml")


@given(st.data())
def test_a_wrong_name_lists_what_is_known_and_suggests_the_right_one(data: st.DataObject) -> None:
    folder, name = data.draw(st.sampled_from(NAMED))
    stem = name.removesuffix(".yaml")
    wrong = data.draw(misspelt(stem))
    assume(f"{wrong}.yaml" not in {other for _, other in NAMED})
    for word in (wrong, f"{wrong}.yaml"):
        with pytest.raises(FileError) as refusal:
            find_file(word, folder)
        assert all(known in refusal.value.problem for known in shipped_names(folder))
        found = re.search(r"; did you mean (.*)\?$", refusal.value.problem)
        assert found is not None
        assert stem in found[1].split(" or ")


@pytest.mark.parametrize(("option", "rest"), [("--without", ""), ("--measured", ".mass=50g")])
def test_a_wrong_effect_suggests_the_right_one(capsys: Captured, option: str, rest: str) -> None:
    for name in effect_names():
        for wrong in (name[:-1], f"{name}x", name.replace("a", "e", 1)):
            if wrong not in effect_names():
                line = refused(capsys, "diagnose", "none.csv", option, wrong + rest)
                assert name in line.rpartition("; did you mean ")[2].rstrip("?\n").split(" or ")

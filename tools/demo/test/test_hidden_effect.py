"""What the demo hides is what it names, and the model that it writes has it."""

import re
from pathlib import Path

import numpy as np
import pytest
from blind.mujoco_plant.case import Truth
from blind.mujoco_plant.effects import EFFECTS, LIBRARY
from blind.mujoco_plant.parameters import varied

from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.model_file import load_model
from tools.demo.hidden_effect import find_hidden_effect, hidden_case, hidden_in_words

SEED = 12  # the demo's


def values_of(line: str) -> dict[str, float]:
    """Values by name in a line of the answer."""
    return {name: float(value) for name, value in re.findall(r"(\w+\.\w+(?:\[\d\])?) (-?[\d.]+(?:e-?\d+)?)", line)}


@pytest.mark.slow
def test_the_hidden_effect_is_named_added_and_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    find_hidden_effect(SEED, tmp_path)
    (hidden,) = hidden_case(SEED).truth.effects
    printed = capsys.readouterr().out
    assert f"Verdict: cause: {hidden.name}" in printed
    truth, found = (line for line in printed.splitlines() if line.startswith(("Hidden was: ", "Found, ")))
    assert values_of(truth).keys() == values_of(found).keys()
    for name, value in values_of(truth).items():
        assert values_of(found)[name] == pytest.approx(value, rel=0.25), name
    assert hidden.name in [active.effect.name for active in load_model(str(tmp_path / "hidden_effect.yaml")).effects]
    assert (tmp_path / "hidden_effect.png").read_bytes().startswith(b"\x89PNG")
    assert "<svg" in (tmp_path / "hidden_effect.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", LIBRARY)
def test_what_is_hidden_has_the_names_and_units_of_what_is_found(name: str) -> None:
    """A truth in another measure than the finding cannot be compared with it."""
    kind, arm = EFFECTS[name], varied(np.random.default_rng(0), 1.0)
    hidden = kind(kind.sizes[-1], 2 if kind.at_a_joint else None)
    line = hidden_in_words(Truth((hidden,), "large", "given", "given", 0, arm, {}))
    known = effect_named(name).parameters
    for found, value in values_of(line).items():
        effect, _, parameter = found.partition("[")[0].partition(".")
        assert effect == name
        assert known[parameter].lower <= value <= known[parameter].upper
        assert known[parameter].unit in line or known[parameter].unit == "1"
    assert values_of(line) or "does not have" in line


def test_the_seed_draws_other_effects() -> None:
    assert len({hidden_case(seed).truth.effects[0].name for seed in range(2)}) == 2

"""What the demo hides is what it names, and the model that it writes has it."""

from pathlib import Path

import pytest

from continuum.dynamics.model_file import load_model
from tools.demo.hidden_effect import find_hidden_effect, hidden_case

SEED = 12  # the demo's


@pytest.mark.slow
def test_the_hidden_effect_is_named_added_and_shown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    find_hidden_effect(SEED, tmp_path)
    (hidden,) = hidden_case(SEED).truth.effects
    printed = capsys.readouterr().out
    assert f"Verdict: cause: {hidden.name}" in printed
    assert hidden.name in [active.effect.name for active in load_model(str(tmp_path / "hidden_effect.yaml")).effects]
    assert (tmp_path / "hidden_effect.png").read_bytes().startswith(b"\x89PNG")
    assert "<svg" in (tmp_path / "hidden_effect.html").read_text(encoding="utf-8")


def test_the_seed_draws_other_effects() -> None:
    assert len({hidden_case(seed).truth.effects[0].name for seed in range(2)}) == 2

"""docs/effects.md says of effects and parameters what the code says."""

import re
from pathlib import Path

from effects_laws import EFFECTS, effect_of

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "effects.md").read_text(encoding="utf-8")


def test_every_row_of_a_parameter_is_right() -> None:
    rows = re.findall(r"^\| `(\w+)\.(\w+)` \| (.*) \|$", PAGE, re.MULTILINE)
    assert len(rows) >= 30
    for name, key, said in rows:
        p = effect_of(name).parameters[key]
        owner = ("each joint" if p.per_joint else "the arm") + " and recording" * p.per_recording
        wanted = f"{p.symbol} | {p.unit} | {p.lower:g} to {p.upper:g} | {p.default:g} | {p.typical:g} | {owner}"
        assert said == wanted, f"{name}.{key}"


def test_effects_of_the_page_are_installed_with_all_their_parameters() -> None:
    listed = set(re.findall(r"^\| `(\w+)` \|", PAGE, re.MULTILINE))
    assert listed <= set(EFFECTS)
    assert len(listed) >= 21
    rows = set(re.findall(r"^\| `(\w+\.\w+)` \|", PAGE, re.MULTILINE))
    assert rows == {f"{name}.{key}" for name in listed for key in effect_of(name).parameters}

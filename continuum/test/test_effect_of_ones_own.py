"""The user's effect package of docs/effects.md: installed by the page's commands, the effect is in the library."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

PAGE = Path(__file__).resolve().parents[2] / "docs" / "effects.md"
BLOCK = re.compile(r"```\w+\n# (foam_sleeve/\S+)\n(.*?)```", re.DOTALL)
LAWS = Path(__file__).with_name("test_effects_laws.py")


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Of processes that have the package, which no other has."""
    folder = tmp_path_factory.mktemp("own")
    for name, text in BLOCK.findall(PAGE.read_text(encoding="utf-8")):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    words = ["--quiet", "--no-build-isolation", "--no-deps", "--no-index", "--target", folder / "installed"]
    subprocess.run([sys.executable, "-m", "pip", "install", *words, folder / "foam_sleeve"], check=True)
    paths = [str(folder / "installed"), str(LAWS.parent), os.environ.get("PYTHONPATH", "")]
    return dict(os.environ) | {"PYTHONPATH": os.pathsep.join(paths)}


def test_it_is_found_and_acts_on_the_arm(environment: dict[str, str], tmp_path: Path) -> None:
    script = """
from continuum.cli import main
from dataclasses import replace

from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model import ActiveEffect
from continuum.dynamics.model_file import load_model, save_model

assert "foam_sleeve" in effect_names()
model = load_model("lamecc_prototype.yaml")
effect = effect_named("foam_sleeve")
absent = {name: spec.array(spec.default, model.n_joints, name) for name, spec in effect.parameters.items()}
model = replace(model, effects=(*model.effects, ActiveEffect(effect, absent)))
save_model(model.with_values({"foam_sleeve.fifth": 20.0}), "sleeved.yaml")
for name, out in (("lamecc_prototype.yaml", "bare.csv"), ("sleeved.yaml", "sleeved.csv")):
    main(["simulate", "--model", name, "--release", "150", "--duration", "0.3", "--csv", out])
"""
    subprocess.run([sys.executable, "-c", script], env=environment, cwd=tmp_path, check=True)
    bare, sleeved = ((tmp_path / name).read_text().splitlines() for name in ("bare.csv", "sleeved.csv"))
    assert bare[:2] == sleeved[:2]
    assert bare[-1] != sleeved[-1]


def test_it_keeps_the_laws_that_every_effect_owes(environment: dict[str, str]) -> None:
    words = ["-m", "pytest", "-q", "-p", "no:cacheprovider", "-k", "foam_sleeve", str(LAWS)]
    done = subprocess.run([sys.executable, *words], env=environment, capture_output=True, text=True, check=False)
    passed = re.search(r"(\d+) passed", done.stdout)
    assert done.returncode == 0, done.stdout[-2000:]
    assert passed is not None
    assert int(passed[1]) >= 8

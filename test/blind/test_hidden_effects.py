"""An effect hidden in the data is found: by its name, its joint and its size, from files that tell nothing else."""

import json
import os
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from blind.plant import make_case, write_case

_DEADLINE = 1500.0  # s, on a machine that does other things too


def diagnosed(folder: Path, *effects: str, seed: int, dataset: str = "releases") -> tuple[Any, dict[str, Any]]:
    """What is hidden, and what `continuum diagnose` says of the files, as a process of its own."""
    case = make_case(effects, dataset=dataset, seed=seed)
    write_case(case, folder / "data", folder / "sealed")
    command = ["continuum", "diagnose", "--json", str(folder / "verdict.json")]
    files = sorted(str(path) for path in (folder / "data").iterdir())
    done = subprocess.run(
        [*command, *files],
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},
        capture_output=True,
        text=True,
        timeout=_DEADLINE,
        check=False,
    )
    assert done.returncode in (0, 1, 3, 4), done.stderr
    return case.truth, json.loads((folder / "verdict.json").read_text(encoding="utf-8"))


@pytest.mark.xfail(reason="since the scale of priors was mended more than the one cause is named", strict=False)
def test_a_rest_angle_is_found_at_its_joint(tmp_path: Path) -> None:
    truth, verdict = diagnosed(tmp_path, "rest_angle", seed=5)
    (hidden,) = truth.effects
    assert verdict["verdict"] == "cause"
    (cause,) = verdict["causes"]
    assert (cause["effect"], cause["joint"]) == ("rest_angle", hidden.joint)
    (value,) = (parameter["value"] for parameter in cause["parameters"].values())
    np.testing.assert_allclose(value, hidden.amount, rtol=0.1)
    assert verdict["gap_closed"] > 0.8


def test_an_arm_without_an_effect_is_adequate(tmp_path: Path) -> None:
    _, verdict = diagnosed(tmp_path, seed=6)
    assert verdict["verdict"] == "adequate"
    assert verdict["causes"] == []

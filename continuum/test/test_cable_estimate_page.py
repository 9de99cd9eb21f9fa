"""The code on docs/cable-estimate.md runs as it stands there, and the page explains what there is."""

import re
from pathlib import Path

import numpy as np
import pytest

from continuum.kinematics.cable_estimate import TOLERANCE, EstimateStatus
from continuum.kinematics.chain import arm_jacobian

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "cable-estimate.md").read_text(encoding="utf-8")


def test_the_example_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    names: dict = {}
    (block,) = re.findall(r"```python\n(.+?)```", PAGE, re.DOTALL)
    exec(compile(block, "docs/cable-estimate.md", "exec"), names)
    estimate = names["estimate"]
    assert estimate.status is EstimateStatus.CONVERGED
    error = (estimate.w - names["w"]).reshape(-1)
    assert error @ np.linalg.solve(estimate.covariance, error) < 4 * len(error)
    np.testing.assert_allclose(names["twist"], arm_jacobian(names["w"], names["arm"]).sum(axis=1), atol=0.1)


def test_every_status_and_the_tolerance_are_explained() -> None:
    assert re.findall(r"^\| `([A-Z_]+)` \|", PAGE, re.MULTILINE) == [status.name for status in EstimateStatus]
    assert f"{TOLERANCE:g} sd" in PAGE

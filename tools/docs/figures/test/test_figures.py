"""The pictures of README.md: the arm that they show follows the helix, and they are current."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from continuum.kinematics.chain import arm_pose
from continuum.recordings.arm_recording import ArmRecording
from continuum.recordings.kinematic_report import report_on
from tools.docs.figures.__main__ import PICTURES, Draw
from tools.docs.figures.helix_run import helix_run
from tools.docs.figures.posture import backbone, discs
from tools.docs.small_png import shrink

ROOT = Path(__file__).resolve().parents[4]


@pytest.fixture(scope="module")
def run() -> ArmRecording:
    return helix_run()


def test_every_pose_is_reached_and_rates_are_derivatives(run: ArmRecording) -> None:
    report = report_on(run)
    assert report.n_targets == report.n_solved > 4000
    assert report.tip_error_max < 1e-6
    assert report.rate_disagreement_ratio < 0.01


def test_the_backbone_ends_at_the_tip(run: ArmRecording) -> None:
    w = run.configurations.values[1000]
    points = backbone(w, run.arm)
    np.testing.assert_allclose(points[0], 0.0, atol=1e-12)
    np.testing.assert_allclose(points[-1], arm_pose(w, run.arm)[:3, 3], atol=1e-12)


def test_discs_stand_round_the_backbone(run: ArmRecording) -> None:
    w = run.configurations.values[1000]
    away = np.linalg.norm(discs(w, run.arm) - backbone(w, run.arm)[:, None], axis=-1)
    radii = np.repeat([section.a for section in run.arm.sections], [s.n_joints + 1 for s in run.arm.sections])
    assert np.all(away > radii[:, None])
    np.testing.assert_allclose(away, away[:, :1] * np.ones_like(away), atol=1e-12)


def colours(file: Path) -> np.ndarray:
    """Red, green and blue of every pixel, (height, width, 3), 0 to 255."""
    with Image.open(file) as picture:
        return np.asarray(picture.convert("RGB"), dtype=float)


@pytest.mark.parametrize(("name", "draw"), PICTURES.items())
def test_the_picture_of_the_pages_is_current(run: ArmRecording, tmp_path: Path, name: str, draw: Draw) -> None:
    """Rounding may move a line's edge by a pixel; `make figures` makes it anew."""
    file = tmp_path / name
    draw(run, file)
    shrink(file)
    new, old = colours(file), colours(ROOT / "docs" / "pictures" / name)
    assert new.shape == old.shape
    assert np.mean(np.abs(new - old).max(axis=-1) > 50) < 0.002

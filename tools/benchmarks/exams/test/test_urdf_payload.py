"""The plant moves as the model that the command writes, but for the payload; answers are judged and counted."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from continuum.discovery.decision import Kind
from continuum.dynamics.integration.tolerances import Tolerances
from continuum.dynamics.joint_torques import JointTorques
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.simulator import Simulator
from continuum.dynamics.urdf_chain import chain_from_urdf
from tools.benchmarks.exams import urdf_payload
from tools.benchmarks.exams.payload_arm import HANGING, JOINTS, RATE, motion, torques, urdf
from tools.benchmarks.exams.urdf_payload import Answer, Convention, model_by_command, section

pytestmark = pytest.mark.slow

EXACT = Tolerances(1e-6, 1e-7, 0.01)
STEEP = 3e4  # s/rad: the smoothed sign of dry friction is then nearly MuJoCo's jump


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Model, Convention]:
    folder = tmp_path_factory.mktemp("arm")
    (folder / "arm.urdf").write_text(urdf(), encoding="utf-8")
    convention = model_by_command(folder / "arm.urdf", folder / "arm.yaml")
    return folder / "arm.urdf", load_model(folder / "arm.yaml"), convention


def test_the_printed_convention_is_that_of_the_model(made: tuple[Path, Model, Convention]) -> None:
    path, _, convention = made
    chain = chain_from_urdf(path)
    assert chain.joints == JOINTS
    np.testing.assert_array_equal(convention.signs, chain.signs)
    np.testing.assert_allclose(convention.zeros, chain.zeros, atol=1e-7)
    assert np.any(convention.signs < 0)
    assert np.any(convention.zeros != 0)


def test_the_plant_moves_as_the_model_but_for_the_payload(made: tuple[Path, Model, Convention]) -> None:
    """Within 0.02 degrees, a fifth of the noise: MuJoCo's step, and what stays of the smoothed sign."""
    _, model, convention = made
    drive = torques(np.random.default_rng(0), 2 * RATE + 1)
    t, begin = np.arange(len(drive)) / RATE, convention.angles(np.array(HANGING))
    steep = Simulator(model.with_values({"friction_slope": STEEP}), EXACT)
    found = steep.run(begin, t, JointTorques(t, convention.torques(drive), held=True)).theta
    bare, loaded = (convention.angles(motion(urdf(payload), drive)) for payload in (0.0, 0.1))
    assert np.ptp(found, axis=0).min() > np.radians(20.0)
    np.testing.assert_allclose(bare, found, rtol=0, atol=np.radians(0.02))
    assert np.abs(loaded - found).max(axis=0).min() > np.radians(1.0)


def answer(payload: float, kind: str, *sets: tuple[str, ...]) -> Answer:
    """With payloads of 0.09 to 0.11 kg in its sets."""
    mass = SimpleNamespace(value=0.1, low=0.09, high=0.11, unit="kg", meaning="mass")
    causes = [[SimpleNamespace(effect=name, label=name, estimates=(mass,)) for name in names] for names in sets]
    verdict = SimpleNamespace(kind=Kind(kind), relative_fits=[1 / len(sets) for _ in sets], complete=True)
    error = SimpleNamespace(of_segments=0.01)
    result = SimpleNamespace(sets=causes, verdict=verdict, before=error, after=error, seconds=1.0)
    return Answer(0, payload, result)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("given", "is_right"),
    [
        (answer(0.1, "cause", ("tip_payload",)), True),
        (answer(0.1, "ambiguous", ("inertia",), ("tip_payload",)), True),
        (answer(0.1, "ambiguous", ("inertia",), ("tip_payload", "inertia")), False),
        (answer(0.1, "cause", ("inertia",)), False),
        (answer(0.1, "unknown", ("tip_payload",)), False),
        (answer(0.1, "adequate"), False),
        (answer(0.0, "adequate"), True),
        (answer(0.0, "cause", ("tip_payload",)), False),
    ],
)
def test_a_payload_has_to_be_named_alone_or_as_one_possible_set(given: Answer, is_right: bool) -> None:
    assert given.is_right is is_right


def test_the_section_counts_what_was_said(monkeypatch: pytest.MonkeyPatch) -> None:
    said = {
        1: answer(0.1, "cause", ("tip_payload",)),
        2: answer(0.12, "ambiguous", ("tip_payload",), ("inertia",)),
        3: answer(0.1, "unknown", ("tip_payload",)),
    }
    bare = answer(0.0, "adequate")
    monkeypatch.setattr(urdf_payload, "examine", lambda seed, loaded=True: said[seed] if loaded else bare)
    given, figures = section((1, 2, 3))
    text = " ".join(given.split())
    assert [(figure.value, figure.n) for figure in figures] == [(pytest.approx(200 / 3), 3), (50.0, 2)]
    assert "named in 2 of 3 cases, alone in 1" in text
    assert "holds the true mass in 1 of 2" in text
    assert text.count("| none |") == 1

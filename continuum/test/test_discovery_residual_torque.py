"""The torque that is missing: as large as what was left out, and gone with what each recording has for itself."""

from __future__ import annotations

import numpy as np
from dynamics_laws import prototype_model
from effects_laws import extended
from identification_laws import BENDS, FINE, N, recorded, small_simulator, white_noise

from continuum.discovery.diagnose import diagnose
from continuum.discovery.findings import findings
from continuum.discovery.question import Question
from continuum.discovery.residual_torque import ResidualTorque, residual_torques
from continuum.discovery.trial import TOLERANCES
from continuum.dynamics.model import Model
from continuum.dynamics.simulator import Simulator
from continuum.identification.dataset import Dataset
from continuum.identification.fit import fit
from continuum.identification.free import Free

TILTS = (0.15, -0.15)
"""Of the base, run by run [rad]."""


def missing(question: Question, models: list[Model]) -> list[ResidualTorque]:
    found = residual_torques(question, models)
    assert [one.run for one in found] == ["run_0", "run_1"]
    assert all(one.is_told[:, 0].any() for one in found)
    return found


def mean(one: ResidualTorque) -> float:
    return float(np.mean(one.torque[one.is_told[:, 0], 0]))


def test_what_each_recording_has_for_itself_is_no_longer_missing() -> None:
    fine, random = small_simulator("remounted_base", FINE), np.random.default_rng(5)
    runs = tuple(
        recorded(fine, BENDS[i], random, {"remounted_base.angle": tilt}, name=f"run_{i}")
        for i, tilt in enumerate(TILTS)
    )
    simulator = small_simulator("remounted_base", TOLERANCES)
    free = [Free("remounted_base.angle", recording=i) for i in range(len(TILTS))]
    question = Question(simulator.model, (), runs, white_noise(n_joints=N))
    fitted = fit(simulator, runs, question.noise, free)
    models = [fitted.model_of(i) for i in range(len(runs))]
    np.testing.assert_allclose([m.values()["remounted_base.angle"][0] for m in models], TILTS, rtol=0.1)

    before, after = missing(question, [simulator.model] * 2), missing(question, models)
    weight = float(np.sum(simulator.model.parameters.mass)) * 9.81
    assert mean(before[0]) * mean(before[1]) < 0  # one hangs to either side
    for one, other in zip(before, after, strict=True):
        assert abs(mean(one)) > 0.01 * weight * TILTS[0]  # at a lever of a centimetre at least
        assert abs(mean(other)) < 0.2 * abs(mean(one))


def test_a_diagnosis_finds_the_model_of_every_run() -> None:
    nominal, tilts = prototype_model(N), (*TILTS, 0.08, -0.04)
    arm = Simulator(extended(nominal.with_values({"friction_slope": 1000.0}), "remounted_base"), FINE)
    random = np.random.default_rng(5)
    runs = [recorded(arm, (2 * bend[0], 2 * bend[1]), random, {"remounted_base.angle": tilt}, 0.7, name=f"run_{i}")
            for i, (bend, tilt) in enumerate(zip(BENDS, tilts, strict=True))]  # fmt: skip
    found = findings(diagnose(Dataset(tuple(runs)), nominal, processes=1, effects=("remounted_base",)), random)
    angles = [model.values()["remounted_base.angle"][0] for model in found.models]
    np.testing.assert_allclose(angles, tilts, atol=0.03)
    np.testing.assert_allclose(angles, [e.value for e in found.estimates if e.unknown.recording is not None])
    assert found.model.values()["remounted_base.angle"][0] == 0.0

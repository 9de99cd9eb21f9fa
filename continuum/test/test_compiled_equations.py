"""Compiled code computes what the library's own functions do, and follows their sources."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from continuum_laws.differences import assert_same_derivatives, differences
from continuum_laws.samples import arm_of, mixed_arm, random_postures
from continuum_laws.targets import misses, targets_at

from continuum.arm import Arm
from continuum.kinematics.chain import arm_jacobian, arm_pose
from continuum.kinematics.compiled.arm_arrays import arm_arrays
from continuum.kinematics.compiled.rate import run_tip_rate
from continuum.kinematics.compiled.solver import run_solver
from continuum.kinematics.compiled.task import TargetArrays, evaluate, target_of
from continuum.kinematics.compiled.tip import tip_and_jacobian
from continuum.kinematics.compiled.warm_up import warm_up
from continuum.kinematics.differential import DIRECTION, POSE, POSITION, DifferentialKinematics, least_bending
from continuum.kinematics.fabrikc import _fabrikc, solve_fabrikc
from continuum.kinematics.inverse_kinematics import InverseKinematics

pytestmark = pytest.mark.slow

ARMS = {f"{kind}_{n}": make(n) for n in (1, 2, 3, 5, 7) for kind, make in (("same", arm_of), ("mixed", mixed_arm))}


@pytest.mark.parametrize("arm", ARMS.values(), ids=ARMS)
def test_tip_and_jacobian_are_those_of_the_chain(arm: Arm) -> None:
    n = arm.n_sections
    for w in [np.zeros((n, 2)), np.full((n, 2), 1e-9), *random_postures(arm, 6, seed=n)]:
        jacobian = np.full((6, 2 * n), np.nan)
        rotation, position = tip_and_jacobian(arm_arrays(arm), w.reshape(-1), jacobian)
        pose = arm_pose(w, arm)
        np.testing.assert_allclose(np.reshape(rotation, (3, 3)), pose[:3, :3], rtol=0, atol=1e-13)
        np.testing.assert_allclose(position, pose[:3, 3], rtol=0, atol=1e-13)
        np.testing.assert_allclose(jacobian, arm_jacobian(w, arm), rtol=0, atol=1e-13)


@pytest.mark.parametrize("kind", [POSITION, DIRECTION, POSE], ids=["position", "direction", "pose"])
def test_the_task_gives_distance_and_angle_and_the_descent_of_its_squared_error(kind: int) -> None:
    arm, weight = mixed_arm(3), 0.07
    targets = targets_at(arm, random_postures(arm, 6, seed=1), kind)
    postures = random_postures(arm, 6, seed=1) + 0.2 * random_postures(arm, 6, seed=2)
    distances, angles = misses(arm, postures, targets)
    for k, w in enumerate(postures):
        target = target_of(targets.rows[k], weight)

        def half_square(x: np.ndarray, target: TargetArrays = target) -> np.ndarray:
            squares = []
            for row in np.atleast_2d(x):
                error = np.empty(kind)
                evaluate(arm_arrays(arm), target, row.copy(), error, np.empty((6, 6)))
                squares.append(0.5 * error @ error)
            return np.array(squares).reshape(x.shape[:-1])

        error, jacobian = np.empty(kind), np.empty((6, 6))
        output = evaluate(arm_arrays(arm), target, w.reshape(-1), error, jacobian)
        assert output == pytest.approx((distances[k], angles[k]), rel=1e-9)
        assert np.linalg.norm(error) == pytest.approx(np.hypot(output[0], weight * output[1]), rel=1e-9)
        slope = differences(half_square, w.reshape(-1), step=0.01)
        assert_same_derivatives((-jacobian[:kind].T @ error)[None], slope[None], relative=1e-7)


def test_after_the_warm_up_nothing_is_compiled() -> None:
    warm_up()
    entry_points = (run_solver, run_tip_rate, _fabrikc)
    counts = [len(function.signatures) for function in entry_points]
    arm = mixed_arm(4)
    w = random_postures(arm, 3, seed=1)
    for kind in (POSITION, DIRECTION, POSE):
        targets = targets_at(arm, w, kind)
        InverseKinematics(arm, objective="least_bending").solve_many(targets, w)
        DifferentialKinematics(arm, kind).rate(w[0], [0, 0, 1], [0, 1, 0], least_bending(w[0], 1.0))
        solve_fabrikc(arm, targets.positions[0], (1, 0, 0), w[1], 1, 2)
    assert [len(function.signatures) for function in entry_points] == counts


_WITHOUT_COMPILER = """
import json
import numpy as np
from continuum_laws.samples import mixed_arm, random_postures
from continuum_laws.targets import targets_at
from continuum.kinematics.inverse_kinematics import InverseKinematics
arm = mixed_arm(3)
targets = targets_at(arm, random_postures(arm, 6, seed=3, largest=1.2), 5)
batch = InverseKinematics(arm, 1e-10).solve_many(targets)
print(json.dumps([batch.configurations.tolist(), batch.statuses.tolist(), batch.iterations.tolist()]))
"""


def test_the_solver_as_written_gives_the_same() -> None:
    """The whole solver run by the interpreter, in a process where numba is switched off."""
    environment = {**os.environ, "NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run(
        [sys.executable, "-c", _WITHOUT_COMPILER], env=environment, capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    configurations, statuses, iterations = json.loads(done.stdout)
    arm = mixed_arm(3)
    targets = targets_at(arm, random_postures(arm, 6, seed=3, largest=1.2), DIRECTION)
    batch = InverseKinematics(arm, 1e-10).solve_many(targets)
    assert statuses == batch.statuses.tolist()
    assert iterations == batch.iterations.tolist()
    np.testing.assert_allclose(batch.configurations, configurations, rtol=0, atol=1e-8)

"""Which model is nearer: right for arms that follow one of them, undecided where the measurement cannot decide."""

import numpy as np
import pytest
from continuum_laws.differences import differences
from dynamics_laws import active
from effects_laws import effect_of

from continuum.curvature.answer import answer, true_angles
from continuum.curvature.comparison import LEVEL, Comparison, Distance, Nearer, compare, overall
from continuum.curvature.held_posture import held_posture
from continuum.curvature.holds import hold_at
from continuum.curvature.median_error import MedianErrors
from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model
from continuum.dynamics.planar.backbone import backbone
from continuum.dynamics.statics.resting_arm import RestingArm
from continuum.errors import InvalidValueError
from continuum.recordings.recording import Recording

pytestmark = pytest.mark.slow

MODEL = load_model("lamecc_prototype.yaml")
ARM, N = RestingArm(MODEL), MODEL.n_joints
TOTAL = np.radians(80)
EVEN, HELD = np.full(N, TOTAL / N), held_posture(ARM, TOTAL, None, 1).theta
BETWEEN = (EVEN + HELD) / 2


def of(theta: np.ndarray, sd: float = np.radians(0.2)) -> Comparison:
    return compare(ARM, theta, sd**2 * np.eye(N))


def errors_of(*covariances: np.ndarray) -> MedianErrors:
    return MedianErrors(np.stack(covariances), np.zeros((len(covariances), len(covariances), N)))


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize(("theta", "nearer"), [(EVEN, Nearer.CONSTANT), (HELD, Nearer.DYNAMIC)])
def test_an_arm_that_is_made_like_a_model_is_nearer_to_it(theta: np.ndarray, nearer: Nearer, side: int) -> None:
    found = of(side * theta)
    assert found.nearer is nearer
    near, far = sorted([found.angles_to_constant, found.angles_to_dynamic], key=lambda one: one.value)
    assert near.value < 1e-7
    assert found.closer_by.value == pytest.approx(far.value)
    tips = sorted([found.tip_to_constant.value, found.tip_to_dynamic.value])
    assert tips[0] < 1e-7 < 1e-3 < tips[1]


@pytest.mark.parametrize("seed", range(5))
def test_a_mirrored_arm_has_the_mirrored_answer(seed: int) -> None:
    theta = BETWEEN + np.random.default_rng(seed).normal(0, 0.03, N)
    one, other = of(theta), of(-theta)
    assert other.nearer is one.nearer
    for name in ("angles_to_constant", "angles_to_dynamic", "tip_to_constant", "tip_to_dynamic", "closer_by"):
        np.testing.assert_allclose(values(getattr(other, name)), values(getattr(one, name)), rtol=1e-5, atol=1e-9)


def values(distance: Distance) -> tuple[float, float]:
    return distance.value, distance.sd


def test_what_the_measurement_does_not_resolve_is_left_open() -> None:
    assert of(BETWEEN).nearer is Nearer.UNDECIDED
    assert of(HELD, np.radians(6.0)).nearer is of(EVEN, np.radians(6.0)).nearer is Nearer.UNDECIDED
    for total in np.radians([0.0, 1.0, -2.0]):  # nearly straight, both models are the same
        rest = held_posture(ARM, float(total), None, 1).theta
        assert of(rest).nearer is of(np.full(N, total / N)).nearer is Nearer.UNDECIDED


def test_models_that_the_measurement_does_not_separate_are_not_separated_by_an_arm_far_from_both() -> None:
    total = np.radians(4)
    rest, even = held_posture(ARM, total, None, 1).theta, np.full(N, total / N)
    far = even + 20 * (rest - even)
    s, sensitivities = of(far).difference
    assert abs(s) > 5 * np.sqrt(sensitivities @ of(far).covariance @ sensitivities)
    assert of(far).nearer is Nearer.UNDECIDED


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_intervals_hold_the_true_differences_and_no_more_than_chance_is_wrong(share: float) -> None:
    """Of arms between the models, 600 measured ones each."""
    rng, sd = np.random.default_rng(4), np.radians(0.5)
    true = EVEN + share * (HELD - EVEN)
    truly = of(true, 0.0).difference[0]
    found = [of(true + sd * rng.standard_normal(N), sd) for _ in range(600)]
    differences_of = np.array([one.difference[0] for one in found])
    sds = np.array([np.sqrt(one.difference[1] @ one.covariance @ one.difference[1]) for one in found])
    assert 0.93 < np.mean(np.abs(differences_of - truly) < LEVEL * sds) < 0.97
    wrong = Nearer.CONSTANT if truly < 0 else Nearer.DYNAMIC
    assert np.mean([one.nearer is wrong for one in found]) < 0.04
    if share in (0.0, 1.0):
        assert np.mean([one.nearer is not Nearer.UNDECIDED for one in found]) > 0.95


@pytest.mark.parametrize("seed", range(3))
def test_errors_are_propagated_by_the_exact_derivatives(seed: int) -> None:
    """Of distances and their difference, by finite differences about a posture that is held by one tension."""
    rng = np.random.default_rng(seed)
    theta, tension = BETWEEN + rng.normal(0, 0.02, N), np.array([20.0, 0.0])
    found = compare(ARM, theta, np.eye(N), tension, 1)

    def distances(q: np.ndarray) -> np.ndarray:
        at = compare(ARM, q, np.eye(N), tension, 1)
        tips = at.tip_to_constant.value, at.tip_to_dynamic.value
        return np.array([at.difference[0], at.angles_to_constant.value, at.angles_to_dynamic.value, *tips])

    sensitivities = differences(distances, theta)
    np.testing.assert_allclose(found.difference[1], sensitivities[0], rtol=0, atol=1e-5)
    each = (found.angles_to_constant, found.angles_to_dynamic, found.tip_to_constant, found.tip_to_dynamic)
    np.testing.assert_allclose([one.sd for one in each], np.linalg.norm(sensitivities[1:], axis=1), rtol=1e-4)


def test_distances_are_those_between_the_postures() -> None:
    found = of(BETWEEN)
    assert found.angles_to_constant.value == pytest.approx(np.sqrt(np.mean((BETWEEN - EVEN) ** 2)))
    tips = [backbone(theta, MODEL.parameters)[-1] for theta in (BETWEEN, EVEN)]
    assert found.tip_to_constant.value == pytest.approx(np.linalg.norm(tips[0] - tips[1]))


def test_the_difference_of_the_distances_is_the_one_that_is_stated() -> None:
    found = of(BETWEEN + 0.3 * (EVEN - HELD))
    assert found.closer_by.value == pytest.approx(found.angles_to_dynamic.value - found.angles_to_constant.value)


def test_one_hold_again_and_again_is_answered_as_the_one() -> None:
    one = of(0.7 * HELD + 0.3 * EVEN, np.radians(0.4))
    shared = np.full((4, 4, N), np.radians(0.4) ** 2)
    several = overall([one] * 4, MedianErrors(np.zeros((4, N, N)), shared))
    assert several.nearer is one.nearer is Nearer.DYNAMIC
    np.testing.assert_allclose(values(several.closer_by), values(one.closer_by), rtol=1e-9)
    assert several.counts == {Nearer.DYNAMIC: 4, Nearer.CONSTANT: 0, Nearer.UNDECIDED: 0}


def test_independent_holds_are_more_certain_together_and_contradicting_ones_decide_nothing() -> None:
    one = of(0.6 * HELD + 0.4 * EVEN, np.radians(0.8))
    four = overall([one] * 4, errors_of(*[one.covariance] * 4))
    assert one.nearer is Nearer.UNDECIDED
    assert four.nearer is Nearer.DYNAMIC
    assert four.closer_by.sd == pytest.approx(one.closer_by.sd / 2)
    dynamic, constant = of(HELD), of(0.3 * HELD + 0.7 * EVEN)
    assert constant.nearer is Nearer.CONSTANT
    both = overall([dynamic, constant], errors_of(dynamic.covariance, constant.covariance))
    assert both.to_dynamic + 2 * both.closer_by.sd < both.to_constant
    assert both.nearer is Nearer.UNDECIDED


def test_joints_that_friction_cannot_hold_are_named() -> None:
    bent = HELD + np.radians([0.0, -8.0, 8.0, 0.0, 0.0])
    np.testing.assert_array_equal(of(bent).beyond_friction, [1, 2])
    assert of(HELD).beyond_friction.size == 0


def test_what_sensors_add_to_the_angles_is_taken_off() -> None:
    """A gain and an offset: joints are differences of links, whose angles are too large by the gain."""
    gain, offset = np.array([0.1, 0.0, -0.2, 0.05, 0.0]), np.radians([1.0, 0, -2, 0, 0])
    effects = active(effect_of("sensor_scale"), N, gain=gain), active(effect_of("angle_offset"), N, offset=offset)
    read = np.diff((1 + gain) * np.cumsum(HELD), prepend=0.0) + offset
    times = np.arange(60) / 60
    hold = hold_at(Recording("run", times, np.tile(read, (60, 1))), slice(0, 60))
    model = Model(MODEL.parameters, effects)
    np.testing.assert_allclose(true_angles(model, hold), HELD, rtol=0, atol=1e-9)
    assert answer(model, [hold]).overall.nearer is Nearer.DYNAMIC


def test_arms_that_do_not_fit_are_refused() -> None:
    with pytest.raises(InvalidValueError, match="number of joints"):
        compare(ARM, EVEN[:3], np.eye(3))

"""Runs dealt into two halves, no run in both."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.tensions import Tensions
from continuum.errors import InvalidValueError
from continuum.identification.dataset import Dataset, halves
from continuum.recordings.recording import Recording

T = np.arange(40) / 120


def run(name: str, bend: float, driven: bool = False, joints: int = 2) -> Recording:
    theta = bend / joints * np.cos(5 * T)[:, None] * np.ones(joints)
    return Recording(name, T, theta, tensions=Tensions([0.0], [[5.0, 0.0]]) if driven else None)


kinds = st.lists(st.tuples(st.floats(-1, 1), st.booleans()), min_size=2, max_size=12)


@given(kinds)
def test_no_run_is_lost_and_none_is_in_both(drawn: list[tuple[float, bool]]) -> None:
    runs = [run(f"run {i}", *kind) for i, kind in enumerate(drawn)]
    split = halves(runs)
    fitted, tested = ([one.name for one in half] for half in (split.identification, split.validation))
    assert sorted(fitted + tested) == sorted(one.name for one in runs)
    assert abs(len(fitted) - len(tested)) <= 1
    assert bool(split.weakness) == (len(runs) == 2)
    swapped = split.swapped
    assert (swapped.identification, swapped.validation) == (split.validation, split.identification)


@given(st.permutations(range(8)))
def test_each_half_has_its_share_of_every_kind(order: list[int]) -> None:
    """Two driven and two free runs to either side."""
    made = [run(f"{i}", bend, driven) for i, (bend, driven) in enumerate(
        (bend, driven) for driven in (False, True) for bend in (0.4, 0.9, -0.4, -0.9)
    )]  # fmt: skip
    split = halves([made[i] for i in order])
    for half in (split.identification, split.validation):
        assert sorted((one.is_driven, bool(one.theta[0, 0] > 0)) for one in half) == [
            (False, False), (False, True), (True, False), (True, True)
        ]  # fmt: skip


@given(st.permutations(range(6)))
def test_bends_are_dealt_in_turns(order: list[int]) -> None:
    made = [run(f"{i}", 0.1 * (i + 1)) for i in range(6)]
    split = halves([made[i] for i in order])
    sums = [sum(one.theta[0, 0] for one in half) for half in (split.identification, split.validation)]
    assert abs(sums[0] - sums[1]) <= 0.15  # of 1.05 in all; sorted in two it would be 0.45


def test_one_run_alone_is_cut_and_says_so() -> None:
    whole = run("alone", 0.5)
    split = halves([whole])
    (begin,), (end,) = split.identification, split.validation
    np.testing.assert_array_equal(np.concatenate([begin.times, end.times]), whole.times)
    np.testing.assert_array_equal(np.concatenate([begin.theta, end.theta]), whole.theta)
    assert begin.times.size > end.times.size > 10
    assert "one recording only" in split.weakness


def test_runs_of_different_arms_are_no_dataset() -> None:
    with pytest.raises(InvalidValueError, match="joints of b is 3; allowed: 2 as in the others"):
        Dataset((run("a", 0.3), run("b", 0.3, joints=3)))
    with pytest.raises(InvalidValueError, match="at least one"):
        Dataset(())


def test_one_run_given_twice_is_no_dataset() -> None:
    with pytest.raises(InvalidValueError, match="recordings is 'a and b'; allowed: different runs: these are one"):
        Dataset((run("a", 0.3), run("c", 0.4), run("b", 0.3)))


@pytest.mark.parametrize(
    ("times", "theta", "rate", "told"),
    [
        (T[::-1], np.zeros((40, 2)), None, "times"),
        (T, np.full((40, 2), np.nan), None, "theta"),
        (T, np.zeros((39, 2)), None, "theta"),
        (T, np.zeros((40, 2)), np.zeros((40, 3)), "theta_rate"),
    ],
)
def test_no_recording_is_made_of_bad_arrays(times: np.ndarray, theta: np.ndarray, rate: object, told: str) -> None:
    with pytest.raises(InvalidValueError, match=f"swing: {told}"):
        Recording("swing", times, theta, rate)  # type: ignore[arg-type]

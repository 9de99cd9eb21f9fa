"""Values of a named parameter: every kind, bound and list, and the text that describes them."""

import math

import pytest
from continuum_laws.labels import label
from continuum_laws.strategies import LAW
from hypothesis import given
from hypothesis import strategies as st

from continuum.errors import InvalidValueError
from continuum.parameter_spec import ParameterSpec

COUNT = ParameterSpec("count", int, "a count", lower=1, upper=10)
RADIUS = ParameterSpec("radius", float, "a radius", "m", lower=0.0, upper=2.0, lower_open=True)
RATE = ParameterSpec("rate", float, "any rate", "rad/s")
MODE = ParameterSpec("mode", str, "a mode", choices=("fast", "slow"))
FLAG = ParameterSpec("flag", bool, "a flag")
PATH = ParameterSpec("path", str, "a path")
POINT = ParameterSpec("point", float, "a point", "m", lower=-1.0, is_list=True)


@pytest.mark.parametrize(
    ("spec", "value", "kept"),
    [
        (COUNT, 1, 1),
        (COUNT, 10.0, 10),
        (RADIUS, 2, 2.0),
        (RADIUS, 5e-324, 5e-324),
        (RATE, -1e300, -1e300),
        (MODE, "slow", "slow"),
        (FLAG, False, False),
        (PATH, "", ""),
        (POINT, [], []),
        (POINT, (-1, 2.5), [-1.0, 2.5]),
    ],
)
def test_an_allowed_value_is_kept_in_its_type(spec: ParameterSpec, value: object, kept: object) -> None:
    found = spec.check(value)
    assert found == kept
    assert type(found) is type(kept)
    if isinstance(found, list):
        assert all(type(item) is spec.kind for item in found)
    else:
        assert type(found) is spec.kind


@pytest.mark.parametrize(
    ("spec", "value"),
    [
        *[(COUNT, value) for value in (0, 11, 1.5, True, "1", None, [1], math.nan, math.inf, 10**400, 1j)],
        *[(RADIUS, value) for value in (0, -0.0, -1, 2.0000001, True, "1", None, math.nan, -math.inf)],
        *[(RATE, value) for value in (math.inf, -math.inf, math.nan, 10**400, -(10**400), "", [])],
        *[(MODE, value) for value in ("", "Fast", 0, True, None, ["fast"])],
        *[(FLAG, value) for value in (0, 1, "true", None, [])],
        *[(PATH, value) for value in (0, False, None, b"x", ["x"])],
        *[(POINT, value) for value in (1.0, "12", b"12", None, {1.0}, {"a": 1.0})],
    ],
    ids=label,
)
def test_any_other_is_refused_in_one_line(spec: ParameterSpec, value: object) -> None:
    with pytest.raises(InvalidValueError) as caught:
        spec.check(value, "node.")
    assert str(caught.value) == f"node.{spec.name} is {value!r}; allowed: {spec.allowed}"
    assert (caught.value.name, caught.value.value, caught.value.allowed) == (f"node.{spec.name}", value, spec.allowed)


@pytest.mark.parametrize("item", [-1.5, math.nan, "1", None, True, [1.0]])
def test_an_item_is_refused_by_its_place(item: object) -> None:
    with pytest.raises(InvalidValueError, match=r"^arm\.point\[1\] is "):
        POINT.check([0.0, item], "arm.")


@LAW
@given(value=st.integers() | st.floats())
def test_a_number_is_kept_where_it_is_in_range(value: float) -> None:
    try:
        kept = RADIUS.check(value)
    except InvalidValueError:
        assert not 0 < value <= 2
    else:
        assert 0 < kept == value <= 2

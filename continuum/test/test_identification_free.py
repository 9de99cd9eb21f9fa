"""What a fit may move: coordinates around a model's values, bounds, and what belongs to which recording."""

from pathlib import Path

import numpy as np
import pytest
from dynamics_laws import active, prototype_model
from effects_laws import effect_of
from hypothesis import given
from hypothesis import strategies as st

from continuum.dynamics.model import Model
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.values import parameter_slots, with_vector
from continuum.errors import InvalidValueError
from continuum.identification.baseline import BATCH, DRY_SLOPE, baseline_unknowns, with_dry_friction
from continuum.identification.free import Free, FreeSpace

MODEL = Model(
    prototype_model(3).parameters, tuple(active(effect_of(name), 3) for name in ("angle_offset", "tip_payload"))
)
UNEVEN = MODEL.with_values({"stiffness": [1.0, 1.5, 2.0]})
UNKNOWNS = [
    Free("stiffness"),
    Free("stiffness", 1, tolerance=0.02),
    Free("coulomb_friction"),
    Free("tip_payload.mass"),
    Free("angle_offset.offset", 2, 0),
    Free("angle_offset.offset", 2, 1),
]


def values_at(space: FreeSpace, model: Model, coordinates: np.ndarray, recording: int = -1) -> Model:
    return with_vector(model, space.origin + space.directions_of(recording) @ coordinates)


def test_nothing_moved_is_the_model_itself() -> None:
    space = FreeSpace(UNEVEN, UNKNOWNS)
    for name, values in values_at(space, UNEVEN, np.zeros(len(UNKNOWNS))).values().items():
        np.testing.assert_array_equal(values, UNEVEN.values()[name])


@pytest.mark.parametrize("i", range(len(UNKNOWNS)))
def test_a_unit_of_one_coordinate_moves_its_parameter_by_the_scale(i: int) -> None:
    space, unknown = FreeSpace(UNEVEN, UNKNOWNS), UNKNOWNS[i]
    moved = values_at(space, UNEVEN, np.eye(len(UNKNOWNS))[i], unknown.recording or 0).values()
    for name, values in UNEVEN.values().items():
        expected = np.array(values, dtype=float)
        if name == unknown.name:
            where = slice(None) if unknown.joint is None else unknown.joint
            expected[where] += space.scale[i]
        np.testing.assert_allclose(moved[name], expected, rtol=1e-14)
    assert space.amounts(np.eye(len(UNKNOWNS))[i])[i] == space.scale[i]


@given(st.lists(st.floats(-1e3, 1e3), min_size=len(UNKNOWNS), max_size=len(UNKNOWNS)))
def test_within_the_bounds_every_value_is_allowed(far: list[float]) -> None:
    space = FreeSpace(UNEVEN, [Free(u.name, u.joint, u.recording) for u in UNKNOWNS if u.tolerance is None])
    clipped = space.clipped(np.array(far[: len(space.unknowns)]))
    meanings = UNEVEN.meanings()
    for name, values in values_at(space, UNEVEN, clipped, 0).values().items():
        assert np.all(values >= meanings[name].lower - 1e-9 * abs(meanings[name].lower) - 1e-12)
        assert np.all(values <= meanings[name].upper * (1 + 1e-9) + 1e-12)


def test_what_all_share_and_one_has_for_itself_never_leaves_the_bounds(tmp_path: Path) -> None:
    """Friction that all joints share at zero, and one joint's own below it: the model can be written and read."""
    space = FreeSpace(MODEL, [Free("viscous_friction"), Free("viscous_friction", 1, tolerance=0.03)])
    model = with_vector(MODEL, space.common_values(np.array([space.lower[0], -2.0])))
    np.testing.assert_array_equal(model.values()["viscous_friction"], 0.0)
    save_model(model, tmp_path / "model.yaml")
    load_model(tmp_path / "model.yaml")


def test_bounds_are_reached() -> None:
    space = FreeSpace(UNEVEN, [Free("coulomb_friction"), Free("tip_payload.mass")])
    meanings = UNEVEN.meanings()
    for ends, which in ((space.lower, "lower"), (space.upper, "upper")):
        moved = values_at(space, UNEVEN, ends).values()
        for unknown in space.unknowns:
            np.testing.assert_allclose(moved[unknown.name], getattr(meanings[unknown.name], which), atol=1e-12)


def test_a_unit_is_the_nominal_value_or_the_typical_size() -> None:
    """However wide the bounds are: the prior and the swarm's range are in these units."""
    names = ("inertia", "stiffness", "viscous_friction", "stribeck_speed", "friction_slope")
    space = FreeSpace(MODEL, [Free(name) for name in names])
    np.testing.assert_array_equal(space.scale, [MODEL.values()[name][0] for name in names])
    np.testing.assert_array_equal(space.spread, 1.0)
    assert FreeSpace(UNEVEN, [Free("stiffness")]).scale[0] == 2.0  # of the largest
    payload = FreeSpace(MODEL, [Free("tip_payload.mass")])
    assert payload.scale[0] == MODEL.meanings()["tip_payload.mass"].typical
    assert FreeSpace(MODEL, [Free("capstan_friction")]).scale[0] > 0  # nominally there is none


def test_parts_that_are_not_there_do_not_differ() -> None:
    bare = MODEL.with_values({"coulomb_friction": 0.0})
    space = FreeSpace(bare, [Free("coulomb_friction", 0, tolerance=0.03), Free("coulomb_friction")])
    assert (space.lower[0], space.upper[0]) == (0.0, 0.0)
    assert not np.any(space.directions[:, 0])
    assert space.upper[1] > 0


def test_parts_of_a_batch_stay_within_two_and_a_half_deviations() -> None:
    space = FreeSpace(UNEVEN, [Free("stiffness", j, tolerance=0.02) for j in range(3)])
    np.testing.assert_allclose(space.scale, 0.02 * UNEVEN.parameters.stiffness)
    np.testing.assert_array_equal(space.spread, 1.0)
    np.testing.assert_array_equal(space.clipped(np.full(3, 99.0)), 2.5)
    np.testing.assert_array_equal(space.clipped(np.full(3, -99.0)), -2.5)


@pytest.mark.parametrize(("name", "end"), [("stiffness", "upper"), ("half_spacing", "lower")])
def test_where_a_bound_is_nearer_than_the_batch_it_holds(name: str, end: str) -> None:
    bound = getattr(MODEL.meanings()[name], end)
    model = prototype_model(3).with_values({name: bound * (0.99 if end == "upper" else 1.01)})
    space = FreeSpace(model, [Free(name, 0, tolerance=0.02)])
    assert values_at(space, model, getattr(space, end)).values()[name][0] == pytest.approx(bound)


def test_what_belongs_to_a_recording_moves_no_other() -> None:
    space = FreeSpace(MODEL, UNKNOWNS)
    at = np.array([0.0, 0.0, 0.0, 0.0, 1.0, 2.0])
    slot, typical = parameter_slots(MODEL)["angle_offset.offset"], MODEL.meanings()["angle_offset.offset"].typical
    for recording, expected in ((0, 1.0), (1, 2.0), (2, 0.0), (-1, 0.0)):
        moved = (space.origin + space.directions_of(recording) @ at)[slot]
        np.testing.assert_allclose(moved, [0.0, 0.0, expected * typical])
    np.testing.assert_array_equal(space.common_values(at)[slot], 0.0)


@pytest.mark.parametrize(
    "unknown", [Free("stifness"), Free("inertia.factor"), Free("stiffness", 3), Free("gravity", 1)]
)
def test_what_the_model_does_not_have_is_refused(unknown: Free) -> None:
    with pytest.raises(InvalidValueError, match=r"free parameter is|joint of"):
        FreeSpace(MODEL, [unknown])


def test_unknowns_tell_joint_and_run_counted_from_one() -> None:
    assert [str(u) for u in UNKNOWNS[:2]] == ["stiffness", "stiffness[2]"]
    assert str(UNKNOWNS[5]) == "angle_offset.offset[3] of run 2"


def test_every_joint_has_what_may_differ_in_a_batch() -> None:
    unknowns = baseline_unknowns(MODEL)
    assert len(unknowns) == len(set(unknowns))
    for name, tolerance in BATCH.items():
        mine = [u for u in unknowns if u.name == name and u.joint is not None]
        assert [(u.joint, u.tolerance) for u in mine] == [(j, tolerance) for j in range(3)]
    FreeSpace(MODEL, unknowns)


def test_dry_friction_is_steeper_never_smoother() -> None:
    smooth, steep = (MODEL.with_values({"friction_slope": slope}) for slope in (5.0, 5000.0))
    assert with_dry_friction(smooth).values()["friction_slope"][0] == DRY_SLOPE
    assert with_dry_friction(steep).values()["friction_slope"][0] == 5000.0

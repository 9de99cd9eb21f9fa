"""Model files of planar chains: links of any length, with discs and cables or without."""

from pathlib import Path

import numpy as np
import pytest
from dynamics_laws import random_model
from test_model_file import assert_same

from continuum.dynamics.model_file import load_model, model_from_mapping, save_model
from continuum.dynamics.parameters import PARAMETERS
from continuum.errors import InvalidValueError


def bare_chain(n_joints: int = 2) -> dict[str, object]:
    """A chain without discs, cables, springs and friction."""
    values = {"mass": 0.5, "inertia": 0.003, "center_of_mass": 0.1, "link_length": [0.3, 0.2][:n_joints]}
    return {
        "n_joints": n_joints,
        "parameters": {name: {"value": value, "unit": PARAMETERS[name].unit} for name, value in values.items()},
    }


@pytest.mark.parametrize("n", [1, 2])
def test_a_bare_chain_needs_length_mass_centre_of_mass_and_inertia(tmp_path: Path, n: int) -> None:
    model = model_from_mapping(bare_chain(n))
    p = model.parameters
    assert (p.half_spacing, p.hole_radius, p.has_cables) == (None, None, False)
    np.testing.assert_array_equal(p.joint_spacing, [0.3, 0.2][:n])
    for name in ("stiffness", "viscous_friction", "coulomb_friction", "stribeck_gain", "rotor_inertia"):
        np.testing.assert_array_equal(getattr(p, name), np.zeros(n))
    assert np.all(p.stribeck_speed > 0)
    assert list(model.values()) == list(model.meanings())
    assert np.all(np.isfinite(np.concatenate(list(model.values().values()))))
    save_model(model, tmp_path / "chain.yaml")
    assert_same(load_model(tmp_path / "chain.yaml"), model)


def test_the_length_of_links_follows_from_the_discs_unless_it_is_given(tmp_path: Path) -> None:
    model = random_model(51, 3)
    b = model.parameters.half_spacing
    np.testing.assert_array_equal(model.parameters.joint_spacing, [b[0] + b[1], b[1] + b[2], 2 * b[2]])
    assert "link_length" not in model.values()
    wider = model.with_values({"half_spacing": 0.02}).parameters
    np.testing.assert_array_equal(wider.joint_spacing, [0.04, 0.04, 0.04])
    given = model.with_values({"link_length": [0.1, 0.2, 0.3]})
    np.testing.assert_array_equal(given.parameters.joint_spacing, [0.1, 0.2, 0.3])
    save_model(given, tmp_path / "given.yaml")
    assert_same(load_model(tmp_path / "given.yaml"), given)


def test_a_chain_without_any_length_is_refused() -> None:
    block = bare_chain()
    del block["parameters"]["link_length"]  # type: ignore[attr-defined]
    with pytest.raises(InvalidValueError, match=r"^parameters\.link_length is None; allowed: .* half_spacing is given"):
        model_from_mapping(block)

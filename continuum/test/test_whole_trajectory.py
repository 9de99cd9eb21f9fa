"""A whole trajectory is one call: every map gives the same for an array of postures as for each posture by itself."""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
from continuum_laws.samples import PROTOTYPE, mixed_arm, random_postures

from continuum.kinematics import cables, chain, configuration, routing, section
from continuum.kinematics.cable_twist import arm_configuration_cable_jacobian, tip_cable_jacobian
from continuum.kinematics.cables import hole_points
from continuum.kinematics.discs import even_bends
from continuum.kinematics.joint_chain import length_rates_of_joints, lengths_of_joints

ARM = mixed_arm(3)
W = random_postures(ARM, 12, seed=5).reshape(3, 4, 3, 2)
W[0, 0] = 0.0
RATE = random_postures(ARM, 12, seed=6).reshape(3, 4, 3, 2)
ONE, ONE_RATE = W[..., 0, :], RATE[..., 0, :]
PHI, THETA = configuration.jones_from_allen(ONE)
POINTS = np.random.default_rng(7).normal(size=(3, 4, 3))
LENGTHS = cables.cable_lengths(ONE, PROTOTYPE)
BENDS, BEND_RATES = even_bends(ONE, ARM.sections[1]), even_bends(ONE_RATE, ARM.sections[1])
TOTALS, TOTAL_RATES = routing.tangle(W, ARM), routing.tangle_rates(W, RATE, ARM)

Case = tuple[Callable[..., np.ndarray], tuple[np.ndarray, ...], int]

MAPS: dict[str, Case] = {  # the function, its arguments, and how many of their axes are not the trajectory's
    "bend": (configuration.bend, (ONE,), 1),
    "jones_from_allen": (lambda w: np.stack(configuration.jones_from_allen(w), axis=-1), (ONE,), 1),
    "allen_from_jones": (configuration.allen_from_jones, (PHI, THETA), 0),
    "allen_rate_jacobian": (configuration.allen_rate_jacobian, (PHI, THETA), 0),
    "allen_rates": (configuration.allen_rates, (PHI, THETA, PHI, THETA), 0),
    "jones_rates": (lambda *w: np.stack(configuration.jones_rates(*w), axis=-1), (ONE, ONE_RATE), 1),
    "curvature": (partial(configuration.curvature, section=PROTOTYPE), (THETA,), 0),
    "arc_length": (partial(configuration.arc_length, section=PROTOTYPE), (THETA,), 0),
    "arc_rates": (lambda *t: np.stack(configuration.arc_rates(*t, PROTOTYPE), axis=-1), (THETA, THETA), 0),
    "section_pose": (partial(section.section_pose, section=PROTOTYPE), (ONE,), 1),
    "section_jacobian": (partial(section.section_jacobian, section=PROTOTYPE), (ONE,), 1),
    "spatial_twist_jacobian": (partial(section.spatial_twist_jacobian, section=PROTOTYPE), (PHI, THETA), 0),
    "configuration_from_point": (section.configuration_from_point, (POINTS,), 1),
    "configuration_from_point_jacobian": (section.configuration_from_point_jacobian, (POINTS,), 1),
    "jones_from_point_jacobian": (section.jones_from_point_jacobian, (POINTS,), 1),
    "cable_lengths": (partial(cables.cable_lengths, section=PROTOTYPE), (ONE,), 1),
    "cable_jacobian": (partial(cables.cable_jacobian, section=PROTOTYPE), (ONE,), 1),
    "hole_points": (partial(hole_points, section=PROTOTYPE), (ONE,), 1),
    "configuration_from_cables": (partial(cables.configuration_from_cables, section=PROTOTYPE), (LENGTHS,), 1),
    "configuration_cable_jacobian": (partial(cables.configuration_cable_jacobian, section=PROTOTYPE), (LENGTHS,), 1),
    "arm_pose": (partial(chain.arm_pose, arm=ARM), (W,), 2),
    "section_tip_poses": (partial(chain.section_tip_poses, arm=ARM), (W,), 2),
    "section_base_rotations": (partial(chain.section_base_rotations, arm=ARM), (chain.section_tip_poses(W, ARM),), 3),
    "section_origins": (lambda w: chain.section_bases(w, ARM)[1], (W,), 2),
    "arm_jacobian": (partial(chain.arm_jacobian, arm=ARM), (W,), 2),
    "section_lengths": (partial(routing.section_lengths, arm=ARM, index=1), (ONE,), 1),
    "section_length_rates": (partial(routing.section_length_rates, arm=ARM, index=1), (ONE, ONE_RATE), 1),
    "lengths_of_joints": (partial(lengths_of_joints, arm=ARM, index=1), (BENDS,), 2),
    "length_rates_of_joints": (partial(length_rates_of_joints, arm=ARM, index=1), (BENDS, BEND_RATES), 2),
    "tangle": (partial(routing.tangle, arm=ARM), (W,), 2),
    "tangle_jacobian": (partial(routing.tangle_jacobian, arm=ARM), (W,), 2),
    "arm_configuration_cable_jacobian": (partial(arm_configuration_cable_jacobian, arm=ARM), (W,), 2),
    "tip_cable_jacobian": (partial(tip_cable_jacobian, arm=ARM), (W,), 2),
    "tangle_rates": (partial(routing.tangle_rates, arm=ARM), (W, RATE), 2),
    "untangle": (partial(routing.untangle, arm=ARM), (TOTALS,), 1),
    "untangle_rates": (partial(routing.untangle_rates, arm=ARM), (TOTALS, TOTAL_RATES), 1),
}

each_map = pytest.mark.parametrize("case", MAPS.values(), ids=MAPS)


@each_map
def test_one_call_equals_the_loop(case: Case) -> None:
    function, arguments, each_axes = case
    whole = function(*arguments)
    lead = arguments[0].shape[: arguments[0].ndim - each_axes]
    assert len(lead) == 2
    for index in np.ndindex(lead):
        alone = function(*[argument[index] for argument in arguments])
        assert alone.shape == whole[index].shape
        np.testing.assert_allclose(alone, whole[index], rtol=1e-13, atol=1e-13)

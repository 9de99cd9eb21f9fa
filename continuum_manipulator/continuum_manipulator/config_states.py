"""The message ``continuum_msgs/ConfigStates`` from a section's configuration."""

from __future__ import annotations

import math

from continuum.arm import Section
from continuum.kinematics.configuration import arc_length, arc_rates, curvature, jones_from_allen, jones_rates
from continuum_manipulator.section_joints import Configuration
from continuum_msgs.msg import ConfigStates

RATES = ("u_rate", "v_rate", "s_rate", "phi_rate", "kappa_rate", "theta_rate")


def config_states(state: Configuration, section: Section, number: int) -> ConfigStates:
    """Both parametrisations of section ``number``, in its base frame; rates are NaN where they are not known."""
    phi, theta = jones_from_allen(state.w)
    message = ConfigStates(section=number)
    message.header.frame_id = section.base_frame
    message.u, message.v = (float(value) for value in state.w)
    message.s = float(arc_length(theta, section))
    message.phi, message.theta = float(phi), float(theta)
    message.kappa = float(curvature(theta, section))
    for name, rate in zip(RATES, _rates(state, section), strict=True):
        setattr(message, name, float(rate))
    return message


def _rates(state: Configuration, section: Section) -> tuple[float, ...]:
    if state.rate is None:
        return (math.nan,) * len(RATES)
    _, theta = jones_from_allen(state.w)
    phi_rate, theta_rate = jones_rates(state.w, state.rate)
    kappa_rate, s_rate = arc_rates(theta, theta_rate, section)
    return (*state.rate, s_rate, phi_rate, kappa_rate, theta_rate)

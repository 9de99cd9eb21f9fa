"""Conversion between a section's configuration and the message ``continuum_msgs/ConfigStates``."""

from __future__ import annotations

import math

import numpy as np

from continuum.arm import Section
from continuum.kinematics.configuration import (
    allen_from_jones,
    allen_rates,
    arc_length,
    arc_rates,
    curvature,
    jones_from_allen,
    jones_rates,
)
from continuum_manipulator.nodekit import messages
from continuum_manipulator.section_joints import Configuration
from continuum_msgs.msg import ConfigStates

RATES = ("u_rate", "v_rate", "s_rate", "phi_rate", "kappa_rate", "theta_rate")


def config_states(state: Configuration, section: Section, number: int) -> ConfigStates:
    """Return the message of section ``number`` with both parametrisations, in its base frame; unknown rates are NaN."""
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


def read_config(message: ConfigStates) -> Configuration:
    """Read a commanded configuration: u and v, or phi and theta if u and v are NaN; with rates if all are numbers.

    Raises:
        MessageFault: neither pair is finite.
    """
    if math.isnan(message.u) and math.isnan(message.v):
        phi, theta = messages.finite("phi and theta", [message.phi, message.theta])
        rates = np.array([message.phi_rate, message.theta_rate])
        known = bool(np.all(np.isfinite(rates)))
        return Configuration(allen_from_jones(phi, theta), allen_rates(phi, theta, *rates) if known else None)
    w, rates = messages.finite("u and v", [message.u, message.v]), np.array([message.u_rate, message.v_rate])
    return Configuration(w, rates if np.all(np.isfinite(rates)) else None)


def _rates(state: Configuration, section: Section) -> tuple[float, ...]:
    if state.rate is None:
        return (math.nan,) * len(RATES)
    _, theta = jones_from_allen(state.w)
    phi_rate, theta_rate = jones_rates(state.w, state.rate)
    kappa_rate, s_rate = arc_rates(theta, theta_rate, section)
    return (*state.rate, s_rate, phi_rate, kappa_rate, theta_rate)

"""Inputs over time that match a model."""

from __future__ import annotations

from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.joint_torques import no_torques
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.tensions import slack
from continuum.errors import InvalidValueError


def suitable_inputs(model: Model, given: InputSignal | None) -> InputSignal:
    """Return the given inputs if they match the model; for None, slack cables or zero torques.

    Raises:
        InvalidValueError: the kind or the number of the inputs does not match the model.
    """
    if given is None:
        return undriven(model)
    if given.kind is not model.inputs:
        raise InvalidValueError("kind of inputs", given.kind.in_words, f"{model.inputs.in_words}, as in the model")
    if given.n_inputs != model.n_inputs:
        raise InvalidValueError(
            f"number of {given.kind.in_words}", given.n_inputs, f"{model.n_inputs}, as in the model"
        )
    return given


def undriven(model: Model) -> InputSignal:
    """Return inputs that do not drive the arm."""
    return slack() if model.inputs is InputKind.CABLES else no_torques(model.n_joints)

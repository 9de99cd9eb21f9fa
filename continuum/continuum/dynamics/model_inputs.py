"""Inputs over time that suit a model."""

from __future__ import annotations

from continuum.dynamics.input_signal import InputSignal
from continuum.dynamics.joint_torques import no_torques
from continuum.dynamics.model import InputKind, Model
from continuum.dynamics.tensions import slack
from continuum.errors import InvalidValueError


def suitable_inputs(model: Model, given: InputSignal | None) -> InputSignal:
    """What was given, where it suits the model; without, cables that are let go, or no torques.

    Raises:
        InvalidValueError: inputs of another kind, or of another number, than the model takes.
    """
    if given is None:
        return undriven(model)
    if given.kind is not model.inputs:
        raise InvalidValueError("kind of inputs", given.kind.in_words, f"{model.inputs.in_words}, as the model")
    if given.n_inputs != model.n_inputs:
        raise InvalidValueError(f"number of {given.kind.in_words}", given.n_inputs, f"{model.n_inputs}, as the model")
    return given


def undriven(model: Model) -> InputSignal:
    """Nothing that drives the arm."""
    return slack() if model.inputs is InputKind.CABLES else no_torques(model.n_joints)

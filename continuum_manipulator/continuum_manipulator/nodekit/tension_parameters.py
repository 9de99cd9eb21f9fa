"""The limits of tension as parameters of a node, and telling of commands beyond them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from continuum.arrays import Array
from continuum.dynamics.live.tension_limit import TensionLimits
from continuum.parameter_spec import ParameterSpec, Value
from continuum_manipulator.nodekit.diagnostics import Diagnostics

PARAMETERS = (
    ParameterSpec("max_tension", float, "largest tension of a cable", "N", 0.0, 1e4, default=30.0),
    ParameterSpec("max_tension_rate", float, "fastest change of tension that commands make", "N/s", 0.0, 1e6,
                  lower_open=True, default=100.0),
    ParameterSpec("command_timeout", float, "age up to which a tension command holds", "s", 0.02, 3600.0,
                  default=0.5),
    ParameterSpec("slack_time", float, "time from there until the cables are slack", "s", 1e-3, 3600.0,
                  default=0.5),
)  # fmt: skip
"""Make the `TensionLimits`, in its order."""


def limits_from(values: Mapping[str, Value]) -> TensionLimits:
    """The limits that a node's parameters say."""
    return TensionLimits(*(float(values[spec.name]) for spec in PARAMETERS))


def report_limited(diagnostics: Diagnostics, cables: Sequence[str], wanted: Array, most: float) -> None:
    """Note on the log and ``/diagnostics`` which of the ``wanted`` tensions (n_cables,) [N] are above ``most`` [N]."""
    for name, tension in zip(cables, wanted, strict=True):
        if tension > most:
            diagnostics.warnings.note("tension limited", f"{name}: {tension:g} N commanded, max_tension is {most:g} N")


def report_abandoned(diagnostics: Diagnostics, limits: TensionLimits) -> None:
    """Note that commands stopped while a cable was tight."""
    patience, slack = limits.patience, limits.slack_time
    diagnostics.warnings.note(
        "tension commands stopped", f"none for {patience:g} s; the cables are slack in {slack:g} s"
    )

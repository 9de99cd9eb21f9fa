"""The limits of tension as parameters of a node, and reports of commands beyond them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from continuum.arrays import Array
from continuum.dynamics.live.tension_limit import TensionLimits
from continuum.parameter_spec import ParameterSpec, Value
from continuum_manipulator.nodekit.diagnostics import Diagnostics

PARAMETERS = (
    ParameterSpec("max_tension", float, "largest tension of a cable", "N", 0.0, 1e4, default=30.0),
    ParameterSpec("max_tension_rate", float, "largest rate of tension changes by commands", "N/s", 0.0, 1e6,
                  lower_open=True, default=100.0),
    ParameterSpec("command_timeout", float, "time for which a tension command holds", "s", 0.02, 3600.0,
                  default=0.5),
    ParameterSpec("slack_time", float, "time after the timeout until the cables are slack", "s", 1e-3, 3600.0,
                  default=0.5),
)  # fmt: skip
"""The parameters of `TensionLimits`, in its order."""


def limits_from(values: Mapping[str, Value]) -> TensionLimits:
    """Return the limits from a node's parameters."""
    return TensionLimits(*(float(values[spec.name]) for spec in PARAMETERS))


def report_limited(diagnostics: Diagnostics, cables: Sequence[str], wanted: Array, most: float) -> None:
    """Report, in the log and on ``/diagnostics``, ``wanted`` tensions (n_cables,) [N] above ``most`` [N]."""
    for name, tension in zip(cables, wanted, strict=True):
        if tension > most:
            diagnostics.warnings.note("tension limited", f"{name}: {tension:g} N commanded, max_tension is {most:g} N")


def report_abandoned(diagnostics: Diagnostics, limits: TensionLimits) -> None:
    """Report that commands stopped while a cable was tight."""
    patience, slack = limits.patience, limits.slack_time
    diagnostics.warnings.note(
        "tension commands stopped", f"none for {patience:g} s; the cables are slack in {slack:g} s"
    )

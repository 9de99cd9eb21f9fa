"""The command that shows a recording with a model before and after a diagnosis."""

from __future__ import annotations

import shlex
from collections.abc import Sequence


def before_after_command(
    recording: str, model: str, section: str | None, extended: str, of_bags: Sequence[str] = ()
) -> str:
    """Return the command line of `continuum view` that draws the simulations by both models over a recording.

    Args:
        recording: path of the recording.
        model: path or name of the model that was diagnosed.
        section: section of an arm file with that model; None if there is only one.
        extended: path of the extended model.
        of_bags: options on the joints of rosbag2 recordings.
    """
    words = ["continuum", "view", recording, "--model", model, "--model", extended, *of_bags]
    return shlex.join(words if section is None else [*words, "--section", section])

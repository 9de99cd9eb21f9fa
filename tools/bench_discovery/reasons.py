"""Why an effect is seldom named, for those of which that was looked into: shown as long as it is seldom named."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

REASONS: Final[Mapping[str, str]] = {
    "backlash": "where joints stick inside the play, a window that begins on its wrong side stays unexplained in the "
    "right model too; it is named only where free runs of whole recordings come to the noise nevertheless.",
    "slack_cable": "it shows only in the moments in which a cable begins to pull. The plant's cable tightens otherwise "
    "than the library's: where such moments are many, the model with the true values leaves as many windows "
    "unexplained as the one that was fitted. Where they are few, in one run of four, no other run tells the threshold.",
    "tip_payload": "a mass at the tip and a heavier last link with another moment of inertia have the same equations "
    "but for the mass that the links before it carry; the two are told as a set, never one for the other.",
    "load_friction": "the joints' dry friction is refitted first and takes up most of what does not change with the "
    "load. Without tension only the weight that a joint carries is left, which hardly changes.",
    "presliding": "the plant's joint creeps by another law than the library's before it breaks away, so that at low "
    "noise some windows stay unexplained in the right model.",
}

"""What every effect of the plant has in common."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from blind.mujoco_plant.chain import Chain
from blind.mujoco_plant.parameters import Parameters

if TYPE_CHECKING:
    from blind.mujoco_plant.machine import Machine
    from blind.mujoco_plant.sensors import Reading

RELEASE, DRIVEN = "release", "driven"
ONLY_DRIVEN = frozenset({DRIVEN})
SIZES = ("small", "medium", "large")


@dataclass(frozen=True)
class Effect:
    """Something that an arm has beyond its parameters; without it, or with the amount zero, nothing differs.

    The class's docstring says what it is physically, with formula and units.

    Attributes:
        amount: how much, in ``unit``; may be negative where ``signed``.
        joint: which joint, sensor or link (from 1); None where the effect belongs to the whole arm.
    """

    amount: float
    joint: int | None = None

    name: ClassVar[str]
    unit: ClassVar[str]
    sizes: ClassVar[tuple[float, float, float]]  # small, medium, large
    signed: ClassVar[bool] = False  # either sign occurs
    at_a_joint: ClassVar[bool] = False
    joints: ClassVar[tuple[int, ...]] = (1, 2, 3, 4, 5)  # among which a joint is drawn
    seen_in: ClassVar[frozenset[str]] = frozenset({RELEASE, DRIVEN})  # kinds of recordings that can show it
    in_a_library: ClassVar[bool] = True

    def change(self, p: Parameters) -> Parameters:
        """Other parameters."""
        return p

    def build(self, chain: Chain) -> None:
        """Add parts to the mechanism."""

    def pull(self, machine: "Machine") -> Callable[[np.ndarray], np.ndarray] | None:
        """For one recording, what each step calls: commanded tensions (2,) to those that pull at the base [N]."""

    def act(self, machine: "Machine") -> Callable[[], None] | None:
        """For one recording, what each step calls to add to ``machine.torque`` or ``machine.coulomb``."""

    def sense(self, reading: "Reading", rng: np.random.Generator) -> None:
        """Spoil the sensors of one recording."""

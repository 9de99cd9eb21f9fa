"""One arm in motion, for one recording."""

from collections.abc import Sequence

import numpy as np

from blind.moreau_plant.chain import assemble
from blind.moreau_plant.effects import realise
from blind.moreau_plant.joints import angles
from blind.moreau_plant.mechanism import without_effects
from blind.moreau_plant.state import at_rest
from blind.moreau_plant.step import compiled_advance
from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.machine import KEPT, MOST_TENSION, PULLING, RATE, SETTLING, Motion
from blind.mujoco_plant.parameters import JOINTS, Parameters

STEPS = 40  # in a sample: 0.2 ms


class Machine:
    """An arm with effects; the same to its users as ``blind.mujoco_plant.machine.Machine``.

    Args:
        p: parameters without effects.
        effects: hidden effects.
        rng: of what effects draw for each recording.
        steps: in a sample, a multiple of 8.
        duration: of the recording [s].

    Attributes:
        mechanism: what the arm is made of.
        chain: its bodies.
        state: what changes as it moves.
        dt: time step [s].

    Raises:
        ValueError: this plant does not know one of the effects.
    """

    def __init__(
        self,
        p: Parameters,
        effects: Sequence[Effect],
        rng: np.random.Generator,
        steps: int = STEPS,
        duration: float = 1.6,
    ) -> None:
        for effect in effects:
            p = effect.change(p)
        mechanism = without_effects(p)
        for effect in effects:
            if effect.amount:
                mechanism = realise(effect, mechanism, rng, duration)
        self.p, self.mechanism, self.chain = p, mechanism, assemble(mechanism)
        self.state = at_rest(mechanism, self.chain)
        self.steps, self.dt = steps, 1 / (RATE * steps)
        self._advance = compiled_advance()

    @property
    def angle(self) -> np.ndarray:
        """Of the joints (5,) [rad]."""
        found: np.ndarray = angles(self.chain, np.cumsum(self.state.q))
        return found

    def step(self, command: np.ndarray) -> None:
        """Advance by one time step under commanded tensions (2,) [N]."""
        self._go(command, command, False, 1, *np.empty((2, 1, JOINTS)))

    def settle(self, command: np.ndarray, duration: float = SETTLING) -> None:
        """Hold the tensions (2,) [N] for some time, and call its end time zero."""
        self._go(command, command, False, round(duration / self.dt), *np.empty((2, 1, JOINTS)))
        self.state.time[0] = 0.0

    def pull_to(self, bend: float) -> np.ndarray:
        """Pull one cable until the joints' angles sum up to ``bend`` [rad] or a little more, and hold it.

        Returns:
            The tensions (2,) [N].
        """
        growth = np.array([bend > 0, bend < 0]) * PULLING / RATE
        rows = 0
        while np.sum(self.angle) * np.sign(bend) < abs(bend) and rows < MOST_TENSION / PULLING * RATE:
            self._go(growth * rows, growth * (rows + 1), False, self.steps, *np.empty((2, 1, JOINTS)))
            rows += 1
        self.settle(growth * rows)
        return growth * rows

    def record(self, command: np.ndarray, let_go_at: int | None = None, hold: bool = True) -> Motion:
        """Move under commanded tensions.

        Args:
            command: at each row (rows, 2) [N].
            let_go_at: row from which both cables are free at the base, whatever is commanded.
            hold: a row's tensions act until the next row; else they change linearly in between.
        """
        rows = len(command)
        angle, rate = np.empty((2, rows * KEPT, JOINTS))
        for row in range(rows):  # one more than is kept, for the last row's first instant
            first, last = command[row], command[row if hold else min(row + 1, rows - 1)]
            let_go = let_go_at is not None and row >= let_go_at
            kept = slice(row * KEPT, (row + 1) * KEPT)
            self._go(first, last, let_go, self.steps, angle[kept], rate[kept])
        count = (rows - 1) * KEPT + 1
        return Motion(np.arange(count) / (RATE * KEPT), angle[:count], rate[:count], rows)

    def _go(
        self, first: np.ndarray, last: np.ndarray, let_go: bool, steps: int, angle: np.ndarray, rate: np.ndarray
    ) -> None:
        """Advance while tensions go from ``first`` to ``last`` (2,) [N]; links' angles and rates are kept (k, 5)."""
        first, last = np.ascontiguousarray(first, dtype=float), np.ascontiguousarray(last, dtype=float)
        self._advance(self.mechanism, self.chain, self.state, first, last, let_go, self.dt, steps, angle, rate)

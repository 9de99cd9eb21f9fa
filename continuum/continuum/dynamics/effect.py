"""What a further physical effect is to the dynamic model: a few hooks, each of which by default changes nothing.

An effect is one small file that defines one class and is found by the entry point group ``continuum.effects``; adding
one touches no other file. Every hook is given the effect's own parameter values, ``params``, arrays by name, and where
it has states of its own, their values; it is traced with symbols like the rest of Eq. 12.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import ClassVar

import numpy as np

from continuum.arrays import Array
from continuum.dynamics.expressions import Numbers
from continuum.dynamics.parameters import Parameter, Parameters
from continuum.dynamics.planar.instant import Instant, Motion
from continuum.dynamics.trajectory import Reading

EffectParams = Mapping[str, Numbers]


class Effect:
    """Base of all effects.

    Class attributes:
        name: as model files and verdicts print it.
        parameters: the effect's own, by name; at their defaults the effect is absent. An effect with states may need a
            parameter above zero for its equations to have a solution: its default is then a value too small to see.
        source: where the equation is from.
        in_words: what is the matter with the arm, one sentence for a mechanic.
        in_words_if_more, in_words_if_less: the same where all its sizes are above or below none; empty where that makes
            no difference.
        in_words_if_lacking: the same where the model has nothing of its kind; empty where that cannot be.
        symptom: what it does to the data, one sentence.
        experiment: what to measure so that it stands out from what resembles it, one sentence.
        removal: how to take it off the arm for further recordings, one sentence; empty where that cannot be done.
        beware: what no effect here is and would look the same, one sentence; empty where nothing is known to.
        alike_in_all_runs: the effect that it is where its values are the same in all recordings; empty where there is
            none. Such values are that one's to explain.
        state_sd: how far each of its states may be from `initial_state` when a recording begins, in the state's
            units; 0 where it is certain.
        uses_cables: whether it acts on cables: none of an arm that joint torques drive.
        uses_drives: whether it acts on joints' drives: none of an arm that cables pull.
        needs_tension: whether only a cable that pulls can show it, or where there are none a torque that drives.
        within_friction: whether it moves joints that dry friction holds. A filter that takes these as resting is blind
            to that: open-loop simulations alone show it.
        shifts_time: whether a little of it looks as if all tensions came later.
        beginnings: values of some of its parameters that belong to the whole arm; a fit begins at those that promise
            most. For effects from whose usual beginning no slope leads to what is right.
        directions: in which combinations of its sizes it occurs, as factors by parameter; every size by itself without.
    """

    name: ClassVar[str]
    parameters: ClassVar[Mapping[str, Parameter]] = {}
    source: ClassVar[str] = ""
    in_words: ClassVar[str] = ""
    in_words_if_more: ClassVar[str] = ""
    in_words_if_less: ClassVar[str] = ""
    in_words_if_lacking: ClassVar[str] = ""
    symptom: ClassVar[str] = ""
    experiment: ClassVar[str] = ""
    removal: ClassVar[str] = ""
    beware: ClassVar[str] = ""
    alike_in_all_runs: ClassVar[str] = ""
    state_sd: ClassVar[float] = 0.0
    uses_cables: ClassVar[bool] = False
    uses_drives: ClassVar[bool] = False
    needs_tension: ClassVar[bool] = False
    within_friction: ClassVar[bool] = False
    shifts_time: ClassVar[bool] = False
    beginnings: ClassVar[Sequence[Mapping[str, float]]] = ()
    directions: ClassVar[Sequence[Mapping[str, float]]] = ()

    def acts_on(self, p: Parameters) -> bool:
        """Whether it can change anything: factors of what an arm has none of do not."""
        if not self.parameters or type(self).change_parameters is Effect.change_parameters:
            return True
        sizes = {name: np.full(p.n_joints if spec.per_joint else 1, spec.another_value)
                 for name, spec in self.parameters.items()}  # fmt: skip
        before, after = p.named(), self.change_parameters(p, sizes).named()
        return any(np.any(after[name] != before[name]) for name in before)

    def n_states(self, n_joints: int) -> int:
        """Number of states that the effect adds."""
        return 0

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        """Parameters of Eq. 12 as the effect makes them."""
        return p

    def move_base(self, motion: Motion, params: EffectParams, state: Numbers, state_rate: Numbers) -> Motion:
        """Motion with the base plate turned."""
        return motion

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        """Tensions of the cables at the base, (n_cables,) [N], of those commanded."""
        return u

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """Added to the left side of Eq. 12, (n,) or (1,) [N m]: a torque that resists."""
        return np.zeros(1)

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        """Zero when the effect's states obey their equations, (n_states,); ``now.u`` is what `pull` was given."""
        return state_rate

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        """The effect's states in an arm that rests, (n_states,).

        Args:
            theta: joint angles, (n,) [rad].
            u: commanded tension of each cable, (n_cables,) [N].
            params: the effect's parameters, numbers.
            p: parameters of Eq. 12 as all effects make them, numbers.
        """
        return np.zeros(self.n_states(theta.size))

    def torque_along(
        self, motion: Array, slip: Array, length: Array, params: EffectParams, p: Parameters
    ) -> Array | None:
        """`torque` along a measured motion, (rows, n) [N m], of an effect whose states are too stiff for that.

        A measured motion errs by more than the width of a stop. Such an effect gives here what its equations tend to
        as its stops harden; others give None, and their states are integrated.

        Args:
            motion: angles, rates and accelerations, (rows, 3, n) [rad, rad/s, rad/s2].
            slip: rates that dry friction sees, (rows, n) [rad/s].
            length: of each row in time, (rows,) [s].
            params: the effect's parameters, numbers.
            p: parameters of Eq. 12 as all effects make them, numbers.
        """
        return None

    def measure(self, seen: Reading, params: EffectParams) -> Reading:
        """What the sensors make of what they see, of every sample by itself; affine in the motion."""
        return seen

    def late(self, params: EffectParams) -> Numbers:
        """By how much all sensors are late [s]: a reading that says t is of t less this."""
        return 0.0

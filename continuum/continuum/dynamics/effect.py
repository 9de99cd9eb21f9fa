"""Interface of additional physical effects to the dynamic model: a few hooks that by default change nothing.

An effect is one small file that defines one class, found through the entry point group ``continuum.effects``; adding
one changes no other file. Every hook receives the effect's parameter values ``params``, arrays by name, and the values
of the effect's states if it has any. Hooks are traced with symbols like the rest of Eq. 12.
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
    """Base class of all effects.

    Class attributes:
        name: name in model files and verdicts.
        parameters: parameters of the effect by name; at their defaults the effect is absent. An effect with states may
            need a positive parameter for its equations to have a solution; its default is then negligibly small.
        source: source of the equation.
        in_words: the fault of the arm, in one sentence for a mechanic.
        in_words_if_more, in_words_if_less: the same sentence if all sizes are positive or negative; empty if the sign
            makes no difference.
        in_words_if_lacking: the same sentence if the model contains no such effect; empty if this cannot occur.
        symptom: how the effect shows in the data, in one sentence.
        experiment: measurement that distinguishes the effect from similar ones, in one sentence.
        removal: how to remove the effect from the arm for further recordings, in one sentence; empty if impossible.
        beware: a cause outside these effects that would show the same symptom, in one sentence; empty if none is known.
        alike_in_all_runs: name of the effect that this one is equivalent to if its values are equal in all recordings;
            that effect then explains the values. Empty if there is none.
        state_sd: standard deviation of each state from `initial_state` at the start of a recording, in the units of
            the state; 0 if the state is certain.
        uses_cables: whether it acts on cables; such an effect is absent from an arm driven by joint torques.
        uses_drives: whether it acts on the joints' drives; such an effect is absent from an arm driven by cables.
        needs_tension: whether only a pulling cable can show it, or a driving torque in an arm without cables.
        within_friction: whether it moves joints that dry friction holds. A filter that treats these joints as resting
            cannot detect such motion; only open-loop simulations show it.
        shifts_time: whether a small amount of it resembles a delay of all tensions.
        beginnings: start values of some parameters that belong to the whole arm; a fit starts from the most promising
            ones. For effects whose usual start has no slope towards the solution.
        directions: combinations of its sizes in which it occurs, as factors by parameter; by default every size varies
            independently.
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
        """Return whether the effect can change the model; a factor on a parameter that is zero cannot."""
        if not self.parameters or type(self).change_parameters is Effect.change_parameters:
            return True
        sizes = {name: np.full(p.n_joints if spec.per_joint else 1, spec.another_value)
                 for name, spec in self.parameters.items()}  # fmt: skip
        before, after = p.named(), self.change_parameters(p, sizes).named()
        return any(np.any(after[name] != before[name]) for name in before)

    def n_states(self, n_joints: int) -> int:
        """Return the number of states that the effect adds."""
        return 0

    def change_parameters(self, p: Parameters, params: EffectParams) -> Parameters:
        """Return the parameters of Eq. 12 as modified by the effect."""
        return p

    def move_base(self, motion: Motion, params: EffectParams, state: Numbers, state_rate: Numbers) -> Motion:
        """Return the motion with the base plate rotated."""
        return motion

    def pull(self, u: Numbers, params: EffectParams, state: Numbers) -> Numbers:
        """Return the tensions of the cables at the base, (n_cables,) [N], for the commanded tensions ``u``."""
        return u

    def torque(self, now: Instant, params: EffectParams, state: Numbers) -> Numbers:
        """Return the torque added to the left side of Eq. 12, (n,) or (1,) [N m]; positive torques resist."""
        return np.zeros(1)

    def state_balance(self, now: Instant, params: EffectParams, state: Numbers, state_rate: Numbers) -> Numbers:
        """Return the residual of the state equations, (n_states,); ``now.u`` holds the tensions passed to `pull`."""
        return state_rate

    def initial_state(self, theta: Array, u: Array, params: EffectParams, p: Parameters) -> Array:
        """Return the effect's states in a resting arm, (n_states,).

        Args:
            theta: joint angles, (n,) [rad].
            u: commanded tension of each cable, (n_cables,) [N].
            params: parameters of the effect, as numbers.
            p: parameters of Eq. 12 as modified by all effects, as numbers.
        """
        return np.zeros(self.n_states(theta.size))

    def torque_along(
        self, motion: Array, slip: Array, length: Array, params: EffectParams, p: Parameters
    ) -> Array | None:
        """Return `torque` along a measured motion, (rows, n) [N m], for an effect with very stiff states.

        The error of a measured motion exceeds the width of a stop. An effect with stops therefore returns the limit of
        its equations for rigid stops; other effects return None, and their states are integrated.

        Args:
            motion: angles, rates and accelerations, (rows, 3, n) [rad, rad/s, rad/s2].
            slip: joint rates in the dry friction terms, (rows, n) [rad/s].
            length: duration of each row, (rows,) [s].
            params: parameters of the effect, as numbers.
            p: parameters of Eq. 12 as modified by all effects, as numbers.
        """
        return None

    def measure(self, seen: Reading, params: EffectParams) -> Reading:
        """Return the sensors' readings of the motion ``seen``, sample by sample; affine in the motion."""
        return seen

    def late(self, params: EffectParams) -> Numbers:
        """Return the delay of all sensors [s]: a reading stamped t belongs to t minus this delay."""
        return 0.0

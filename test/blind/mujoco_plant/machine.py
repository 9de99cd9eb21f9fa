"""One arm in motion: MuJoCo's mechanics with true stiction, integrated as leapfrog at a small step."""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numba
import numpy as np

from blind.mujoco_plant.cable_friction import LEAST, friction_limits
from blind.mujoco_plant.chain import CABLES, Chain
from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.parameters import GRAVITY, JOINTS, Parameters

RATE = 120  # samples a second
STEPS = 64  # of the integrator in a sample: the error is some hundredths of a degree at worst
KEPT = 8  # instants kept in a sample

PULLING = 40.0  # how fast a cable is pulled before a release [N/s]
MOST_TENSION = 150.0  # [N]
SETTLING = 0.5  # time that the arm is held before a recording begins [s]


@dataclass(frozen=True)
class Motion:
    """What happened in a recording, without sensors.

    Attributes:
        time: of each instant from the first row on [s] (n,).
        angle: of the links from the base plate's plumb position [rad] (n, 5).
        rate: of the links [rad/s] (n, 5).
        rows: samples at RATE.
    """

    time: np.ndarray
    angle: np.ndarray
    rate: np.ndarray
    rows: int


class Machine:
    """An arm with effects, for one recording.

    Velocities are kept half a step before positions (leapfrog), and half of the viscous damping is taken from the old
    velocity, half from the new one, so that the step's error is of second order wherever motion is smooth.

    Args:
        p: parameters without effects.
        effects: hidden effects.
        rng: of what effects draw for each recording.
        steps: of the integrator in a sample.

    Attributes:
        angle: of the joints (5,) [rad].
        rate: of the joints (5,) [rad/s].
        time: since the first row of the recording [s].
        pulling: tensions at the base (2,) [N].
        torque: applied from outside on every degree of freedom [N m]; effects add to it at each step.
        coulomb: dry friction of the joints' hinges (5,) [N m]; effects change it at each step.
        duration: of the recording [s].
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
        chain = Chain(p)
        for effect in effects:
            effect.build(chain)
        self.p, self.rng, self.steps, self.duration = p, rng, steps * chain.finer, duration
        self.dt = 1 / (RATE * self.steps)
        self.model = mujoco.MjModel.from_xml_string(chain.mjcf(self.dt))
        self.data = mujoco.MjData(self.model)
        self.plumb = GRAVITY * np.array([-np.sin(p.base_tilt), 0.0, -np.cos(p.base_tilt)])
        self.model.opt.gravity[:] = self.plumb
        self._half_damping = 0.5 * self.model.dof_damping
        self.model.dof_damping[:] = self._half_damping

        self.hinge = np.array([self.dof(f"joint_{i}") for i in range(1, JOINTS + 1)])
        self.joints = np.zeros((JOINTS, self.model.nv))
        self.joints[np.arange(JOINTS), self.hinge] = 1.0
        for i in chain.play:
            self.joints[i - 1, self.dof(f"play_{i}")] = 1.0
        self._links = np.cumsum(self.joints, axis=0)
        if chain.base_hinge is not None:
            self._links[:, self.dof("base")] = 1.0

        self.time = -1e3  # until the recording begins
        self.let_go = False
        self.angle, self.rate, self.pulling = np.zeros(JOINTS), np.zeros(JOINTS), np.zeros(len(CABLES))
        self.torque, self.coulomb = np.zeros(self.model.nv), p.coulomb.copy()
        self.cable_force = np.zeros((len(CABLES), JOINTS))  # friction at the discs [N], as in cable_friction
        self._rubbed = False  # in the step before
        self._velocity = np.zeros(self.model.nv)  # at the instant of the positions
        self._earlier = np.zeros(self.model.nv)  # half a step before ``data.qvel``'s
        mujoco.mj_forward(self.model, self.data)
        # what is looked at in each step: views of the engine's own arrays
        self._q, self._v, self._control = self.data.qpos, self.data.qvel, self.data.ctrl
        self._applied, self._dry = self.data.qfrc_applied, self.model.dof_frictionloss
        self._cables_dry = self.model.tendon_frictionloss[: len(CABLES) * JOINTS]
        self._pulls = [hook for effect in effects if effect.amount and (hook := effect.pull(self))]
        self._acts = [hook for effect in effects if effect.amount and (hook := effect.act(self))]

    def dof(self, name: str) -> int:
        """Number of a hinge's degree of freedom."""
        return int(self.model.jnt_dofadr[mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT, name)])

    def push(self, joint: int, torque: float) -> None:
        """Add a torque [N m] between the links of a joint (from 1), beyond its play."""
        self.torque += torque * self.joints[joint - 1]

    def cable_length(self) -> np.ndarray:
        """From the base plate to the tip (2,) [m]; the engine's own lengths are those of one step ago."""
        up, out = self.p.half_spacing * np.cos(self.angle / 2).sum(), self.p.hole_radius * np.sin(self.angle / 2).sum()
        return 2 * np.array([up - out, up + out])

    def cable_tension(self) -> np.ndarray:
        """Between discs, beyond each disc's friction (2, 5) [N]."""
        tension: np.ndarray = self.pulling[:, None] - np.cumsum(self.cable_force, axis=1)
        return tension

    def step(self, command: np.ndarray, *, jump: bool = False) -> None:
        """Advance by ``dt`` under commanded tensions (2,) [N].

        With ``jump`` they may differ from those until now: a jump lies in the middle of the leapfrog's step of
        velocity, half of which is then the step before once more.
        """
        p, velocity = self.p, self._v
        self._observe()
        pulling = command
        if self.let_go:
            pulling = np.zeros(len(CABLES))
        else:
            for pull in self._pulls:
                pulling = pull(pulling)
        self.pulling = pulling
        self.torque = -self._half_damping * velocity
        self.coulomb = _dry(self._velocity, self.hinge, p.coulomb, p.stribeck, p.stribeck_rate, p.stribeck_exponent)
        for act in self._acts:
            act()
        self._applied[:] = self.torque
        self._dry[self.hinge] = np.maximum(self.coulomb, LEAST)
        self._control[:] = pulling
        rubbing = pulling[0] != 0.0 or pulling[1] != 0.0
        if rubbing:
            self._cables_dry[:] = friction_limits(self.angle, pulling, self.cable_force, p.cable_friction).ravel()
        else:
            self._cables_dry[:] = 0.0
        earlier = velocity.copy()
        change = earlier - self._earlier
        self._earlier = earlier
        mujoco.mj_step1(self.model, self.data)
        velocity[:] = self._velocity  # centrifugal torques are those of the velocity at the positions' instant
        mujoco.mj_comVel(self.model, self.data)
        mujoco.mj_rne(self.model, self.data, 0, self.data.qfrc_bias)
        velocity[:] = earlier
        mujoco.mj_step2(self.model, self.data)
        if jump:
            correction = 0.5 * (change - (velocity - earlier))
            velocity += correction
            self._q += self.dt * correction
        if rubbing:  # the first rows of the constraints are the hinges' friction, the next ones the cables'
            rows = self.data.efc_force[JOINTS : (len(CABLES) + 1) * JOINTS]
            self.cable_force = rows.reshape(len(CABLES), JOINTS).copy()
        elif self._rubbed:
            self.cable_force = np.zeros((len(CABLES), JOINTS))
        self._rubbed = rubbing
        self.time += self.dt

    def _observe(self) -> None:
        self._velocity, self.angle, self.rate = _now(self._q, self._v, self._earlier, self.joints)

    def settle(self, command: np.ndarray, duration: float = SETTLING) -> None:
        """Hold the tensions (2,) [N] for some time, and call its end time zero."""
        for _ in range(round(duration / self.dt)):
            self.step(command)
        self.time = 0.0

    def pull_to(self, bend: float) -> np.ndarray:
        """Pull one cable until the joints' angles sum up to ``bend`` [rad] or a little more, and hold it.

        Returns:
            The tensions (2,) [N].
        """
        pulled = np.array([bend > 0, bend < 0], dtype=float)
        rows = 0
        while np.sum(self.angle) * np.sign(bend) < abs(bend) and rows < MOST_TENSION / PULLING * RATE:
            for part in range(self.steps):
                self.step(pulled * PULLING * (rows + part / self.steps) / RATE)
            rows += 1
        command = pulled * PULLING * rows / RATE
        self.settle(command)
        return command

    def record(self, command: np.ndarray, let_go_at: int | None = None, hold: bool = True) -> Motion:
        """Move under commanded tensions.

        Args:
            command: at each row (rows, 2) [N].
            let_go_at: row from which both cables are free at the base, whatever is commanded.
            hold: a row's tensions act until the next row; else they change linearly in between.
        """
        rows = len(command)
        every = self.steps // KEPT
        count = (rows - 1) * KEPT + 1
        angle, rate = np.empty((count, JOINTS)), np.empty((count, JOINTS))
        for k in range((rows - 1) * self.steps + 1):
            row, part = divmod(k, self.steps)
            self.let_go = let_go_at is not None and row >= let_go_at
            if k % every == 0:
                self._observe()
                angle[k // every], rate[k // every] = self._links @ self._q, self._links @ self._velocity
            if k < (rows - 1) * self.steps:
                now = command[row]
                if not hold:
                    now = now + (command[row + 1] - now) * (part / self.steps)
                self.step(now, jump=part == 0)
        return Motion(np.arange(count) / (RATE * KEPT), angle, rate, rows)


@numba.njit(cache=True)
def _now(q, v, earlier, joints):  # type: ignore[no-untyped-def]
    """Velocities at the instant of the positions (nv,), and angles and rates of the joints (5,)."""
    velocity = 1.5 * v - 0.5 * earlier
    angle, rate = np.zeros(len(joints)), np.zeros(len(joints))
    for joint in range(len(joints)):
        for dof in range(q.size):
            angle[joint] += joints[joint, dof] * q[dof]
            rate[joint] += joints[joint, dof] * velocity[dof]
    return velocity, angle, rate


@numba.njit(cache=True)
def _dry(velocity, hinge, coulomb, stribeck, stribeck_rate, exponent):  # type: ignore[no-untyped-def]
    """Dry friction of the hinges (5,) [N m]: Coulomb's, and Stribeck's where they turn slowly."""
    limit = np.empty(hinge.size)
    for k in range(hinge.size):
        slow = np.exp(-(abs(velocity[hinge[k]] / stribeck_rate[k]) ** exponent))
        limit[k] = coulomb[k] * (1 + stribeck[k] * slow)
    return limit

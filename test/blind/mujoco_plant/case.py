"""Cases: files as an analysis gets them, and the truth, which it does not."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from blind.mujoco_plant.effect import RELEASE, SIZES, Effect
from blind.mujoco_plant.effects import EFFECTS, LIBRARY, OUTSIDE
from blind.mujoco_plant.machine import RATE, STEPS, Machine, Motion
from blind.mujoco_plant.parameters import JOINTS, Parameters, varied
from blind.mujoco_plant.regimes import DATASETS, Run, driven, duration, kinds, release
from blind.mujoco_plant.sensors import NOISES, Noise, Reading
from blind.mujoco_plant.table import table

KINDS = ("clean", "one", "pair", "outside")


@dataclass(frozen=True)
class Truth:
    """What is hidden.

    Attributes:
        effects: hidden ones; empty in a clean case.
        size: their size by name.
        dataset: by its name in DATASETS, or "given".
        noise: by its name in NOISES, or "given".
        seed: of the case.
        parameters: of the arm without effects, as drawn.
        regimes: of each file.
    """

    effects: tuple[Effect, ...]
    size: str
    dataset: str
    noise: str
    seed: int
    parameters: Parameters
    regimes: dict[str, str]

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(effect.name for effect in self.effects)

    @property
    def in_a_library(self) -> bool:
        """Whether a library of effects may know all of them."""
        return all(effect.in_a_library for effect in self.effects)

    def plain(self) -> dict[str, object]:
        """As numbers, strings and lists."""
        return {
            "effects": [
                {"name": e.name, "joint": e.joint, "amount": e.amount, "unit": e.unit, "in_a_library": e.in_a_library}
                for e in self.effects
            ],
            "size": self.size,
            "dataset": self.dataset,
            "noise": self.noise,
            "seed": self.seed,
            "parameters": self.parameters.named(),
            "regimes": self.regimes,
        }


@dataclass(frozen=True)
class Case:
    """One hidden draw.

    Attributes:
        files: contents by neutral name, as an analysis gets them.
        truth: what is hidden.
        without_noise: by file, joint angles [rad] (rows, 5) that the same sensors read without noise.
    """

    files: dict[str, bytes]
    truth: Truth
    without_noise: dict[str, np.ndarray]


class Arm(Protocol):
    """What moves in a recording, whatever computes it: see ``Machine``."""

    def pull_to(self, bend: float) -> np.ndarray: ...

    def settle(self, command: np.ndarray) -> None: ...

    def record(self, command: np.ndarray, let_go_at: int | None = None, hold: bool = True) -> Motion: ...


class Builder(Protocol):
    """What makes an arm for one recording: see ``Machine``."""

    def __call__(
        self, p: Parameters, effects: Sequence[Effect], rng: np.random.Generator, steps: int, duration: float
    ) -> Arm: ...


def make_case(
    effects: Sequence[str | Effect] = (),
    size: str | float = "medium",
    dataset: str | Sequence[str] = "mixed",
    seed: int = 0,
    noise: str | Noise = "ordinary",
    *,
    joint: int | None = None,
    seconds: float = 3.0,
    variation: float = 1.0,
    rates: bool = True,
    tensions: bool = True,
    hold: bool = True,
    steps: int = STEPS,
    machine: Builder = Machine,
    noises: Mapping[str, Noise] = NOISES,
) -> Case:
    """Measure an arm with given effects.

    Arm, motions, order of files and noise depend on the seed alone, never on the effects: cases of one seed differ by
    what their effects do, no more.

    Args:
        effects: names, whose sign, joint and amount about their size the seed draws; or effects as they are.
        size: of SIZES (amounts within a tenth of it), or an exact multiple of medium.
        dataset: of DATASETS, or the regimes of its recordings ("release" and names of COMMANDS).
        seed: of everything that is drawn.
        noise: of ``noises``, or one's own.
        joint: of the named effects that belong to a joint, instead of a drawn one.
        seconds: length of driven recordings.
        variation: of the arm's parameters, as a multiple of the ordinary one.
        rates: whether files hold joint rates.
        tensions: whether files hold cable tensions.
        hold: tensions of a row act until the next; else they change linearly from row to row.
        steps: of the integrator in a sample, a multiple of 8.
        machine: what moves.
        noises: levels by name.
    """
    wanted = DATASETS[dataset] if isinstance(dataset, str) else dataset
    arm, hidden, order, *recordings = streams(seed, 3 + len(wanted))
    p = varied(arm, variation)
    chosen = tuple(e if isinstance(e, Effect) else _sized(e, size, joint, hidden) for e in effects)
    level = noises[noise] if isinstance(noise, str) else noise
    regimes = [wanted[i] for i in order.permutation(len(wanted))]
    sides = _sides(regimes, order)
    files, clean, of_file = {}, {}, {}
    for number, (regime, side, rng) in enumerate(zip(regimes, sides, recordings, strict=True), start=1):
        moving, drawn, sensing, noisy = rng.spawn(4)
        built = machine(p, chosen, drawn, steps, duration(regime, seconds))
        run = release(built, moving, side, hold) if regime == RELEASE else driven(built, moving, regime, seconds, hold)
        reading = Reading(JOINTS, chosen, sensing)
        name = f"run_{number}.csv"
        clean[name] = reading.take(run.motion, Noise(), np.random.default_rng(0))[0]
        files[name] = file_of(run, *reading.take(run.motion, level, noisy), rates, tensions)
        of_file[name] = regime
    named = size if isinstance(size, str) else f"{size:g} x medium"
    truth = Truth(
        chosen,
        named,
        dataset if isinstance(dataset, str) else "given",
        noise if isinstance(noise, str) else "given",
        seed,
        p,
        of_file,
    )
    return Case(files, truth, clean)


@dataclass(frozen=True)
class Plan:
    """What a seed hides: arguments of ``make_case``."""

    effects: tuple[str, ...]
    size: str
    dataset: str
    seed: int
    noise: str


def draw_plan(
    seed: int,
    kind: str | None = None,
    *,
    size: str | None = None,
    dataset: str | None = None,
    noise: str | None = None,
    datasets: Sequence[str] = ("releases", "mixed", "driven", "slow", "fast"),
) -> Plan:
    """What the seed hides; anything given is not drawn.

    Args:
        seed: of the case.
        kind: of KINDS: no effect, one or two that a library may know, or one outside of it.
        size: of SIZES.
        dataset: of DATASETS; effects that it cannot show are not hidden in it.
        noise: of NOISES.
        datasets: those among which one is drawn.
    """
    rng = np.random.default_rng([seed, 1])
    drawn_kind = str(rng.choice(KINDS, p=[0.2, 0.5, 0.15, 0.15]))
    drawn_size, drawn_dataset = str(rng.choice(SIZES)), str(rng.choice(list(datasets)))
    drawn_noise = str(rng.choice(["low", "ordinary", "high"], p=[0.25, 0.5, 0.25]))
    kind, dataset = kind or drawn_kind, dataset or drawn_dataset
    shown = [name for name in (OUTSIDE if kind == "outside" else LIBRARY) if EFFECTS[name].seen_in & kinds(dataset)]
    count = {"clean": 0, "one": 1, "pair": 2, "outside": 1}[kind]
    effects = tuple(str(name) for name in rng.choice(shown, count, replace=False))
    return Plan(effects, size or drawn_size, dataset, seed, noise or drawn_noise)


def draw_case(seed: int, kind: str | None = None, **given: Any) -> Case:
    """Measure what ``draw_plan`` hides, with the same arguments."""
    plan = draw_plan(seed, kind, **given)
    return make_case(plan.effects, plan.size, plan.dataset, plan.seed, plan.noise)


def streams(seed: int, count: int) -> list[np.random.Generator]:
    """Independent generators of one seed."""
    return [np.random.default_rng(child) for child in np.random.SeedSequence(seed).spawn(count)]


def _sized(name: str, size: str | float, joint: int | None, rng: np.random.Generator) -> Effect:
    """An effect whose sign, joint and exact amount are drawn."""
    kind = EFFECTS[name]
    drawn = int(rng.choice(kind.joints)), float(rng.choice([-1, 1])), float(rng.uniform(0.9, 1.1))
    amount = kind.sizes[SIZES.index(size)] * drawn[2] if isinstance(size, str) else kind.sizes[1] * size
    where = (joint or drawn[0]) if kind.at_a_joint else None
    return kind(amount * (drawn[1] if kind.signed else 1.0), where)


def _sides(regimes: Sequence[str], rng: np.random.Generator) -> list[int]:
    """Releases from both sides in equal number, as far as that goes."""
    number = sum(regime == RELEASE for regime in regimes)
    sides = iter(rng.permutation(([1, -1] * number)[:number]))
    return [int(next(sides)) if regime == RELEASE else 1 for regime in regimes]


def file_of(run: Run, angle: np.ndarray, rate: np.ndarray, rates: bool, tensions: bool) -> bytes:
    columns = {"t_s": np.arange(run.motion.rows) / RATE}
    columns |= {f"q{i + 1}_deg": np.degrees(angle[:, i]) for i in range(JOINTS)}
    if rates:
        columns |= {f"dq{i + 1}_deg_s": np.degrees(rate[:, i]) for i in range(JOINTS)}
    if tensions:
        columns |= {f"u{j + 1}_N": run.command[:, j] for j in range(2)}
    return table(columns)

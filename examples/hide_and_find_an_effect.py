"""Hide an effect in a simulated arm, and let the diagnosis find it from the recordings and the nominal model alone.

    python3 examples/hide_and_find_an_effect.py [FOLDER]

The seed draws the effect, its place, its size, and the sensors' noise. Prints verdict, truth, and the gain; writes a
picture and the extended model to FOLDER (default out/examples/hide_and_find_an_effect).
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from continuum.discovery import diagnose
from continuum.discovery.words import verdict_in_words
from continuum.dynamics.effect_lookup import effect_named
from continuum.dynamics.measuring import as_read
from continuum.dynamics.model import ActiveEffect
from continuum.dynamics.model_file import load_model, save_model
from continuum.dynamics.simulator import Simulator
from continuum.recordings.recording import Recording

SEED = 2
EFFECTS = ("rest_angle", "joint_stiffness", "hardening_spring", "quadratic_drag", "presliding", "sensor_scale")
NOISE = np.radians(0.05)  # standard deviation of an angle's reading [rad]
TIMES = np.arange(0.0, 1.6, 1 / 120)  # [s]


def main(out: Path) -> None:
    """Draw, simulate, diagnose, compare."""
    out.mkdir(parents=True, exist_ok=True)
    rng, nominal = np.random.default_rng(SEED), load_model("lamecc_prototype.yaml")
    n = nominal.n_joints
    effect = effect_named(str(rng.choice(EFFECTS)))
    values = {name: spec.array(spec.default, n, name) for name, spec in effect.parameters.items()}  # absent
    size, spec = next(iter(effect.parameters.items()))
    joint = int(rng.integers(values[size].size))
    values[size][joint] = rng.uniform(3.0, 5.0) * spec.typical  # at one joint, if it has any
    true = replace(nominal, effects=(ActiveEffect(effect, values),))
    recordings = []
    for name, bend in {"left": np.radians(90.0), "right": np.radians(-60.0)}.items():  # sum of the joint angles [rad]
        motion = as_read(true, Simulator(true).run(np.full(n, bend / n), TIMES))  # released from rest
        theta = motion.theta + NOISE * rng.standard_normal(motion.theta.shape)  # (n_times, n_joints) [rad]
        recordings.append(Recording(name, TIMES, theta))
    result = diagnose(recordings, nominal, with_power=False)
    before, after = (np.degrees(one.error(0, recordings[0].theta)) for one in (result.before, result.after))
    print(f"verdict: {result.verdict.kind.value} {', '.join(cause.label for cause in result.causes)}")
    print(verdict_in_words(result))
    where = f"[{joint + 1}]" if spec.per_joint else ""
    print(f"hidden: {effect.name}.{size}{where} {values[size][joint]:.4g} {spec.unit}")
    for one in (one for cause in result.causes for one in cause.estimates):
        print(f"found:  {one} {one.value:.4g} {one.unit} ({one.low:.4g} to {one.high:.4g})")
    print(f"gain: open-loop error of {recordings[0].name} {before:.2f} -> {after:.2f} degrees")
    result.plot().savefig(out / "diagnosis.png")
    save_model(result.extended_model, out / "extended.yaml")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "out/examples/hide_and_find_an_effect"))

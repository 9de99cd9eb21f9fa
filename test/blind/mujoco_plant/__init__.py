"""A plant to test diagnoses on: MuJoCo's mechanics, true stiction, hidden effects; no code of the library.

What an analysis may know of the files, whatever is hidden in them:

- Rows come at 120 Hz. Joint 1 is nearest the base; positive angles bend the arm towards cable 1.
- ``u1_N, u2_N`` are commanded tensions. Those of a row act until the next row (``hold=False``: they change linearly).
- A recording begins at rest, its first rows' tensions having been held for half a second. Where both tensions fall to
  zero for good within the first rows, the arm was bent by that tension and both cables' base ends were let go then.
- Angles are integrals of gyros' rates, one gyro on each link, from a posture known to a tenth of a degree; neighbours
  are subtracted. Sensors see what links do in the room, so a base that turns is within joint 1.
- Dry friction is exact (no smoothing), with the thesis's Stribeck term; a cable turns at each disc by half the sum of
  the angles of the joints before and behind it.
"""

from blind.mujoco_plant.case import KINDS, Case, Plan, Truth, draw_case, draw_plan, make_case
from blind.mujoco_plant.effect import SIZES, Effect
from blind.mujoco_plant.effects import EFFECTS, LIBRARY, OUTSIDE
from blind.mujoco_plant.folder import write_case
from blind.mujoco_plant.machine import Machine, Motion
from blind.mujoco_plant.parameters import Parameters, prototype, varied
from blind.mujoco_plant.regimes import COMMANDS, DATASETS
from blind.mujoco_plant.sensors import NOISES, Noise

__all__ = [
    "COMMANDS",
    "DATASETS",
    "EFFECTS",
    "KINDS",
    "LIBRARY",
    "NOISES",
    "OUTSIDE",
    "SIZES",
    "Case",
    "Effect",
    "Machine",
    "Motion",
    "Noise",
    "Parameters",
    "Plan",
    "Truth",
    "draw_case",
    "draw_plan",
    "make_case",
    "prototype",
    "varied",
    "write_case",
]

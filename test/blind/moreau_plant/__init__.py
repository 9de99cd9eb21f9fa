"""A second plant to test diagnoses on: Moreau's time stepping, hidden effects; no code of the library, nor of MuJoCo.

It hides every effect of ``blind.mujoco_plant``, by the same names, amounts and units, and its files are written in the
same way. What an analysis may know of them is what ``blind.mujoco_plant`` says, but for this:

- There are angles and no rates, and each joint's zero is wrong by tenths of a degree in every recording.
- Dry friction falls with speed as S / (1 + (w / v_d)^2), not as S exp(-(w / v_d)^2).
- The cables' friction at the discs is that of the belt formula, exact and with stiction as well.
- Springs that harden do so by their cubic term alone, and the ball of a joint with play has next to no inertia.
- Where a joint's neighbouring holes meet, at 62 degrees, its discs stop it.

Positions and rates are first order in the step where joints rub, second where they do not. The first call after a
change of these sources compiles them, for some twenty seconds; a case then takes a third of a second.
"""

from blind.moreau_plant.case import NOISES, draw_case, make_case
from blind.moreau_plant.machine import Machine
from blind.mujoco_plant import EFFECTS, LIBRARY, OUTSIDE, write_case

__all__ = [
    "EFFECTS",
    "LIBRARY",
    "NOISES",
    "OUTSIDE",
    "Machine",
    "draw_case",
    "make_case",
    "write_case",
]

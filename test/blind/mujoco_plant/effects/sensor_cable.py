"""The charging cable at the first sensor."""

from blind.mujoco_plant.chain import Chain
from blind.mujoco_plant.effect import Effect


class SensorCable(Effect):
    """A cable from the first sensor to a clamp at the side drags on link 1: an elastic strap with air and dry drag.

    From the clamp 150 mm to cable 2's side of the sensor to the sensor, 45 mm off the arm's axis and b below joint 1,
    it pulls or pushes with k (l - 0.95 l_0) + c l' + F_d sign(l') along its line. The amount is k [N/m]; c is 10 ms
    k, F_d 15 mm k.
    """

    name, unit, sizes = "sensor_cable", "N/m", (20.0, 60.0, 160.0)

    def build(self, chain: Chain) -> None:
        if self.amount:
            b, k, length = chain.p.half_spacing, self.amount, 0.15
            sensor = (-0.045, -b)
            attributes = {
                "springlength": 0.95 * length,
                "stiffness": k,
                "damping": 0.01 * k,
                "frictionloss": 0.015 * k,
            }
            chain.straps["lead"] = (1, (sensor[0] - length, -2 * b), sensor, attributes)

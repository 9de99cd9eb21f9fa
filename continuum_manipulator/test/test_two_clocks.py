"""Two clocks are read as of one instant, whatever comes between."""

import pytest

from continuum_manipulator.nodekit.two_clocks import CLOSE, TRIES, read_together


class Machine:
    """Time passes by ``pauses`` [s] between the readings of its two clocks, which differ by 1000 s."""

    def __init__(self, pauses):
        self.now, self._pauses = 5.0, iter(pauses)

    def steady(self):
        self.now += next(self._pauses)
        return self.now

    def other(self):
        self.now += next(self._pauses)
        return round((self.now + 1000.0) * 1e9)


def off(pauses) -> float:
    machine = Machine(pauses)
    instant, shown = read_together(machine.steady, machine.other)
    return abs(shown * 1e-9 - 1000.0 - instant)


@pytest.mark.parametrize("where", [0, 1, 2])
def test_a_pause_at_any_place_moves_nothing(where):
    pauses = [1e-6] * 6
    pauses[where] = 0.03
    assert off(pauses) <= CLOSE


def test_where_all_are_slow_the_closest_counts():
    slow = [0.0, 0.01, 0.01]
    assert off([*slow, 0.0, 0.0, 0.002, *slow * (TRIES - 2)]) == pytest.approx(0.001)

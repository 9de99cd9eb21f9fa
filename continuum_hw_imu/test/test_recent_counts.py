"""Counts that grew lately, rates of counts, latencies."""

from hypothesis import given
from hypothesis import strategies as st

from continuum_hw_imu.latency_meter import LatencyMeter
from continuum_hw_imu.recent import RECENT, RateMeter, Recent


def test_growth_is_recent_for_some_seconds():
    recent = Recent()
    assert not recent.grew("lost", 0, 0.0)
    assert recent.grew("lost", 2, 1.0)
    assert recent.grew("lost", 2, 1.0 + RECENT / 2)
    assert not recent.grew("lost", 2, 1.0 + RECENT)
    assert not recent.grew("lost", 0, 10.0)  # begun anew
    assert recent.grew("lost", 1, 10.5)
    assert not recent.grew("late", 0, 10.5)


@given(st.integers(1, 200), st.floats(0.2, 2.0))
def test_rate_of_a_steady_count(hertz, period):
    meter = RateMeter()
    assert meter.rate(0, 0.0) == 0.0
    for k in range(1, 20):
        rate = meter.rate(round(1000 * hertz * k * period), k * period)
    assert abs(rate - 1000 * hertz) < 10.0
    assert meter.rate(0, 21 * period) == 0.0  # begun anew


def test_latencies():
    meter = LatencyMeter()
    assert meter.quantile(0.99) == 0.0
    for k in range(1, 101):
        meter.note(k * 1e-3)
    assert 0.098 < meter.quantile(0.99) <= 0.1
    assert meter.largest == 0.1

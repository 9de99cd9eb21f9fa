"""The receiver's limits hold whatever comes, in whatever order."""

from itertools import pairwise

import numpy as np
from guarded_bench import LIMITS, TICK, A, B, Bench
from hypothesis import given, settings
from hypothesis import strategies as st

from continuum_hw_imu.protocol.messages import GuardState

STEPS = st.lists(
    st.one_of(
        st.tuples(st.sampled_from(["claim", "release", "beat", "let_go", "reset_stop"]), st.sampled_from([A, B])),
        st.tuples(st.sampled_from(["stop", "lose_link"]), st.just(0)),
        st.tuples(
            st.just("pull"),
            st.tuples(
                st.sampled_from([A, B]),
                st.lists(st.floats(allow_nan=True), min_size=1, max_size=3),
                st.integers(-1_000_000, 2_000_000),
                st.integers(0, 5),
            ),
        ),
        st.tuples(st.just("pass"), st.integers(1, 60)),
    ),
    max_size=60,
)


@settings(max_examples=200)
@given(STEPS, st.sampled_from([100_000_000, (1 << 32) - 300_000]))
def test_limits_hold_whatever_comes(steps, start):
    bench = Bench(start)
    guard, sequence, dropped = bench.guard, 0, set()
    for kind, what in steps:
        before = guard.set_points
        match kind:
            case "pull":
                token, tensions, age, step = what
                sequence += step
                bench.pull(tuple(tensions), token, age, sequence)
            case "pass":
                for _ in range(what):
                    bench.tick()
            case "stop":
                guard.stop(bench.now)
            case "lose_link":
                guard.lose_link()
            case "beat":
                guard.heartbeat(what, bench.now)
            case "reset_stop":
                bench.reset_stop(what)
            case _:
                getattr(guard, kind)(what, bench.now)
        if kind != "pass" and not np.array_equal(before, guard.set_points):
            assert kind in ("stop", "let_go")  # the only ones that change tension at once, and only to zero
            assert not guard.set_points.any()
            dropped.add(len(bench.record))
            bench.record.append(guard.set_points)
        if guard.state is GuardState.STOPPED:
            assert not guard.set_points.any()
    record = np.array(bench.record)
    assert np.all(np.isfinite(record))
    assert record.min() >= 0.0
    assert record.max() <= LIMITS.max_tension
    for k, (earlier, later) in enumerate(pairwise(record), start=1):
        if k not in dropped:
            assert np.all(np.abs(later - earlier) <= LIMITS.max_rate * TICK * 1e-6 + 1e-9)
    assert bench.seconds_to_slack() <= LIMITS.slack_after + 3 * TICK * 1e-6

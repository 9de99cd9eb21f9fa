"""Published beside true: errors, rest, slack, delays and the return of streams, on truths made by hand."""

import numpy as np
import pytest

from continuum_hw_imu.protocol.messages import GuardState
from tools.benchmarks.link.latency import delays, load_sent
from tools.benchmarks.link.latency_probe import Sample, State
from tools.benchmarks.link.resumption import good_again
from tools.benchmarks.link.truth import Truth, errors_of, load_truth, rms_of_worst

PERIOD = 1 / 60
TIME = 100.0 + PERIOD * np.arange(240)


def truth(angles=None, rates=None, set_points=None) -> Truth:
    none = np.zeros((len(TIME), 2))
    blocks = [none if block is None else block for block in (angles, rates, set_points)]
    following = np.where(blocks[2][:, 0] == 5.0, GuardState.FOLLOWING, GuardState.LETTING_GO)
    return Truth(1e6 * (TIME - 100.0), TIME, *blocks, none, following)


def state(stamp: float, angles, delay: float = 0.002) -> State:
    return State(stamp, stamp + delay, stamp + 2 * delay, stamp + 3 * delay, np.array(angles))


def columns(*shapes) -> np.ndarray:
    return np.stack(shapes, axis=1)


def test_errors_are_those_at_the_stamps():
    turning = TIME - 100.0
    stamps, off = errors_of(
        [state(99.0, [0, 0]), state(101.0, [1.0, 0.9]), state(101.005, [1.005, 1.0]), state(999.0, [0, 0])],
        truth(angles=columns(turning, turning)),
    )
    np.testing.assert_allclose(stamps, [101.0, 101.005])
    np.testing.assert_allclose(off, [[0.0, -0.1], [0.0, -0.005]], atol=1e-9)


def test_rms_is_that_of_the_worst_joint():
    assert rms_of_worst(np.radians([[1.0, 3.0], [1.0, -4.0]])) == pytest.approx(np.sqrt(12.5))


def test_rest_begins_a_second_after_the_last_motion():
    rates = columns(np.where((TIME > 101.0) & (TIME < 101.5), 1.0, 0.0), np.zeros_like(TIME))
    resting = truth(rates=rates).resting()
    assert not resting[TIME < 100.99].any()
    assert not resting[(TIME > 101.01) & (TIME < 102.45)].any()
    assert resting[TIME > 102.55].all()


def test_slack_counts_from_the_instant_and_only_for_good():
    pulled = np.where((TIME < 101.0) | ((TIME > 101.2) & (TIME < 101.5)), 5.0, 0.0)
    known = truth(set_points=columns(pulled, np.zeros_like(TIME)))
    assert known.slack_after(100.9) == pytest.approx(0.6, abs=PERIOD)
    assert known.slack_after(102.0) == 0.0
    assert known.let_go_after(101.3) == pytest.approx(0.2, abs=PERIOD)
    assert known.let_go_after(102.0) == 0.0
    assert known.between(100.0, 100.5).slack_after(100.1) == np.inf


def test_the_fastest_rise_does_not_count_falls():
    pulled = np.where(TIME < 101.0, 30.0 * (TIME - 100.0), 0.0)
    assert truth(set_points=columns(pulled, 0 * pulled)).fastest_rise() == pytest.approx(30.0)


def test_states_find_their_frames_and_missing_ones_are_counted():
    measured_at, written = TIME, TIME + 0.003
    received = [
        state(t + 0.001, [0, 0], delay=0.005) for k, t in enumerate(TIME) if 10 <= k < 200 and k not in (50, 60)
    ]
    found = delays(received, written, measured_at)
    assert found.missing == 2
    np.testing.assert_allclose(found.published, 0.003, atol=1e-9)
    np.testing.assert_allclose(found.received, 0.008, atol=1e-9)
    np.testing.assert_allclose(found.called, 0.013, atol=1e-9)
    np.testing.assert_allclose(found.shift, 0.001, atol=1e-9)


def test_files_of_the_emulator_are_read(tmp_path):
    file, sent = tmp_path / "truth.csv", tmp_path / "sent.csv"
    begin = (1 << 32) - 16_667  # the clock of the frames wraps with the second row
    file.write_text(
        "device_time_us,monotonic_s,theta_1,theta_2,theta_rate_1,theta_rate_2,set_point_1,tension_1,state,hand\n"
        f"{begin},7.0,0.1,0.2,1,2,9,8,1,0\n{begin + 16_667},7.016667,0.3,0.4,1,2,9,8,1,0\n"
    )
    sent.write_text(f"written_s,device_time_us,sequence\n7.002,{begin},5\n7.019,0,6\n")
    known = load_truth(file)
    np.testing.assert_array_equal(known.angles, [[0.1, 0.2], [0.3, 0.4]])
    np.testing.assert_array_equal(known.rates, [[1, 2], [1, 2]])
    np.testing.assert_array_equal(known.set_points, [[9], [9]])
    np.testing.assert_array_equal(load_sent(sent, known), [[7.002, 7.019], [7.0, 7.016667]])


def stream(*parts: tuple[float, float], delay: float = 0.01) -> list[Sample]:
    stamps = np.concatenate([np.arange(begin, end, PERIOD) for begin, end in parts])
    return [Sample(stamp, stamp + delay) for stamp in stamps]


def test_a_stream_is_good_from_its_first_whole_stretch_on():
    received = stream((99.0, 100.0), (100.2, 100.5), (100.7, 102.0))
    assert good_again(received, 100.1, PERIOD) == pytest.approx(0.61)
    assert good_again(received, 101.0, PERIOD) == pytest.approx(0.01, abs=PERIOD)
    assert good_again(received, 101.7, PERIOD) is None
    assert good_again([], 100.0, PERIOD) is None

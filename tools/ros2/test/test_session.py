"""An interrupt ends the command however rclpy passes it on."""

import os
import signal

import pytest

from ros2_standin.end_signals import ends_are_received
from ros2_standin.session import Session


class LosingExecutor:
    """Interrupted in the middle of a message: as rclpy does, it makes another error of what the handler raised."""

    def __init__(self, number: signal.Signals | None, error: Exception | None) -> None:
        self._number = number
        self._error = error

    def spin_once(self, timeout_sec: float) -> None:
        try:
            if self._number:
                os.kill(os.getpid(), self._number)
            signal.sigtimedwait([], min(timeout_sec, 0.01))  # signals are heard here
        except (KeyboardInterrupt, SystemExit):
            pass
        if self._error is not None:
            raise self._error


@pytest.fixture
def ended():
    """SIGTERM is heard as by the command."""

    def end(number: int, _frame: object) -> None:
        raise SystemExit(128 + number)

    before = signal.signal(signal.SIGTERM, end)
    yield
    signal.signal(signal.SIGTERM, before)


UNABLE = "Unable to convert call argument '0' to Python object"


@pytest.mark.parametrize("error", [RuntimeError(UNABLE), SystemError(UNABLE), None])
@pytest.mark.parametrize(("number", "raised"), [(signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, SystemExit)])
@pytest.mark.usefixtures("ended")
def test_what_ends_the_command_is_not_lost(
    number: signal.Signals, raised: type[BaseException], error: Exception | None
) -> None:
    handlers = [signal.getsignal(one) for one in (signal.SIGINT, signal.SIGTERM)]
    with pytest.raises(raised):
        Session(None, LosingExecutor(number, error), 0.0).spin_for(10.0)
    assert [signal.getsignal(one) for one in (signal.SIGINT, signal.SIGTERM)] == handlers


@pytest.mark.usefixtures("ended")
def test_an_error_without_a_signal_is_what_it_is() -> None:
    with pytest.raises(RuntimeError, match="Unable"):
        Session(None, LosingExecutor(None, RuntimeError(UNABLE)), 0.0).spin_for(10.0)


def test_a_signal_that_nobody_takes_is_left_alone() -> None:
    before = signal.signal(signal.SIGTERM, signal.SIG_DFL)
    try:
        with ends_are_received():
            assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL
    finally:
        signal.signal(signal.SIGTERM, before)

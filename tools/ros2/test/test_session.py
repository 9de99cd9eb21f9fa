"""An interrupt ends the command however rclpy passes it on."""

import os
import signal

import pytest

from ros2_standin.session import Session


class LosingExecutor:
    """Interrupted in the middle of a message: as rclpy does, it makes another error of what the handler raised."""

    def __init__(self, number: signal.Signals | None) -> None:
        self._number = number

    def spin_once(self, timeout_sec: float) -> None:
        try:
            if self._number:
                os.kill(os.getpid(), self._number)
            signal.sigtimedwait([], min(timeout_sec, 0.01))  # signals are heard here
        except (KeyboardInterrupt, SystemExit):
            pass
        raise RuntimeError("Unable to convert call argument '0' to Python object")


@pytest.fixture
def ended():
    """SIGTERM is heard as by the command."""

    def end(number: int, _frame: object) -> None:
        raise SystemExit(128 + number)

    before = signal.signal(signal.SIGTERM, end)
    yield
    signal.signal(signal.SIGTERM, before)


@pytest.mark.parametrize(
    ("number", "raised"),
    [(signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, SystemExit), (None, RuntimeError)],
)
@pytest.mark.usefixtures("ended")
def test_what_ends_the_command_is_not_lost(number: signal.Signals | None, raised: type[BaseException]) -> None:
    handlers = [signal.getsignal(one) for one in (signal.SIGINT, signal.SIGTERM)]
    with pytest.raises(raised):
        Session(None, LosingExecutor(number), 0.0).spin_for(10.0)
    assert [signal.getsignal(one) for one in (signal.SIGINT, signal.SIGTERM)] == handlers

"""`ros2 run continuum_hw_imu bench_emulator`, as a process: its line, its link, its orders, its end."""

import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest
from ament_index_python.packages import get_package_prefix
from harness import wait_until

from continuum_hw_imu.emulator import command
from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.decoder import Decoder

pytestmark = pytest.mark.slow

PROGRAM = Path(get_package_prefix("continuum_hw_imu")) / "lib" / "continuum_hw_imu" / "bench_emulator"


@contextmanager
def emulator(*arguments: object) -> Iterator[subprocess.Popen]:
    """Running, its port ready; killed at the end if it still runs."""
    process = subprocess.Popen(
        [PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


@pytest.fixture
def refusal(capsys, monkeypatch, tmp_path):
    """In the same process, for speed: the line in which it says that it does not start."""
    monkeypatch.chdir(tmp_path)

    def of_arguments(*arguments: object) -> str:
        monkeypatch.setattr(sys, "argv", ["bench_emulator", *map(str, arguments)])
        try:
            code = command.main()
        except SystemExit as end:  # argparse's way
            code = end.code
        said = capsys.readouterr()
        assert (code, said.out) == (2, "")
        return said.err

    return of_arguments


def test_it_streams_obeys_and_ends_cleanly(tmp_path):
    link, control = tmp_path / "port", tmp_path / "control"
    with emulator("--link", link, "--control", control, "--truth", tmp_path / "truth.csv") as process:
        assert process.stdout.readline() == f"port {link}\n"
        port = os.open(link, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        decoder, received = Decoder.of_host(), []

        def listen() -> list:
            with suppress(BlockingIOError):
                received.extend(frame.message for frame in decoder.feed(os.read(port, 1 << 16)))
            return received

        wait_until(lambda: [x for x in listen() if isinstance(x, m.ImuFrame)], "sensors")
        assert [x for x in received if isinstance(x, m.Hello)]
        with socket.socket(socket.AF_UNIX) as client:
            client.connect(str(control))
            answers = client.makefile("rw")
            for order, ok in (("status", True), ("drop sensor=2 for=60", True), ("nonsense", False)):
                answers.write(order + "\n")
                answers.flush()
                assert json.loads(answers.readline())["ok"] is ok
        received.clear()
        wait_until(lambda: m.Fault(m.FaultCode.SENSOR_LOST, 2) in listen(), "the sensor's loss")
        os.close(port)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=30)
        assert (process.returncode, errors) == (0, "")
    assert not link.is_symlink()
    assert not control.exists()
    assert (tmp_path / "truth.csv").read_text().count("\n") >= 2


def test_a_script_of_faults_is_carried_out(tmp_path):
    script, link = tmp_path / "faults", tmp_path / "port"
    script.write_text("at 0.2 unplug for=0.5  # and back\n")
    with emulator("--link", link, "--faults", script) as process:
        process.stdout.readline()
        wait_until(lambda: not link.is_symlink(), "the port to go", pause=0.001)
        wait_until(link.is_symlink, "the port to come back")


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        (["--model", "none.yaml"], "none.yaml"),
        (["--faults", "no/such/file"], "no/such/file"),
        (["--truth", "no/such/folder/truth.csv"], "truth.csv"),
        (["--control", "x" * 200], "too long"),
        (["--bend", "1000"], "1000"),
        (["--rate", "fast"], "fast"),
    ],
)
def test_a_bad_start_is_one_line(arguments, problem, refusal):
    line = refusal(*arguments)
    assert problem in line
    assert "Traceback" not in line


def test_a_bad_script_is_reported_by_its_line(tmp_path, refusal):
    script = tmp_path / "faults"
    script.write_text("at 1 unplug\nat 2 drop sensor=9\n")
    assert "sensor" in refusal("--faults", script)


def test_a_file_in_the_place_of_the_link_is_not_overwritten(tmp_path, refusal):
    precious = tmp_path / "port"
    precious.write_text("precious")
    assert "--link" in refusal("--link", precious)
    assert precious.read_text() == "precious"

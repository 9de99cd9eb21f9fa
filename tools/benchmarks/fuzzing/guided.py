"""Coverage-guided bytes through both parsers (Atheris): inputs that reach new code are kept and mutated further.

It needs a separate process, since libFuzzer ends it: ``python3 -m tools.benchmarks.fuzzing.guided BYTES RESULT.json``.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

sys.path.append("out/fuzz/extra")  # packages that `make fuzz` installs

import atheris
import numpy as np

with atheris.instrument_imports(include=["continuum_hw_imu.protocol", "continuum_hw_imu.receiver"]):
    from continuum_hw_imu.protocol import checksum, cobs
    from continuum_hw_imu.protocol.decoder import Decoder
    from continuum_hw_imu.protocol.frame import LONGEST_CODED
    from continuum_hw_imu.protocol.messages import OF_DEVICE, OF_HOST
    from continuum_hw_imu.receiver.bench_controller import BenchController
    from tools.benchmarks.fuzzing.campaign import HELLO, LIMITS
    from tools.benchmarks.fuzzing.line import content_of, sound_contents

_LONGEST_INPUT = 400
_SEEDS = 200
_TOKEN = 0
"""Token of the commander, so that guessed requests are accepted too."""


class Target:
    """Fuzz target. The first byte of an input selects whether the rest is used unchanged or sealed with its checksum.

    Attributes:
        size, inputs, accepted, waiting: counts so far.
    """

    def __init__(self, enough: int, result: Path) -> None:
        self._enough, self._result = enough, result
        self.size = self.inputs = self.accepted = self.waiting = 0

    def __call__(self, data: bytes) -> None:
        how, rest = data[:1], data[1:]
        sound = how >= b"\x40"
        line = b"\0" + cobs.encoded(checksum.sealed(rest)) + b"\0" if sound else rest
        self._try(line, rest if sound else None)
        self.inputs += 1
        self.size += len(line)
        if self.size >= self._enough:
            output = {"size": self.size, "inputs": self.inputs, "accepted": self.accepted, "waiting": self.waiting}
            self._result.write_text(json.dumps(output), encoding="utf-8")
            sys.stdout.flush()
            os._exit(0)

    def _try(self, line: bytes, sent: bytes | None) -> None:
        for decoder in (Decoder(OF_DEVICE), Decoder(OF_HOST)):
            frames = [*decoder.feed(line[: len(line) // 2]), *decoder.feed(line[len(line) // 2 :])]
            self.accepted += len(frames)
            self.waiting = max(self.waiting, decoder.waiting)
            if any(content_of(frame) != sent for frame in frames):
                raise AssertionError(f"accepted, but never sent: {frames}")
            if decoder.waiting > LONGEST_CODED:
                raise AssertionError(f"{decoder.waiting} bytes kept")
        device = BenchController(HELLO)
        device.guard.claim(_TOKEN, 0)
        device.hear(line, 1000)
        device.move_on(1000, 0.004)
        if not 0.0 <= device.guard.set_points.max() <= LIMITS.max_tension:
            raise AssertionError(f"tension {device.guard.set_points}")


def main() -> None:
    enough, result = int(sys.argv[1]), Path(sys.argv[2])
    seeds = result.parent / "seeds"
    seeds.mkdir(exist_ok=True)
    contents = sound_contents(np.random.default_rng(1))
    for k in range(_SEEDS):
        (seeds / f"{k}").write_bytes(b"\xff" + next(contents))
    options = ["guided", "-seed=1", f"-max_len={_LONGEST_INPUT}", "-verbosity=0", "-len_control=0"]
    options += [f"-artifact_prefix={result.parent}/", str(seeds)]
    atheris.Setup(options, Target(enough, result))
    atheris.Fuzz()


if __name__ == "__main__":
    main()

"""``make check-old``: set up the workspace with old versions and test it; the exit code is 1 if something fails."""

from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

from tools.setup.check_old import checkout
from tools.setup.check_old.steps import STEPS, Step
from tools.setup.environment import clean_environment

_LOG = "out/check_old.log"
_TAIL = 25  # printed lines of a failed step


def main() -> int:
    """Print one line for each step and a summary; return the exit code."""
    checkout.bring_up_to_date()
    setting_up = subprocess.run(["sh", "tools/setup/run.sh"], cwd=checkout.FOLDER, env=clean_environment(), check=False)
    if setting_up.returncode != 0:
        print("check-old: the old versions cannot be set up")
        return 1
    log = checkout.FOLDER / _LOG
    log.parent.mkdir(exist_ok=True)
    log.write_text("", encoding="utf-8")
    failed = [step.title for step in STEPS if not _passes(step, log)]
    passed = f"{len(STEPS) - len(failed)} of {len(STEPS)} steps passed with the versions of Ubuntu 24.04"
    print(f"check-old: {passed}{'; failed: ' if failed else ''}{', '.join(failed)}; output in {log}")
    return 1 if failed else 0


def _passes(step: Step, log: Path) -> bool:
    print(f"  {step.title} ...", end="", flush=True)
    began = time.monotonic()
    done = subprocess.run(
        ["bash", "-c", f"source install/setup.bash && {step.command}"],
        cwd=checkout.FOLDER,
        env=clean_environment() | {"OPENBLAS_NUM_THREADS": "1"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        check=False,
    )
    with log.open("a", encoding="utf-8") as file:
        file.write(f"$ {step.command}\n{done.stdout}exit code {done.returncode}\n\n")
    passes = done.returncode in step.codes
    seconds = f"{time.monotonic() - began:.0f} s"
    print(f" {'passed' if passes else 'failed'}, {seconds}", flush=True)
    if not passes:
        print(*done.stdout.splitlines()[-_TAIL:], f"exit code {done.returncode}", sep="\n", flush=True)
    return passes


if __name__ == "__main__":
    sys.exit(main())

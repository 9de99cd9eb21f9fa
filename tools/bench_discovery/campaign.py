"""Cases one after another, several at once: a plant's files go in, a verdict comes out."""

from __future__ import annotations

import json
import multiprocessing
import os
import resource
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from itertools import islice
from pathlib import Path
from typing import Any, Final

from blind.plant import Plan, make_case, write_case

from continuum.cli.diagnose import EXIT_CODES
from tools.bench_discovery.result import Result

_NEEDED: Final = {
    *("CC", "PATH", "HOME", "TMPDIR", "LANG", "LC_ALL", "XDG_CACHE_HOME"),
    *("VIRTUAL_ENV", "PYTHONPATH", "LD_LIBRARY_PATH", "AMENT_PREFIX_PATH"),
}


class DiagnosisFailedError(Exception):
    """No verdict came; the message says why."""


def diagnosed(files: list[Path], limit: float) -> dict[str, Any]:
    """The verdict of `continuum diagnose` on files, as a process of its own that is handed nothing else.

    Args:
        files: recordings.
        limit: after which it is ended [s].

    Raises:
        DiagnosisFailedError: it ended without a verdict, or not in time.
    """
    with tempfile.TemporaryDirectory() as folder:
        verdict = Path(folder) / "verdict.json"
        command = ["continuum", "diagnose", "--json", str(verdict), "--processes", "1", *map(str, files)]
        with subprocess.Popen(
            command,
            cwd=folder,
            env=surroundings(os.environ),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        ) as process:
            try:
                _, errors = process.communicate(timeout=limit)
            except subprocess.TimeoutExpired as error:
                raise DiagnosisFailedError(f"no verdict within {limit:g} s") from error
            finally:
                if process.poll() is None:
                    os.killpg(process.pid, signal.SIGKILL)
        if process.returncode not in EXIT_CODES.values():
            last = errors.strip().splitlines()[-1:] or ["nothing on stderr"]
            raise DiagnosisFailedError(f"exit code {process.returncode}: {last[0]}")
        return dict(json.loads(verdict.read_text(encoding="utf-8")))


def surroundings(environment: Mapping[str, str]) -> dict[str, str]:
    """What of an environment a diagnosis needs; no more, since a test's name is in it, and with it what is hidden."""
    return {name: value for name, value in environment.items() if name in _NEEDED} | {"OPENBLAS_NUM_THREADS": "1"}


def run_case(plan: Plan, digest: str, limit: float) -> Result:
    """Make a case, hand its files to the analysis, keep the truth out of its sight.

    To be called once in a process, so that the processor time of what it started is that of the diagnosis.
    """
    case = make_case(plan.effects, plan.size, plan.dataset, plan.seed, plan.noise)
    verdict, failure, began = None, "", time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        try:
            verdict = diagnosed(write_case(case, Path(folder) / "data"), limit)
        except DiagnosisFailedError as error:
            failure = str(error)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds, elapsed = used.ru_utime + used.ru_stime, time.monotonic() - began
    return Result(digest, plan, case.truth.plain(), verdict, failure, seconds, elapsed)


def left(plans: Iterable[Plan], results: Iterable[Result]) -> Iterator[Plan]:
    """Plans of which there is no result yet."""
    done = {result.plan for result in results}
    return (plan for plan in plans if plan not in done)


def run_campaign(
    plans: Iterator[Plan],
    jobs: int,
    run: Callable[[Plan], Result],
    is_over: Callable[[], bool],
) -> Iterator[Result]:
    """Results as they come; no case is begun once it is over, those that run are ended.

    Args:
        plans: perhaps without end.
        jobs: cases at once.
        run: called in a process of its own for each case; must be picklable.
        is_over: asked before each case.
    """
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(jobs, context, max_tasks_per_child=1) as pool:
        running: set[Future[Result]] = set()
        while True:
            if not is_over():
                running |= {pool.submit(run, plan) for plan in islice(plans, jobs - len(running))}
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            yield from (future.result() for future in done)

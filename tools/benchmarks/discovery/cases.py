"""Cases in worker processes: from a plant's files to a verdict."""

from __future__ import annotations

import contextlib
import json
import multiprocessing
import resource
import signal
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any, Final, NoReturn

from blind import moreau_plant, mujoco_plant

from continuum.discovery import diagnose
from continuum.discovery.verdict_json import as_mapping
from continuum.dynamics.model_file import load_model
from continuum.recordings.read_recording import read_recording
from tools.benchmarks.discovery.plans import Plan
from tools.benchmarks.discovery.result import Result, kept

_LIMIT = 600  # longest duration of one diagnosis [s]
MAKERS: Final = {"mujoco": mujoco_plant.make_case, "moreau": moreau_plant.make_case}
_SHOWN = 1500  # characters of a failure that are kept
MODEL = "lamecc_prototype.yaml"


def diagnosed(files: Sequence[Path]) -> tuple[dict[str, Any], float]:
    """Return the verdict on files as in `continuum diagnose --json`, and the processor time of the diagnosis [s]."""
    recordings, model = [read_recording(str(path)) for path in files], load_model(MODEL)
    began = time.process_time()
    result = diagnose(recordings, model, with_power=False)
    seconds = time.process_time() - began
    return dict(json.loads(json.dumps(as_mapping(result)))), seconds


def run_case(plan: Plan, digest: str, limit: int = _LIMIT) -> Result:
    """Create a case and diagnose its files without access to the truth, within ``limit`` [s]; 0 sets no limit."""
    verdict, failure, seconds = None, "", float("nan")
    case = MAKERS[plan.plant](plan.effects, plan.size, plan.recordings, plan.seed, plan.noise)
    began = time.process_time()
    with tempfile.TemporaryDirectory() as folder:
        signal.signal(signal.SIGALRM, _too_late)
        signal.alarm(limit)
        try:
            verdict, seconds = diagnosed(mujoco_plant.write_case(case, Path(folder) / "data"))
        except Exception:  # noqa: BLE001 - any failure is a result
            failure, seconds = traceback.format_exc()[-_SHOWN:], time.process_time() - began
        finally:
            signal.alarm(0)
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    hidden = list(case.truth.plain()["effects"])  # type: ignore[call-overload]
    short = None if verdict is None else kept(verdict)
    return Result(digest, plan, hidden, short, failure, round(seconds, 3), round(memory, 1))


def _too_late(*_: object) -> NoReturn:
    raise TimeoutError("no verdict within the limit")


def compile_first() -> None:
    """Compile the code of a diagnosis in a separate process, because compiling takes more memory than a diagnosis."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        pool.submit(_ready_worker).result()


def _ready_worker() -> None:
    """Ignore Ctrl-C, which the campaign handles, and load compiled code before times are measured."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with tempfile.TemporaryDirectory() as folder, contextlib.suppress(Exception):
        diagnosed(
            mujoco_plant.write_case(moreau_plant.make_case(dataset=("release", "multisine")), Path(folder) / "data")
        )


def run_campaign(
    plans: Iterator[Plan],
    jobs: int,
    digest: str,
    is_over: Callable[[], bool],
    run: Callable[[Plan, str], Result] = run_case,
    ready: Callable[[], None] = _ready_worker,
) -> Iterator[Result]:
    """Yield results as they arrive; after the end of the campaign no case is started, but running cases are completed.

    If a worker process dies, the cases that were running start again, each in a separate process.

    Args:
        plans: cases.
        jobs: number of simultaneous cases.
        digest: digest of the sources.
        is_over: function that is queried before each case.
        run: function that a worker calls for each case.
        ready: function that each worker calls once.
    """
    running: dict[Future[Result], Plan] = {}
    context = multiprocessing.get_context("spawn")
    while True:
        try:
            with ProcessPoolExecutor(jobs, context, ready) as pool:
                while True:
                    while len(running) < jobs and not is_over() and (plan := next(plans, None)) is not None:
                        running[pool.submit(run, plan, digest)] = plan
                    if not running:
                        return
                    for future in wait(running, return_when=FIRST_COMPLETED).done:
                        result = future.result()
                        del running[future]
                        yield result
        except BrokenProcessPool:
            lost, running = list(running.values()), {}
            for plan in lost:
                if len(lost) == 1:
                    yield Result(digest, plan, [], None, "its process ended", float("nan"), float("nan"))
                else:
                    yield from run_campaign(iter([plan]), 1, digest, lambda: False, run, ready)

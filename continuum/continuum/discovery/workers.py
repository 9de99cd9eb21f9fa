"""Trials on several cores: each worker keeps the question, and is sent what to try."""

from __future__ import annotations

import multiprocessing
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass, replace

from continuum.discovery.candidate import SMALL, USUAL, Addition, Extension, acts_at_joints
from continuum.discovery.evidence import gain, is_adequate
from continuum.discovery.joints import acting_joints
from continuum.discovery.likeliest_beginning import with_likeliest_beginning
from continuum.discovery.one_value import with_one_value
from continuum.discovery.question import Question
from continuum.discovery.some_runs import some_runs
from continuum.discovery.trial import Trial, fit_extension, judged
from continuum.identification.window_settling import STEPS

FIRST_LOOK = 2
"""Iterations: what helps shows in what they gain and what the slopes promise then, ..."""
LONG_LOOK = 6
"""... but where joints stick and slip the first steps of all may be in vain."""
_LOOK_STEPS = 3  # of each window's first state at each of them, but for close looks
_MANY_RUNS = 3


@dataclass(frozen=True)
class Task:
    """One trial to make.

    Attributes:
        extension: effects beyond Eq. 12.
        near: a trial to start from.
        iterations: of the fit, at most.
        find_joints: whether to find out at which joints the last effect acts, and to fit it there alone.
        is_look: whether half of the runs are enough, and their first states need not be found well.
        afresh: whether windows begin as measured, and not as in ``near``.
        closely: whether a look finds the first states as well as a fit does.
    """

    extension: Extension
    near: Trial | None
    iterations: int
    find_joints: bool = False
    is_look: bool = False
    afresh: bool = False
    closely: bool = False


def first_look(
    extension: Extension, near: Trial, iterations: int = FIRST_LOOK, afresh: bool = False, closely: bool = False
) -> Task:
    """A few iterations on half of the runs."""
    return Task(extension, near, iterations, is_look=True, afresh=afresh, closely=closely)


def make(question: Question, task: Task) -> Trial:
    """One trial."""
    if task.is_look and task.near is not None:
        part, near = question, task.near
        if len(question.recordings) >= _MANY_RUNS:
            part, near = some_runs(question, task.near)
        steps = STEPS if task.closely else _LOOK_STEPS
        size = SMALL if is_adequate(task.near) else USUAL
        near = with_likeliest_beginning(part, task.extension, _start(near, task), steps, size)
        return judged(task.extension, fit_extension(part, task.extension, near, task.iterations, 0, steps, part=size))
    start = None if task.near is None else _start(task.near, task)
    fitted = fit_extension(question, task.extension, start, task.iterations)
    whole = _from_one_value(question, judged(task.extension, fitted), task.iterations)
    last = task.extension[-1] if task.extension else None
    if not task.find_joints or last is None or not acts_at_joints(last.effect) or not fitted.parts:
        return whole
    return _at_few_joints(question, task, whole, acting_joints(fitted, last.effect))


def _start(near: Trial, task: Task) -> Trial:
    return replace(near, own=()) if task.afresh else near


def _at_few_joints(question: Question, task: Task, whole: Trial, joints: Sequence[int]) -> Trial:
    """The last effect at the first one or two of some joints, where all of them explain no more.

    A fit of all joints at once may have ended where no slope led to the few that do it.
    """
    best, simulations = None, whole.simulations
    for count in sorted({1, min(2, len(joints)), len(joints)}):
        at = (*task.extension[:-1], Addition(task.extension[-1].effect, tuple(sorted(joints[:count]))))
        there = judged(at, fit_extension(question, at, whole, task.iterations))
        there = _from_one_value(question, there, task.iterations)
        simulations += there.simulations
        if best is None or gain(there, best).is_distinct:
            best = there
    return replace(best or whole, simulations=simulations)


def _from_one_value(question: Question, trial: Trial, iterations: int) -> Trial:
    """The trial, or a better one from where its values of all recordings are one, if they may be."""
    if not trial.one_for_all.unknowns:
        return trial
    again = judged(trial.extension, fit_extension(question, trial.extension, with_one_value(trial), iterations))
    best = again if again.cost < trial.cost else trial
    return replace(best, simulations=trial.simulations + again.simulations)


type Make = Callable[[Sequence[Task]], Iterator[Trial]]
"""Makes trials, in the order in which they are done."""


@contextmanager
def workers(question: Question, processes: int) -> Iterator[Make]:
    """Make trials by so many processes; by this one alone where that is one."""
    if processes == 1:
        yield lambda tasks: (make(question, task) for task in tasks)
        return
    context, others = multiprocessing.get_context("spawn"), set(multiprocessing.active_children())
    heard = signal.getsignal(signal.SIGINT)
    try:
        with ProcessPoolExecutor(processes, context, initializer=_keep, initargs=(question,)) as pool:
            _begin_deaf(pool)
            try:
                yield lambda tasks: (
                    made.result() for made in as_completed([pool.submit(_make_kept, t) for t in tasks])
                )
            except KeyboardInterrupt:  # nobody waits for trials that nobody will see
                _set_interrupts(signal.SIG_IGN)  # a second one would leave the pool's locks as they are
                for worker in set(multiprocessing.active_children()) - others:
                    worker.terminate()
                raise
    finally:
        _set_interrupts(heard)


def _begin_deaf(pool: ProcessPoolExecutor) -> None:
    """Start all workers, with interrupts held back: one that hears an interrupt while it starts ends in a traceback."""
    held = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        pool.submit(_nothing)
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, held)


def _nothing() -> None:
    """What a pool starts its workers with."""


def _set_interrupts(handler: signal.Handlers | Callable[..., object] | int | None) -> None:
    """Take interrupts otherwise, where this thread may say how; None is a handler that Python cannot set back."""
    if handler is not None and threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, handler)


_kept: list[Question] = []


def _keep(question: Question) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # an interrupt from the terminal is the first process's to hear
    _kept[:] = [question]


def _make_kept(task: Task) -> Trial:
    return make(_kept[0], task)

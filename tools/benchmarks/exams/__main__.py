"""`make exams`: the diagnosis on arms from outside of this project; docs/exams.md.

Writes its record and overwrites docs/exams.md, unless `--out` names another folder.
"""

from __future__ import annotations

import argparse
import multiprocessing
import resource
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from continuum.whole_file import write_whole
from tools.benchmarks.exams import inertial_pair, two_joints, urdf_payload
from tools.benchmarks.exams.two_joints_page import section
from tools.benchmarks.exams.untuned import UNTUNED
from tools.benchmarks.record import Record
from tools.benchmarks.report import DOCS, publish
from tools.docs.markdown import paragraph
from tools.one_line import in_one_line

PAGE = "exams.md"

LEFT_OUT = "\n\n".join(
    [
        "## A robot of a package on PyPI",
        paragraph(
            "The package `nonlinear_benchmarks` 1.0.1 is an 18 kB wheel with five Python modules and no data: its",
            "`EMPS()` downloads `EMPS.zip` from Google Drive when it is called, and every other loader likewise",
            "downloads its data, from 4TU or another host. The data cannot be had from the registry alone, so this",
            "exam is left out.",
        ),
    ]
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=3, help="arms from a URDF; default %(default)s")
    parser.add_argument("--jobs", type=int, default=2, help="processes; default %(default)s")
    parser.add_argument("--out", type=Path, default=DOCS, help="folder of record and pages; default %(default)s")
    options = parser.parse_args()
    began = time.perf_counter()
    with ProcessPoolExecutor(options.jobs, multiprocessing.get_context("spawn")) as pool:
        first = pool.submit(two_joints.first_diagnosis)
        payload = pool.submit(urdf_payload.section, range(options.seeds))
        pair = pool.submit(inertial_pair.section)
        found = two_joints.answers(first.result(), pool)
        sections = [section(found), pair.result(), payload.result()]
    texts = [*(one.text for one in sections), LEFT_OUT, UNTUNED]
    write_whole(options.out / PAGE, page(texts, time.perf_counter() - began, processor_time(), options.jobs))
    print(f"written: {options.out / PAGE}")
    publish(Record("exams", "make exams", tuple(one for part in sections for one in part.figures)), options.out)


def processor_time() -> float:
    """Return the processor time of this process and of those that it has waited for [s]."""
    used = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(one.ru_utime + one.ru_stime for one in used)


def page(parts: list[str], seconds: float, processor: float, jobs: int) -> str:
    """Return all sections after a head with elapsed time, processor time and number of processes."""
    head = paragraph(
        "Made by `make exams`, which measures all but the figures of the last two sections: the diagnosis on a real",
        "arm that nobody of this project made, joint angles from real inertial sensors, and the way from a URDF to a",
        f"verdict on an arm that another program simulates. It took {seconds:.0f} s, and {processor:.0f} s of the",
        f"processor's time in {jobs} process{'es' * (jobs > 1)}. Every result is shown, whether it is right or not.",
    )
    return "\n\n".join(["# Exams", head, *parts]) + "\n"


if __name__ == "__main__":
    sys.exit(in_one_line(main))

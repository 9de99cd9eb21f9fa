"""`make reproduction`: reproduce the thesis's dynamic results; docs/reproduction.md and its pictures.

Writes its record and overwrites these files, unless `--out` names another folder.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from continuum.curvature.figure import write_curvature_figure
from continuum.curvature.sentences import nearer_in_words
from continuum.whole_file import write_whole
from tools.benchmarks.record import Figure, Record
from tools.benchmarks.report import DOCS, publish
from tools.benchmarks.reproduction.curvature import compare_curvature
from tools.benchmarks.reproduction.figures import draw_release
from tools.benchmarks.reproduction.page import page
from tools.benchmarks.reproduction.release import Release, over_all, prototype, reproduce_release
from tools.docs.small_png import shrink
from tools.one_line import in_one_line

NOT_PRINTED = tuple(("center_of_mass", 1e-3 * mm) for mm in (13.5, 25.0)) + tuple(
    ("friction_slope", slope) for slope in (100.0, 1000.0)
)
"""Alternatives to values that the thesis does not print: b2 and b1 of Table 1, and k_v divided and multiplied by 3."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--out",
        type=Path,
        default=DOCS,
        help="folder of the page and its pictures, which are overwritten; default %(default)s",
    )
    folder: Path = parser.parse_args().out
    release = reproduce_release(prototype())
    curvature = compare_curvature(release)
    otherwise = {change: reproduce_release(prototype(**dict([change]))) for change in NOT_PRINTED}
    pictures = folder / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    of_release, of_bend = (pictures / f"reproduction_{name}.png" for name in ("release", "bend"))
    draw_release(release, of_release)
    write_curvature_figure(curvature.measured.each[0], of_bend, "Repetition 7, first measured row")
    for picture in (of_release, of_bend):
        shrink(picture)
    write_whole(folder / "reproduction.md", page(release, otherwise, curvature))
    for name, run in (("from rest", release.from_rest), ("initial rates free", release.thrown)):
        each = release.distance(run)
        print(f"{name}: {over_all(each):.3f} deg rms over all joints, {each.max():.3f} deg the worst joint")
    for name, found in (("simulated", curvature.simulated), ("measured", curvature.measured)):
        print(f"{name} first row: {nearer_in_words(found.each[0])}")
    print(f"written: {folder}")
    publish(record_of(release), folder)


def record_of(release: Release) -> Record:
    """Return the record of the distances of Eq. 12 to the author's simulation and the measurement of repetition 7."""
    worst, over = release.distance(release.from_rest).max(), over_all(release.distance(release.thrown))
    ours, what = release.velocity_nrmse(release.thrown.theta), "repetition 7, Eq. 12"
    figures = (
        Figure(f"{what} from rest: largest distance to the author's simulation", worst, "degrees", at_most=0.9),
        Figure(f"{what}, initial rates free: distance to the author's simulation", over, "degrees", at_most=0.2),
        Figure(
            f"{what}, initial rates free: NRMSE of velocity", ours, rival="the author's simulation",
            rival_value=release.velocity_nrmse(release.published.theta),
        ),
    )  # fmt: skip
    return Record("reproduction", "make reproduction", figures)


if __name__ == "__main__":
    sys.exit(in_one_line(main))

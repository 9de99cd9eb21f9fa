"""The page of a diagnosis: sound, of one file, safe against names, without ids where a mechanic reads."""

from __future__ import annotations

import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest
from diagnosis_by_hand import N, cause, detectable, diagnosis, error, with_names

from continuum.discovery.decision import Kind
from continuum.discovery.report import write_report
from continuum.discovery.report.figures import charts_of_run
from continuum.discovery.report.steps import next_steps
from continuum.discovery.report.track_record import track_record
from continuum.discovery.result import Diagnosis, Experiment, HandTest
from continuum.dynamics.effect_lookup import effect_named, effect_names

VOID = {"meta", "br", "hr", "img", "input", "link", "col"}
ADDRESSES = {"src", "href", "xlink:href", "action", "data", "poster", "srcset", "style"}
HOSTILE = "\"'><script>alert(1)</script><img src=x onerror=alert(2)>{{ 7 * 7 }}\n\u202egpj.exe$x_{$&amp;"
SETS = {
    "adequate": diagnosis(Kind.ADEQUATE),
    "cause": diagnosis(Kind.CAUSE, [cause("tip_payload")]),
    "two causes": diagnosis(Kind.CAUSE, [cause("rest_angle", 2), cause("backlash", 0)]),
    "ambiguous": diagnosis(Kind.AMBIGUOUS, [cause("tip_payload")], [cause("inertia", 2)]),
    "unknown": diagnosis(Kind.UNKNOWN, [cause("angle_offset", 0, 1, 2, share=0.6)]),
    "nothing helps": diagnosis(Kind.UNKNOWN),
}
every_verdict = pytest.mark.parametrize("result", SETS.values(), ids=SETS.keys())


class Page(HTMLParser):
    """Elements of a page in order, each with those around it; refuses what is not balanced."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.around: list[str] = []
        self.elements: list[tuple[tuple[str, ...], dict[str, str]]] = []
        self.texts: list[tuple[tuple[str, ...], str]] = []
        self.feed(text)
        self.close()
        assert self.around == []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert len({name for name, _ in attrs}) == len(attrs)
        given = {name: value or "" for name, value in attrs}
        self.around.append(f"{tag}.{given['class']}" if "class" in given else tag)
        self.elements.append((tuple(self.around), given))
        if tag in VOID:
            self.around.pop()

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert any(one.startswith("svg") for one in self.around), f"<{tag}/> outside of SVG"
        self.handle_starttag(tag, attrs)
        self.around.pop()

    def handle_endtag(self, tag: str) -> None:
        assert self.around
        assert self.around.pop().split(".")[0] == tag

    def handle_data(self, data: str) -> None:
        if self.around:
            self.texts.append((tuple(self.around), data))

    def text(self, inside: str, without: str = "style") -> str:
        """All that stands inside an element and not inside another."""
        return " ".join(data for around, data in self.texts if inside in around and without not in around)


def page_of(result: Diagnosis, tmp_path: Path) -> Page:
    write_report(result, tmp_path / "page.html", "Made by hand.")
    return Page((tmp_path / "page.html").read_text(encoding="utf-8"))


@every_verdict
def test_a_page_is_balanced_and_of_one_file(result: Diagnosis, tmp_path: Path) -> None:
    page = page_of(result, tmp_path)
    kinds = {around[-1].split(".")[0] for around, _ in page.elements}
    assert kinds.isdisjoint({"script", "link", "iframe", "object", "embed", "img", "base"})
    for _, given in page.elements:
        assert not any(name.startswith("on") for name in given)
        assert not any("//" in given[name] or "url(" in given[name] for name in ADDRESSES & given.keys())
    assert "url(" not in page.text("style", without="")
    ids = [given["id"] for _, given in page.elements if "id" in given]
    assert len(set(ids)) == len(ids)


@every_verdict
def test_every_figure_holds_all_that_it_shows_and_fits_any_width(result: Diagnosis, tmp_path: Path) -> None:
    page = page_of(result, tmp_path)
    charts = [given for around, given in page.elements if around[-1] == "svg.chart"]
    assert len(charts) == 2 + 3 * N * len(result.recordings) + N
    for given in charts:
        width, height = (float(one) for one in given["viewbox"].split()[2:])
        assert width > height > 100
        assert given["aria-label"]
        assert not {"width", "height"} & given.keys()
    drawn = [given["d"] for around, given in page.elements if around[-1].startswith("path")]
    assert all(re.fullmatch(r"[MLHv\d. -]+", d) for d in drawn)
    colours = [given for around, given in page.elements if around[-1].startswith(("path", "text", "rect", "line"))]
    assert not any({"stroke", "fill", "style"} & given.keys() for given in colours), "the page's mode decides"


@every_verdict
def test_joints_of_a_recording_share_their_scales(result: Diagnosis) -> None:
    for r in range(len(result.recordings)):
        for kind in zip(*charts_of_run(result, r), strict=True):
            assert len({(one.y_ticks, one.x_ticks, one.zero) for one in kind}) == 1
        assert all(joint.residuals.band and not joint.angles.band for joint in charts_of_run(result, r))


@every_verdict
def test_how_often_such_a_verdict_is_right_is_stated(result: Diagnosis, tmp_path: Path) -> None:
    record = track_record(result.verdict.kind)
    assert record is not None
    text = page_of(result, tmp_path).text("main.first")
    assert {str(record.n), str(record.right)} <= set(re.findall(r"\d+", text))


@every_verdict
def test_tables_may_be_wide_and_the_page_is_not(result: Diagnosis, tmp_path: Path) -> None:
    page = page_of(result, tmp_path)
    tables = [around for around, _ in page.elements if around[-1].startswith("table")]
    assert tables
    assert all(around[-2] == "div.wide" for around in tables)
    assert not any(
        "width" in given for around, given in page.elements if around[-1].split(".")[0] in ("table", "td", "div")
    )


@every_verdict
def test_names_of_recordings_change_nothing_but_themselves(result: Diagnosis, tmp_path: Path) -> None:
    plain, hostile = page_of(result, tmp_path), page_of(with_names(result, HOSTILE, "run_2"), tmp_path)
    assert [around for around, _ in hostile.elements] == [around for around, _ in plain.elements]
    assert [given.keys() for _, given in hostile.elements] == [given.keys() for _, given in plain.elements]
    shown = " ".join(text for _, text in hostile.texts)
    assert "<script>alert(1)</script>" in shown
    assert "{{ 7 * 7 }}" in shown
    assert "\u202e" not in shown


@pytest.mark.slow
@pytest.mark.parametrize("effect", effect_names())
@pytest.mark.parametrize("kind", [Kind.CAUSE, Kind.AMBIGUOUS, Kind.UNKNOWN])
def test_a_mechanic_reads_no_ids(effect: str, kind: Kind, tmp_path: Path) -> None:
    """They stand in small print next to the names, for readers who search for them."""
    other = "tip_payload" if effect != "tip_payload" else "base_tilt"
    sets = [[cause(effect, 1), cause("joint_friction", 0, 1, 2)], [cause(other)]]
    page = page_of(diagnosis(kind, *sets[: 2 if kind is Kind.AMBIGUOUS else 1]), tmp_path)
    words = page.text("main.first", without="small") + page.text("title", without="")
    assert not re.search(r"@|\[\d|\w\.\w+_\w", words)
    assert not re.findall(r"\b[a-z]+_[a-z]\w*", words)
    assert f"{effect}@2" in page.text("small")


def test_an_arm_that_lacks_a_name_for_an_effect_still_gets_words(tmp_path: Path) -> None:
    """Effects of other packages are shown without underscores."""
    result = diagnosis(Kind.ADEQUATE)
    more = replace(result, experiments=(Experiment("foam", "Take the sleeve off.", np.nan, 0, ("foam_sleeve@1,2",)),))
    assert "foam sleeve at joints 1 and 2" in page_of(more, tmp_path).text("main.first")


@every_verdict
def test_no_part_is_claimed_for_certain(result: Diagnosis, tmp_path: Path) -> None:
    for share in (0.0, 1.0, 0.999, 1.3, -0.2):
        sets = [[replace(one, share=replace(one.share, value=share)) for one in causes] for causes in result.sets]
        certain = replace(
            result, sets=tuple(map(tuple, sets)), closed=replace(result.closed, value=share, low=share, high=share)
        )
        page = page_of(certain, tmp_path)
        cells = [t for around, t in page.texts if "table.shares" in around and around[-1] == "td"]
        assert not {"0", "100"} & set(cells)
        assert not re.search(r"\b(0|100) %", page.text("main.first"))


def test_weights_of_explanations_do_not_read_as_certainty(tmp_path: Path) -> None:
    result = SETS["ambiguous"]
    verdict = replace(result.verdict, relative_fits=(0.9999, 0.0001))
    page = page_of(replace(result, verdict=verdict), tmp_path)
    cells = [text for around, text in page.texts if "table.shares" in around and around[-1] == "td"]
    assert "over 90" in cells
    assert "under 10" in cells


def test_what_gets_worse_is_warned_of(tmp_path: Path) -> None:
    worse, better = diagnosis(Kind.CAUSE, [cause("tip_payload")]), SETS["cause"]
    angles = (better.after.angles[0], worse.recordings[1].theta + error(2.5))
    one_run = replace(better, after=replace(better.after, angles=angles))
    assert warnings_of(better, tmp_path) == []
    assert [("run_2" in text, "run_1" in text) for text in warnings_of(one_run, tmp_path)] == [(True, False)]
    joint = [run.theta + error(0.1) * [1, 1, 30] for run in better.recordings]
    one_joint = replace(better, after=replace(better.after, angles=tuple(joint)))
    assert [("joint 3" in text, "joint 1" in text) for text in warnings_of(one_joint, tmp_path)][-1] == (True, False)


def test_recordings_that_contradict_themselves_are_warned_of(tmp_path: Path) -> None:
    result = SETS["nothing helps"]
    rates = [np.gradient(run.theta, run.times, axis=0) for run in result.recordings]
    for factor, warned in ((1.0, False), (1.3, True)):
        runs = [replace(run, theta_rate=factor * rate) for run, rate in zip(result.recordings, rates, strict=True)]
        output = replace(result, recordings=tuple(runs))
        assert bool(warnings_of(output, tmp_path)) is warned
        assert ("no effect of the library" in page_of(output, tmp_path).text("main.first")) is not warned


def test_a_rise_within_the_sensors_noise_is_no_warning(tmp_path: Path) -> None:
    for after, warned in ((2.005, False), (2.05, True)):
        result = diagnosis(Kind.CAUSE, [cause("tip_payload")], before=2.0, after=after)
        assert bool(warnings_of(result, tmp_path)) is warned


def test_simulations_that_fail_are_shown_as_such(tmp_path: Path) -> None:
    result = SETS["cause"]
    angles = [np.where(np.arange(len(one))[:, None] > 30, np.nan, one) for one in result.after.angles]
    page = page_of(replace(result, after=replace(result.after, angles=tuple(angles))), tmp_path)
    assert "nan" not in page.text("body").lower()


def test_what_would_not_have_been_shown_is_listed(tmp_path: Path) -> None:
    power = [
        detectable("base_tilt"), detectable("backlash", 0), detectable("backlash", 1, smallest=np.inf),
        detectable("quadratic_drag", smallest=3.0), detectable("tip_payload", smallest=np.inf),
    ]  # fmt: skip
    page = page_of(diagnosis(Kind.CAUSE, [cause("tip_payload")], power=power), tmp_path)
    marked = [text for around, text in page.texts if "table.values power" in around and around[-1] == "td.mark"]
    assert marked == ["none", "0.90"]
    assert "tip_payload" not in page.text("table.values power"), "what is found needs no power"
    assert "Of 3 further effects" in page.text("main.first")
    assert "1 would have been found" in page.text("main.first")
    assert "1.1" in page.text("table.values power"), "0.02 rad of play in degrees"


def test_values_stand_with_start_unit_and_bounds(tmp_path: Path) -> None:
    one = cause("rest_angle", 1, value=np.radians(57.0))
    (value,) = one.estimates
    stuck = replace(one, estimates=(replace(value, value=1.0, upper=1.0),))
    page = page_of(diagnosis(Kind.CAUSE, [stuck]), tmp_path)
    rows = [text for around, text in page.texts if "table.values" in around and text.strip()]
    assert "°" in rows
    assert any("57.3" in text for text in rows)
    assert [around for around, _ in page.texts if around[-1] == "strong.mark"]
    free = page_of(diagnosis(Kind.CAUSE, [one]), tmp_path)
    assert not [around for around, _ in free.texts if around[-1] == "strong.mark"]


def test_the_best_experiments_come_first(tmp_path: Path) -> None:
    level = Experiment("long", "Hold the arm level and let go.", 0.4, 1, ("joint_stiffness@1", "base_tilt"))
    pull = Experiment("short", "Pull slowly.", 0.2, 3, ())
    page = page_of(replace(SETS["ambiguous"], experiments=(level, pull)), tmp_path)
    assert "Hold the arm level" in page.text("main.first")
    assert "Pull slowly" not in page.text("main.first")
    assert "spring of joint 1 and base plate out of level" in page.text("table.experiments")
    assert page.text("table.experiments").index("Hold") < page.text("table.experiments").index("Pull")
    for kind in ("adequate", "nothing helps"):
        assert "Hold the arm level" in page_of(replace(SETS[kind], experiments=(level,)), tmp_path).text("main.first")


def test_a_run_that_separates_nothing_is_not_asked_for(tmp_path: Path) -> None:
    """A measurement by hand separates two explanations that simulate alike."""
    in_vain = Experiment("vain", "Hold the arm level and let go.", 0.1, 0, ())
    text = page_of(replace(SETS["ambiguous"], experiments=(in_vain,)), tmp_path).text("main.first")
    assert "Hold the arm level" not in text
    assert effect_named("tip_payload").experiment in text


def warnings_of(result: Diagnosis, tmp_path: Path) -> list[str]:
    return [text for around, text in page_of(result, tmp_path).texts if around[-1] == "p.warning"]


@pytest.mark.parametrize("runs", [0, 1, 5])
def test_what_separates_the_explanations_comes_first_and_nothing_is_said_twice(tmp_path: Path, runs: int) -> None:
    """A run that is made once or twice, else what decides by hand."""
    result = diagnosis(Kind.AMBIGUOUS, [cause("tip_payload")], [cause("inertia", 2)])
    run = Experiment("pull", "Pull slowly.", 0.2, runs, ())
    text = effect_named("tip_payload").experiment
    scales = HandTest("tip_payload", "mass", None, "kg", 0.002, 5.0, True, text)
    steps = next_steps(replace(result, experiments=(run,), hand_tests=(scales,)))
    assert steps[0].instruction == ("Pull slowly." if runs == 1 else text)
    assert len({step.instruction for step in steps}) == len(steps)
    assert page_of(replace(result, experiments=(run,), hand_tests=(scales,)), tmp_path).text("main.first")

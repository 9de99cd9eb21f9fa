"""Another language: nothing stays English but names, no figure changes, and files for machines are the same."""

from __future__ import annotations

import copy
import json
import pickle
import re
from collections.abc import Sequence
from dataclasses import replace
from gettext import GNUTranslations
from html import unescape
from importlib import import_module, resources
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command_line import Captured, code, refused
from curvature_runs import stops
from diagnosis_by_hand import cause, detectable, diagnosis
from dynamics_laws import prototype_model
from hypothesis import given
from hypothesis import strategies as st
from identification_laws import FINE, N, recorded
from recorded_runs import arm_file, write
from recorded_runs import run as kinematic_run

from continuum.cli.diagnose import show
from continuum.discovery.decision import Kind
from continuum.discovery.designs import designs
from continuum.discovery.report import write_report
from continuum.discovery.report.quantities import scale_of
from continuum.discovery.result import Detectable, Diagnosis, Experiment, HandTest, Removal
from continuum.dynamics.effect_lookup import effect_named, effect_names
from continuum.dynamics.model_file import save_model
from continuum.dynamics.parameters import PARAMETERS
from continuum.dynamics.simulator import Simulator
from continuum.errors import InvalidValueError
from continuum.languages import LANGUAGES, Message, Translator, translator
from continuum.recordings.motion_table import write_measured_motion

TOPICS = {word for topic in kinematic_run() for word in topic.strip("/").split("_")}
OTHERS = [language for language in LANGUAGES if language != "en"]
KINDS = {
    Kind.ADEQUATE: [],
    Kind.CAUSE: [[cause("rest_angle", 2, value=-0.1), cause("joint_friction", 0, 1), cause("sensor_cable")]],
    Kind.AMBIGUOUS: [[cause("tip_payload"), cause("angle_offset", 0, 1, 2)], [cause("sensor_cable")]],
    Kind.UNKNOWN: [[cause("inertia", 1)]],
}
each_language = pytest.mark.parametrize("language", OTHERS)
each_kind = pytest.mark.parametrize("kind", KINDS)


class _Masked(GNUTranslations):
    """A catalogue whose translations have no Latin letters but those of placeholders; what it lacks stays English."""

    def gettext(self, message: str) -> str:
        return _masked(message, super().gettext(message))

    def ngettext(self, msgid1: str, msgid2: str, n: int) -> str:
        return _masked(msgid1, super().ngettext(msgid1, msgid2, n))


def _masked(message: str, translation: str) -> str:
    if translation == message:
        return message
    return re.sub(r"(\{[^{}]*\})|[^\W\d_]", lambda found: found[1] or "ж", translation)


def masked(language: str) -> Translator:
    with resources.files("continuum.languages").joinpath(f"{language}.mo").open("rb") as file:
        return Translator(_Masked(file))


def printed(result: Diagnosis, tr: Translator, capsys: Captured) -> str:
    capsys.readouterr()
    show(result, tr)
    return capsys.readouterr().out


def page(result: Diagnosis, tr: Translator, tmp_path: Path) -> str:
    write_report(result, tmp_path / "page.html", "", tr)
    return read_by_people(tmp_path / "page.html")


def read_by_people(path: Path) -> str:
    """Text of a page, with what charts are called for those who cannot see them."""
    text = re.sub(r"<style>.*?</style>", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    return unescape(re.sub(r"<[^>]*>", " ", re.sub(r'<[^>]*aria-label="([^"]*)"[^>]*>', r" \1 ", text)))


def figures(text: str) -> list[str]:
    return re.findall(r"\d+(?:\.\d+)?(?:e[-+]\d+)?", text)


def names() -> set[str]:
    """Words that are the same in every language: of identifiers, units and symbols."""
    specs = [(name, spec) for effect in effect_names() for name, spec in effect_named(effect).parameters.items()]
    specs += PARAMETERS.items()
    units = [unit for name, spec in specs for unit in (spec.unit, scale_of(spec.unit, spec.meaning, name).unit)]
    known = [*effect_names(), *(name for name, _ in specs), *(spec.symbol for _, spec in specs), *units]
    return {*chain.from_iterable(map(words, known)), *("mN", "mm", "deg", "ms", "RMSE", "NRMSE", "measured", "run")}


def words(text: str) -> list[str]:
    """Runs of two Latin letters or more."""
    return re.findall(r"[A-Za-zÀ-ÿ]{2,}", text)


def english(text: str, *allowed: str) -> set[str]:
    """Words of a masked text that no catalogue has had."""
    return {word.lower() for word in words(text)} - {name.lower() for name in (*names(), *allowed)}


def everything(kind: Kind, sets: Sequence[Any] = ()) -> Diagnosis:
    """An answer with all that one may have."""
    shown = [detectable(name) for name in effect_names()]
    hidden = [detectable(name, joint, smallest=9.0) for name in ("backlash", "inertia") for joint in (0, 2)]
    hidden.append(detectable("quadratic_drag", smallest=9.0))
    infinite = Detectable(
        "gyro_drift", (1,), "bias", "rad/s", 0.01, np.inf, Message("It changes nothing in these recordings.")
    )
    result = diagnosis(kind, *(sets or KINDS[kind]), after=3.0, power=(*shown[:12], *hidden, infinite))
    plans = designs(prototype_model(3), result.recordings)
    runs = tuple(
        Experiment(
            plan.name, plan.instruction, 0.2, k, ("base_tilt", "rest_angle@1,2,3", "backlash@1", *effect_names()[:9])
        )
        for k, plan in enumerate(plans, start=0 if kind is Kind.CAUSE else 3)
    )
    own = tuple(replace(one, recording="run_1") for one in cause("angle_offset", 1).estimates)
    notes = (
        Message(
            "{name}: {note}",
            name="run_1",
            note=Message("{rows} with a clipped rate", rows=Message("rows {numbers}", numbers="3, 4")),
        ),
        Message(
            "{effects}: each recording has its own value, which a model file leaves at zero", effects="angle_offset"
        ),
    )
    return replace(
        result, experiments=runs, notes=notes, estimates=(*result.estimates, *own), zeroed=("run_2",),
        measured=("tip_payload.mass = 0.003 +- 0.0005 kg",),
        verdict=replace(result.verdict, steady=kind is Kind.ADEQUATE, complete=False),
    )  # fmt: skip


@each_language
@each_kind
def test_nothing_of_a_diagnosis_stays_english(kind: Kind, language: str, tmp_path: Path, capsys: Captured) -> None:
    tr, result = masked(language), everything(kind)
    assert english(printed(result, tr, capsys)) == set()
    assert english(page(result, tr, tmp_path)) == set()


@pytest.mark.slow
@each_language
@pytest.mark.parametrize("effect", effect_names())
def test_nothing_of_an_effect_stays_english(effect: str, language: str, tmp_path: Path, capsys: Captured) -> None:
    """At one joint, at some and at all, with values above and below none, found and in doubt."""
    tr = masked(language)
    for value in (0.1, -0.1):
        sets = [
            [cause(effect, 1, value=value)],
            [cause(effect, 0, 1, 2, value=value)],
            [cause(effect, 0, 2)],
            [cause(effect)],
        ]
        for result in (everything(Kind.AMBIGUOUS, sets), everything(Kind.CAUSE, [sets[0]])):
            assert english(printed(result, tr, capsys)) == set()
            assert english(page(result, tr, tmp_path)) == set()


@each_language
@each_kind
def test_figures_are_the_same_in_every_language(kind: Kind, language: str, tmp_path: Path, capsys: Captured) -> None:
    result, tr, plain = everything(kind), translator(language), translator("en")
    assert figures(printed(result, tr, capsys)) == figures(printed(result, plain, capsys))
    assert figures(page(result, tr, tmp_path)) == figures(page(result, plain, tmp_path))


@each_language
@pytest.mark.parametrize("kind", ["by hand", "taken off"])
def test_what_separates_explanations_is_translated(kind: str, language: str, tmp_path: Path, capsys: Captured) -> None:
    result, tr = diagnosis(Kind.AMBIGUOUS, *KINDS[Kind.AMBIGUOUS]), masked(language)
    how = effect_named("tip_payload").parameters["mass"].by_hand
    assert how is not None
    tests = (HandTest("tip_payload", "mass", None, "kg", 0.002, 5.0, True, how.how),)
    removals = (Removal("sensor_cable", effect_named("sensor_cable").removal),)
    some = Experiment(Message("multisine"), Message("It changes nothing in these recordings."), 0.0, 0, ())
    found = replace(
        result, hand_tests=tests if kind == "by hand" else (), removals=removals, experiments=(some,), notes=()
    )
    assert english(printed(found, tr, capsys)) == set()
    assert english(page(found, tr, tmp_path), "without") == set()


@each_language
def test_a_page_names_its_language(language: str, tmp_path: Path) -> None:
    write_report(everything(Kind.CAUSE), tmp_path / "page.html", "", translator(language))
    found = re.search(r'<html lang="([\w-]+)">', (tmp_path / "page.html").read_text(encoding="utf-8"))
    assert found is not None
    assert found[1].split("-")[0] == language


@pytest.fixture
def releases(tmp_path: Path) -> tuple[list[str], str]:
    """Files of two runs of a small arm with a bent spring, and of its nominal model."""
    model, random, files = prototype_model(N), np.random.default_rng(5), []
    save_model(model, tmp_path / "small.yaml")
    simulator = Simulator(model.with_values({"rest_angle": [0.0, 0.12]}), FINE)
    for number, bend in enumerate(((0.6, 0.4), (-0.5, 0.2)), start=1):
        run = recorded(simulator, bend, random, seconds=0.7)
        assert run.theta_rate is not None
        files.append(str(tmp_path / f"run_{number}.csv"))
        write_measured_motion(run.times, run.theta, run.theta_rate, files[-1])
    return files, str(tmp_path / "small.yaml")


def command_words(command: str, releases: tuple[list[str], str], tmp_path: Path) -> list[object]:
    files, model = releases
    if command == "curvature":
        times, theta = stops(np.radians([[0.0] * 5, [16.0] * 5, [9.0] * 5]))
        write_measured_motion(times, theta, np.gradient(theta, times, axis=0), tmp_path / "run_3.csv")
        return [command, tmp_path / "run_3.csv"]
    if command == "report":
        topics = kinematic_run()
        del topics["/section_config_states"][30:32]
        return [command, write(tmp_path / "run", topics), "--arm", arm_file(tmp_path / "arm.yaml")]
    page = ["--report", tmp_path / f"{command}.html"]
    return [command, *files, "--model", model, *page, *(["--validate", 2] if command == "identify" else [])]


@pytest.mark.slow
@pytest.mark.parametrize("command", ["diagnose", "identify", "curvature", "report"])
@each_language
def test_commands_translate_all_that_they_print(
    command: str, language: str, releases: tuple[list[str], str], tmp_path: Path, capsys: Captured,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """Figures are the same, but for times: no two runs take as long."""
    given = command_words(command, releases, tmp_path)

    def output(tr: Translator) -> tuple[str, str]:
        monkeypatch.setattr(import_module(f"continuum.cli.{command}"), "translator", lambda _: tr)
        code(*given)
        captured, path = capsys.readouterr(), tmp_path / f"{command}.html"
        text = captured.out + (read_by_people(path) if path.exists() else "")
        return text.replace(str(tmp_path), ""), captured.err

    files = ("continuum", "csv", "html", "yaml", "small", command)
    assert english("".join(output(masked(language))), *files, *TOPICS) == set()
    taken = re.compile(r"\d+\.\d s\b")
    translated, plain = (figures(taken.sub("", output(translator(one))[0])) for one in (language, "en"))
    assert translated == plain


@pytest.mark.slow
@each_language
def test_files_for_machines_are_english(language: str, releases: tuple[list[str], str], tmp_path: Path) -> None:
    files, model = releases
    found = []
    for one in ("en", language):
        path = tmp_path / f"{one}.json"
        code("diagnose", *files, "--model", model, "--json", path, "--lang", one)
        found.append(json.loads(path.read_text(encoding="utf-8")) | {"processor_seconds": 0})
    assert found[0] == found[1]


@pytest.mark.parametrize("command", ["diagnose", "identify", "curvature"])
def test_a_language_that_there_is_not_is_refused(command: str, capsys: Captured) -> None:
    line = refused(capsys, command, "run.csv", "--lang", "xx")
    assert "--lang" in line
    assert set(LANGUAGES) <= {*re.findall(r"\w+", line)}
    with pytest.raises(InvalidValueError, match=r"allowed: en or pt"):
        translator("xx")


@given(st.dictionaries(st.sampled_from(["a", "b"]), st.floats(-9, 9), min_size=2), st.text())
def test_a_message_is_its_sentence_and_survives_a_copy(values: dict[str, float], name: str) -> None:
    inner = Message("at {b:.3f}", **values)
    one = Message("{name}: {a:.2f} {inner}", name=name, inner=inner, **values)
    assert one == f"{name}: {values['a']:.2f} at {values['b']:.3f}"
    for twin in (copy.deepcopy(one), pickle.loads(pickle.dumps(one))):
        assert (twin, twin.template, twin.values) == (one, one.template, one.values)
        assert translator("en")(twin) == one

"""The answer as one self-contained page: for a mechanic first, then for engineers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from continuum.discovery.decision import Kind
from continuum.discovery.report import figures, power_tables, sentences, steps, tables, values
from continuum.discovery.report.environment import environment
from continuum.discovery.report.names import capital, with_names
from continuum.discovery.report.quantities import tenths
from continuum.discovery.result import Diagnosis
from continuum.languages import ENGLISH, Translator
from continuum.recordings.rate_ratio import odd_rates
from continuum.whole_file import write_whole


def write_report(result: Diagnosis, path: str | Path, made: str, tr: Translator = ENGLISH) -> None:
    """Write the page.

    Args:
        result: the answer.
        path: file to write.
        made: one line on how it was made.
        tr: to the language of the page.

    Raises:
        FileError: the file cannot be written.
    """
    template = environment(tr).get_template("report.html")
    write_whole(path, template.render(_first(result, tr), **_details(result, tr), made=made) + "\n")


def _first(result: Diagnosis, tr: Translator) -> dict[str, Any]:
    """Return what every reader reads."""
    contradictions = odd_rates(result.recordings)
    worst, kind = figures.worst_place(result), result.verdict.kind
    return {
        "kind": kind.value,
        "title": sentences.title(result, contradictions, tr),
        "verdict": sentences.verdict_sentence(result, contradictions, tr),
        "reliability": sentences.reliability(result, tr),
        "by_hand": sentences.by_hand(result, tr),
        "warnings": sentences.warnings(result, contradictions, tr),
        "extended": result.is_extended,
        "what": sentences.extension(result, tr),
        "charts": figures.first_charts(result, tr),
        "joint": worst.joint + 1,
        "run": result.recordings[worst.run].name,
        "rms": tables.error_rows(result)[worst.run].rms,
        "sets": tables.set_rows(result, tr) if kind is Kind.AMBIGUOUS else [],
        "weights": [tenths(p, tr) for p in result.verdict.relative_fits],
        "shares": tables.share_rows(result, tr) if result.is_extended else [],
        "steps": steps.next_steps(result, tr),
        "power_sentence": sentences.power_sentence(result, tr),
    }


def _details(result: Diagnosis, tr: Translator) -> dict[str, Any]:
    """Return what engineers read."""
    return {
        "runs": [(row, figures.charts_of_run(result, r, tr)) for r, row in enumerate(tables.error_rows(result))],
        "joints": tables.joint_rows(result, tr),
        "over_angle": figures.torques_over_angle(result, tr),
        "noise": f"{figures.noise_band(result):.2g}",
        "values": values.value_rows(result, result.causes, tr),
        "model_values": values.model_rows(result, tr),
        "alternatives": [
            (name, values.value_rows(result, causes, tr))
            for name, causes in zip(tables.names_of_sets(result, tr)[1:], result.sets[1:], strict=True)
        ],
        "correlation": values.correlation_rows(result, tr),
        "power": power_tables.power_rows(result, tr),
        "hidden": power_tables.hidden_effects(result, tr),
        "experiments": steps.experiment_rows(result, tr),
        "beware": sentences.similar_causes(result, tr),
        "notes": [capital(with_names(tr(note), tr)).rstrip(".") + "." for note in result.notes],
    }

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
from continuum.recordings.rate_ratio import odd_rates
from continuum.whole_file import write_whole


def write_report(result: Diagnosis, path: str | Path, made: str) -> None:
    """Write the page.

    Args:
        result: the answer.
        path: file to write.
        made: one line on how it was made.

    Raises:
        FileError: the file cannot be written.
    """
    template = environment().get_template("report.html")
    write_whole(path, template.render(_first(result), **_details(result), made=made) + "\n")


def _first(result: Diagnosis) -> dict[str, Any]:
    """Return what every reader reads."""
    contradictions = odd_rates(result.recordings)
    worst, kind = figures.worst_place(result), result.verdict.kind
    return {
        "kind": kind.value,
        "title": sentences.title(result, contradictions),
        "verdict": sentences.verdict_sentence(result, contradictions),
        "reliability": sentences.reliability(result),
        "by_hand": sentences.by_hand(result),
        "warnings": sentences.warnings(result, contradictions),
        "extended": result.is_extended,
        "what": sentences.extension(result),
        "charts": figures.first_charts(result),
        "joint": worst.joint + 1,
        "run": result.recordings[worst.run].name,
        "rms": tables.error_rows(result)[worst.run].rms,
        "sets": tables.set_rows(result) if kind is Kind.AMBIGUOUS else [],
        "weights": [tenths(p) for p in result.verdict.probabilities],
        "shares": tables.share_rows(result) if result.is_extended else [],
        "steps": steps.next_steps(result),
        "power_sentence": sentences.power_sentence(result),
    }


def _details(result: Diagnosis) -> dict[str, Any]:
    """Return what engineers read."""
    return {
        "runs": [(row, figures.charts_of_run(result, r)) for r, row in enumerate(tables.error_rows(result))],
        "joints": tables.joint_rows(result),
        "over_angle": figures.torques_over_angle(result),
        "noise": f"{figures.noise_band(result):.2g}",
        "values": values.value_rows(result, result.causes),
        "model_values": values.model_rows(result),
        "alternatives": [
            (name, values.value_rows(result, causes))
            for name, causes in zip(tables.names_of_sets(result)[1:], result.sets[1:], strict=True)
        ],
        "correlation": values.correlation_rows(result),
        "power": power_tables.power_rows(result),
        "hidden": power_tables.hidden_effects(result),
        "experiments": steps.experiment_rows(result),
        "beware": sentences.similar_causes(result),
        "notes": [capital(with_names(note)).rstrip(".") + "." for note in result.notes],
    }

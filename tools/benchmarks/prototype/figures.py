"""The record of `make prototype`."""

from __future__ import annotations

import numpy as np

from continuum.identification.nrmse import nrmse
from tools.benchmarks.prototype.account import Account
from tools.benchmarks.record import Figure, Record


def record_of(account: Account) -> Record:
    """Return the record of the errors of simulations for the measured run, and for its unseen end."""
    result, (run,) = account.diagnosis, account.diagnosis.recordings
    figures = [
        Figure(
            f"the prototype's release, {name} model: NRMSE of angles", nrmse(found.angles[0], run.theta),
            rival="the thesis's parameters, from rest", rival_value=nrmse(account.thesis, run.theta),
        )
        for name, found in (("extended", result.after), ("refitted", result.before))
        if name == "refitted" or result.is_extended
    ]  # fmt: skip
    ends = {(one.model, one.begins): float(np.sqrt(np.mean(one.degrees**2))) for one in account.predicted}
    if ("extended", "measured") in ends:
        what = "the prototype's release, its end predicted by the extended model: error of angles"
        error, refitted = ends["extended", "measured"], ends["refitted", "measured"]
        figures.append(Figure(what, error, "degrees", rival="the refitted model", rival_value=refitted))
    note = f"Verdict: {result.verdict.kind.value}."
    return Record("prototype", "make prototype", tuple(figures), notes=(note,))

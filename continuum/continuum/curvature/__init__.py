"""Curvature of an arm at rest: constant curvature and the dynamic model compared with what was measured.

The thesis's chapter 4.3 and Fig. 10.

================  ==============================================================================
holds.py          stretches of a recording in which no joint moves
median_error.py   errors of a hold's medians from the true angles
held_posture.py   the posture in which the dynamic model holds a given total bend
comparison.py     distances of both models from a measured posture, and which of them is nearer
sentences.py      the answer in words
table.py          the answer as CSV and JSON
figure.py         Fig. 10
================  ==============================================================================

Public: `answer.answer`, `answer.holds_of`, `comparison.compare`, `table.write_csv`, `table.write_json`,
`figure.write_curvature_figure`.
"""

"""Discovery: what a simulation gets wrong, the cause by name, the model extended by it, and the gain measured.

=====================  =============================================================================
answer.py              all of it for a dataset, and no cause that may as well be absent
diagnose.py            from data to a verdict; question.py: what stays the same throughout
candidate.py           an effect as an extension of a model: what of it is unknown; joints.py: at which joints
trial.py               one extension fitted; held_out.py: and tested on runs that it has not seen
evidence.py            what trials say against each other, and whether what they leave is noise
round.py               all effects tried on top of what was found; workers.py: on several cores
search.py              round after round, until nothing is left
rows_asked_again.py    whether tensions go on or jump between rows, when a cause is known
judgement.py           from the rounds to verdict.py, the answer as a typed value
confirmation.py        and whether free runs of held-out recordings bear it out
measured_gain.py       free runs before and after (Table 4); motion_phases.py: and when they go wrong
findings.py            all that there is to tell
residual_torque.py     what torque is missing; structure_tests.py: and what it goes with; turns.py: reversals
in_words.py            for a mechanic; verdict_json.py: for machines; report_html.py, pictures.py: a page
=====================  =============================================================================

Where fits begin: some_runs.py, likeliest_beginning.py, window_beginnings.py.
"""

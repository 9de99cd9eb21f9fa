"""Discovery: what a simulation gets wrong, the cause by name, the model extended by it, and the gain measured.

=======================  ===========================================================================
structure_left.py        is what a model leaves noise, or has it structure
candidate.py             an effect as an extension of a model: what of it is unknown, at which joints
trial.py                 one candidate fitted, and tested on runs that it has not seen
search.py                round after round: try all effects, keep the best, until nothing is left
equivalence.py           which causes these data cannot tell apart
verdict.py               the answer as a typed value
diagnose.py              all of it for a dataset
=======================  ===========================================================================
"""

"""Dynamics of a planar chain that cables or torques drive: Eqs. 12 to 18 of the thesis, corrected and extensible.

====================  ==================================================================
expressions.py        why every equation works on numbers and on symbols
parameters.py         the physical parameters with units and bounds
planar/               the equations, term by term: its docstring lists them
effect.py, model.py   what extends Eq. 12; balance.py adds all of it up, and solves it for Eq. 18
input_signal.py       what drives the arm over time: tensions.py, joint_torques.py
compiled/             symbols to exact derivatives to machine code
====================  ==================================================================

Public: `model.Model`, `model.ActiveEffect`, `model_file.load_model`, `model_file.save_model`,
`model_file.model_from_mapping`, `commented_model.commented_model`, `parameters.Parameter`, `effect.Effect`,
`effect_lookup.effect_named`, `effect_lookup.effect_names`, `simulator.Simulator`, `tensions.Tensions`,
`tensions.slack`, `pulled_posture.pulled_posture`, `measuring.as_read`.
"""

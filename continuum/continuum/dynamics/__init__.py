"""Dynamics of a planar chain that cables or torques drive: Eqs. 12 to 18 of the thesis, corrected and extensible.

====================  ==================================================================
expressions.py        elementwise functions for numbers and symbols alike
parameters.py         the physical parameters with units and bounds
planar/               the equations, term by term, listed in the docstring of the package
effect.py, model.py   effects that extend Eq. 12; balance.py sums all terms, and solves for the rates of Eq. 18
input_signal.py       the inputs that drive the arm over time: tensions.py, joint_torques.py
compiled/             from symbols to exact derivatives to machine code
====================  ==================================================================

Public: `model.Model`, `model.ActiveEffect`, `model_file.load_model`, `model_file.save_model`,
`model_file.model_from_mapping`, `commented_model.commented_model`, `parameters.Parameter`, `effect.Effect`,
`effect_lookup.effect_named`, `effect_lookup.effect_names`, `simulator.Simulator`, `tensions.Tensions`,
`tensions.slack`, `pulled_posture.pulled_posture`, `planar.backbone.backbone`, `measuring.as_read`.
"""

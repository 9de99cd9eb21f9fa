"""Which curvature an arm has while it rests: constant curvature and the dynamic model beside what was measured.

The thesis's chapter 4.3 and Fig. 10.

================  ==============================================================================
holds.py          stretches of a recording in which no joint moves
median_error.py   how far a hold's medians may be from the true angles
held_posture.py   the posture in which the dynamic model holds a given total bend
comparison.py     distances of both models from a measured posture, and which of them is nearer
sentences.py      the answer in words
table.py          the answer as CSV and JSON
figure.py         Fig. 10
================  ==============================================================================
"""

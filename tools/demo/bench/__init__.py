"""`make bench-demo`: a bench is calibrated, pulled and released next to a simulated arm, recorded, and diagnosed.

The bench is emulated, its arm with one joint that is too tight, unless `--port` names a real one.
"""

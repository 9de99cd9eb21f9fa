"""`make bench-demo`: a bench is calibrated, pulled and released beside a simulated arm, recorded, and diagnosed.

The bench is emulated, with a weight at its tip that the model does not know, unless `--port` names a real one.
"""

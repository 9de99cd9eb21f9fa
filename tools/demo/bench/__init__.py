"""`make bench-demo`: a bench is calibrated, pulled and released next to a simulated arm, recorded, and diagnosed.

Without `--port` for a real bench, the bench is emulated, and its arm has one joint that is too tight.
"""

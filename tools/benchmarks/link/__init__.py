"""`make bench-link`: emulated bench and bridge as real processes over a pseudo-terminal and DDS, measured.

Parts: `closed` (angles, frames, latency, load), `campaign` (every fault alone and in pairs), `crash_tests` (the bridge
killed or hanging, the port gone), `soak` (memory). Each part writes its results to the folder of results, and the
record summarises all results in it.
"""

"""Effects that Eq. 12 of the thesis leaves out, one file each; `docs/effects.md` lists them and tells how to add one.

Each file defines one class, named after the file and found through its entry point; no module imports it. Shared code
is in `_parts.py`. An effect is absent when its parameters have their defaults. Parameters whose default is 0 are sizes,
except those marked ``shape``; all others describe the shape of the effect.
"""

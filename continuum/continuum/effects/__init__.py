"""Effects that the thesis's Eq. 12 leaves out, one small file each; `docs/effects.md` lists them, and how to add one.

A file here holds one class, named as the file, and is found by its entry point: nothing imports it. What several of
them need stands in `_parts.py`. At their defaults they are absent; parameters that are 0 then say how large an effect
is, the others only what it looks like once it is there.
"""

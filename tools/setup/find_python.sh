#!/bin/sh
# Print the path of a Python 3.12 that works and can make virtual environments, or say what to install.
# ROS 2 Jazzy's wheels exist for CPython 3.12 only. A python3.12 on the PATH may be a shim that does not run: each
# candidate is tried. The base interpreter is printed, so an active virtual environment does not matter.

probe='
import sys
sys.exit(1) if sys.version_info[:2] != (3, 12) or sys.implementation.name != "cpython" else None
import ensurepip, venv
print(getattr(sys, "_base_executable", sys.executable))
'

pyenv_root=${PYENV_ROOT:-$HOME/.pyenv}
for candidate in \
    "${PYTHON:-}" python3.12 python3 /usr/bin/python3.12 /usr/local/bin/python3.12 \
    "$pyenv_root"/versions/3.12*/bin/python "$HOME"/.pyenv/versions/3.12*/bin/python \
    "$HOME"/.local/share/uv/python/cpython-3.12*/bin/python3.12
do
    [ -n "$candidate" ] || continue
    found=$(env -u PYTHONHOME -u PYTHONPATH "$candidate" -S -s -c "$probe" 2>/dev/null) && [ -x "$found" ] || continue
    printf '%s\n' "$found"
    exit 0
done

cat >&2 <<'MESSAGE'
error: no working Python 3.12 found; the ROS 2 Jazzy wheels need exactly this version.
Install one, with its headers, by one of
    apt install python3.12 python3.12-venv python3.12-dev     (Ubuntu 24.04)
    pyenv install 3.12
    uv python install 3.12
or name it: make setup PYTHON=/path/to/python3.12
MESSAGE
exit 1

#!/bin/sh
# Entry of the set-up: find a Python 3.12 and hand over to tools/setup/__main__.py. Arguments: none, or "lock".
cd -- "$(dirname -- "$0")/../.." || exit 1
python=$(sh tools/setup/find_python.sh) || exit 1
exec "$python" -E -s -m tools.setup "$@"

"""`make setup`: update .venv, build/ and install/ where they differ from the checkout. Also `make lock`."""

import fcntl
import sys
from collections.abc import Iterator
from contextlib import contextmanager

from tools.setup import stamp, virtual_environment, workspace
from tools.setup.layout import LOG, LOG_FILE, SetupError


def main(arguments: list[str]) -> int:
    """Run the set-up, or with ``lock`` the resolution of versions; return the exit code."""
    try:
        with _alone():
            if arguments == ["lock"]:
                virtual_environment.lock()
            else:
                _set_up()
    except SetupError as error:
        print(f"{error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("\ninterrupted; the same command goes on from here", file=sys.stderr)
        return 130
    return 0


def _set_up() -> None:
    made, wanted = stamp.made(), stamp.wanted()
    if made == wanted:
        return
    print("Setting up the workspace.", flush=True)
    LOG_FILE.unlink(missing_ok=True)
    workspace.check_build_tools()
    if made.environment != wanted.environment or made.packages.keys() - wanted.packages.keys():
        workspace.remove()
        virtual_environment.make()
        made = stamp.Stamp(wanted.environment)
        made.write()
    virtual_environment.write_shell_files()
    stale = [name for name, digest in wanted.packages.items() if made.packages.get(name) != digest]
    workspace.build(stale, compiled=made.compiled == wanted.compiled)
    wanted.write()
    print("Ready: `make demo`, or `source install/setup.bash` and then `continuum --help`.", flush=True)


@contextmanager
def _alone() -> Iterator[None]:
    """Hold the set-up's lock, so that two runs in one checkout do not overlap."""
    LOG.mkdir(exist_ok=True)
    with (LOG / "setup.lock").open("w") as lock_file:
        try:
            fcntl.flock(lock_file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            print("Another set-up is at work in this checkout; waiting for it.", flush=True)
            fcntl.flock(lock_file, fcntl.LOCK_EX)
        yield


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

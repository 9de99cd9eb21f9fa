"""`continuum view`: an arm in the browser, moved by sliders, by a target that is dragged, or by a recording."""

from __future__ import annotations

import argparse
import signal
import sys
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

from continuum.arm import Arm, load_arm
from continuum.cli.completion import completes_files
from continuum.errors import InvalidValueError
from continuum.shipped_files import ARMS
from continuum.viewer.address import HOST, PORT

if TYPE_CHECKING:
    from continuum.viewer.seen import Source


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "view", help="see an arm or a recording in the browser", description=__doc__,
        epilog="What nodes do is shown by: ros2 run continuum_manipulator viewer",
    )  # fmt: skip
    what = parser.add_argument(
        "what", metavar="ARM.yaml|RECORDING", nargs="?",
        help="arm to move, by its file or the name of one of the library's; or what to play: the folder of a rosbag2 "
        "recording, or a CSV table of joint angles",
    )  # fmt: skip
    arm = parser.add_argument(
        "--arm", metavar="ARM.yaml", help="arm of the recording; default: modules of the prototype, as many as it has"
    )
    completes_files(what, ARMS, "csv")
    completes_files(arm, ARMS)
    parser.add_argument("--host", default=HOST, help="address to serve on; default %(default)s, this host alone")
    parser.add_argument("--port", type=int, default=PORT, help="0 for any that is free; default %(default)s")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Serve the page until Ctrl-C."""
    # Here, so that the other commands need neither viser nor the time to load it.
    from continuum.viewer.layout import NAME
    from continuum.viewer.page import Page

    arm, source = _shown(options)
    stop = threading.Event()
    title = NAME if options.what is None else f"{Path(options.what).name} - {NAME}"
    page = Page(arm, source, options.host, options.port, title=title)
    signal.signal(signal.SIGTERM, lambda *_: stop.set())
    print(f"open {page.address} in a browser; Ctrl-C ends it", flush=True)
    try:
        page.run(stop)
    except KeyboardInterrupt:
        print()
    finally:
        page.close()
    return 0


def _shown(options: argparse.Namespace) -> tuple[Arm, Source]:
    from continuum.recordings.bag import is_bag
    from continuum.recordings.recorded_arm import check_joints
    from continuum.viewer.default_arm import arm_of_joints, default_arm
    from continuum.viewer.manual_source import ManualSource
    from continuum.viewer.playback import Playback
    from continuum.viewer.tracks import read_tracks

    what = options.what
    if what is None or (_is_arm(what) and not is_bag(what)):
        if what is not None and options.arm is not None:
            raise InvalidValueError("--arm", options.arm, f"only beside a recording; {what} is an arm itself")
        file = options.arm if what is None else what
        arm = default_arm() if file is None else load_arm(file)
        return arm, ManualSource(arm)
    if sys.stdout.isatty():  # a refusal is one line, elsewhere
        print(f"reading {what} ...", flush=True)
    tracks = read_tracks(what)
    for note in tracks.notes:
        print(f"continuum: {what}: {note}", file=sys.stderr)
    if options.arm is None:
        arm = arm_of_joints(tracks.joints.names)
    else:
        arm = load_arm(options.arm)
        check_joints(what, tracks.joints.names, arm)
    return arm, Playback(arm, tracks, Path(what).name)


def _is_arm(what: str) -> bool:
    """Whether an arm is meant: by a YAML file, or by a bare name that nothing here has."""
    path = Path(what)
    return path.suffix in (".yaml", ".yml") or (path.name == what and not path.suffix and not path.exists())

"""`continuum view`: show an arm in the browser, moved by sliders or a draggable target, or play recordings."""

from __future__ import annotations

import argparse
import signal
import sys
import threading
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from continuum.arm import Arm, load_arm
from continuum.cli.browser_window import open_window
from continuum.cli.completion import completes_files
from continuum.cli.recordings import add_bag_options, named_joints
from continuum.cli.viewed_files import check_kinds, check_same_joints, is_arm, labels, load_viewed_arm
from continuum.errors import FileError, InvalidValueError
from continuum.joint_names import bending_joints
from continuum.shipped_files import ARMS, MODELS
from continuum.viewer.address import HOST, PORT

if TYPE_CHECKING:
    from continuum.viewer.seen import Source


def add_to(commands: Any) -> None:
    """Add this subcommand to the parser's."""
    parser = commands.add_parser(
        "view", help="show an arm or recordings in the browser", description=__doc__,
        epilog="To view running nodes: ros2 run continuum_manipulator viewer",
    )  # fmt: skip
    what = parser.add_argument(
        "what", metavar="ARM.yaml|RECORDING", nargs="*",
        help="arm file or name of a library arm to move, or recording to play: the folder of a rosbag2 recording, or a "
        "CSV table of joint angles; further recordings of the same arm are drawn over the first",
    )  # fmt: skip
    arm = parser.add_argument(
        "--arm",
        metavar="ARM.yaml",
        help="arm of the recording; default: the arm of --model, otherwise an arm of prototype modules with as many "
        "joints as the recording",
    )
    model = parser.add_argument(
        "--model", metavar="MODEL.yaml", action="append", default=[],
        help="draw the open-loop simulation of the recording by this model over it; may be repeated",
    )  # fmt: skip
    parser.add_argument("--section", metavar="NAME", help="section of --model, if the file has several sections")
    add_bag_options(parser)
    completes_files(what, ARMS, "csv")
    completes_files(arm, ARMS)
    completes_files(model, MODELS)
    parser.add_argument(
        "--host", default=HOST, help="address to serve on; default %(default)s, reachable from this host only"
    )
    parser.add_argument("--port", type=int, default=PORT, help="port; 0 for any free port; default %(default)s")
    parser.add_argument("--no-browser", action="store_true", help="print the address without opening it")
    parser.set_defaults(run=run)


def run(options: argparse.Namespace) -> int:
    """Serve the page until Ctrl-C."""
    # Here, so that the other commands need neither viser nor the time to load it.
    from continuum.viewer.layout import NAME
    from continuum.viewer.page import Page

    check_kinds(options.what)
    shown = _arm(options) if all(is_arm(one) for one in options.what) else _recordings(options)
    title = " - ".join([*([", ".join(labels(options.what))] if options.what else []), NAME])
    stop = threading.Event()
    page = Page(shown.arm, shown.source, options.host, options.port, title=title, hanging=shown.hanging)
    signal.signal(signal.SIGTERM, lambda *_: stop.set())
    print(f"open {page.address} in a browser; Ctrl-C ends it", flush=True)
    if not options.no_browser:
        open_window(page.address)
    try:
        page.run(stop)
    except KeyboardInterrupt:
        print()
    finally:
        page.close()
    return 0


@dataclass(frozen=True)
class _Shown:
    """What the page is made of."""

    arm: Arm
    source: Source
    hanging: bool = False


def _arm(options: argparse.Namespace) -> _Shown:
    """An arm that the page's user moves."""
    from continuum.viewer.default_arm import default_arm
    from continuum.viewer.manual_source import ManualSource

    if len(options.what) > 1:
        raise InvalidValueError("ARM.yaml", ", ".join(options.what), "one arm; several recordings can be compared")
    file = options.what[0] if options.what else options.arm
    arm = default_arm() if file is None else load_viewed_arm(file)
    others = {"--model": ", ".join(options.model), "--joints": options.joints, "--topic": options.topic}
    for option, value in {"--arm": options.arm, **others}.items():
        if value and (options.what or option in others):
            raise InvalidValueError(option, value, "only beside a recording")
    return _Shown(arm, ManualSource(arm))


def _print_notes(path: str, notes: Iterable[str]) -> None:
    for note in notes:
        print(f"continuum: {path}: {note}", file=sys.stderr)


def _recordings(options: argparse.Namespace) -> _Shown:
    """Recordings to play; the first is solid, the others and simulations are ghosts."""
    from continuum.cli.models import read_model
    from continuum.recordings.bag import is_bag
    from continuum.recordings.read_recording import read_recording
    from continuum.recordings.recorded_arm import check_joints
    from continuum.recordings.recording import Recording
    from continuum.viewer.default_arm import arm_of_joints
    from continuum.viewer.model_arm import arm_of_model, is_approximate
    from continuum.viewer.playback import Playback
    from continuum.viewer.tracks import Tracks, read_tracks, tracks_of

    if options.model and len(options.what) > 1:
        raise InvalidValueError("--model", ", ".join(options.model), "only beside one recording")
    models = [read_model(one, options.section) for one in options.model]
    model = models[0] if models else None
    joints = named_joints(options, options.what, model)
    has_own_names = bool(joints or options.topic or (model is not None and model.joints))

    def run_of(path: str) -> Recording:
        return read_recording(path, model, joints, options.topic)

    def read(path: str) -> Tracks:
        if sys.stdout.isatty():  # a refusal is one line, elsewhere
            print(f"reading {path} ...", flush=True)
        tracks = tracks_of(run_of(path)) if is_bag(path) and has_own_names else read_tracks(path)
        _print_notes(path, tracks.notes)
        return tracks

    first, *others = (read(path) for path in options.what)
    if options.arm is not None:
        arm = load_arm(options.arm)
        check_joints(options.what[0], first.joints.names, arm)
    elif options.model and len(sections := bending_joints(first.joints.names)) == 1:
        arm = arm_of_model(options.model[0], options.section, *sections)
        if is_approximate(models[0].parameters):
            note = "dimensions vary along the arm; the arm and its cables are drawn with their means"
            _print_notes(options.model[0], [note])
    elif not bending_joints(first.joints.names):
        found = first.joints.names
        raise FileError(
            options.what[0],
            f"has the joints {', '.join(found)}; name those of the arm from base to tip, as --joints {','.join(found)}",
        )
    else:
        arm = arm_of_joints(first.joints.names)
    for path, tracks in zip(options.what[1:], others, strict=True):
        check_same_joints(path, tracks.joints.names, options.what[0], first.joints.names)
    name, *names = labels([*options.what, *options.model])
    overlays = [tracks.joints for tracks in others]
    hanging = False
    if models:
        from continuum.viewer.open_loop import hangs, open_loop_track

        if sys.stdout.isatty():
            print("simulating ...", flush=True)
        recording, hanging = run_of(options.what[0]), hangs(models[0])
        _print_notes(options.what[0], [note for note in recording.notes if note not in first.notes])
        overlays = [
            open_loop_track(recording, first.joints, model, one, first.origin)
            for one, model in zip(options.model, models, strict=True)
        ]
    playback = Playback(arm, first, name, dict(zip(names, overlays, strict=True)))
    return _Shown(arm, playback, hanging)

"""``ros2 bag record``: start the workspace's recorder node, which writes rosbag2."""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import yaml

from ros2_standin.errors import UserError
from ros2_standin.packages import package_executable
from ros2_standin.run import become


def record_arguments(parser: argparse.ArgumentParser) -> None:
    """Arguments of ``record``."""
    parser.add_argument("topics", nargs="*", metavar="Topic", help="Space-delimited list of topics to record")
    parser.add_argument("--topics", nargs="+", metavar="Topic", default=[], dest="more_topics", help="The same")
    parser.add_argument("-a", "--all", action="store_true", help="Record all topics, also those that appear later")
    parser.add_argument("--all-topics", action="store_true", dest="all", help="The same")
    parser.add_argument("-o", "--output", type=Path, help="Destination of the bag to create (default: rosbag2_<date>)")
    parser.add_argument(
        "-s", "--storage", choices=("mcap", "sqlite3"), default="mcap", help="Storage identifier (default: mcap)"
    )
    parser.add_argument("--use-sim-time", action="store_true", help="Take the messages' times from /clock")
    parser.add_argument(
        "--node-name", default="rosbag2_recorder", help="Name of the recorder (default: rosbag2_recorder)"
    )


def record_verb(args: argparse.Namespace) -> None:
    """Become the recorder; an interrupt ends the recording normally."""
    topics = [*args.topics, *args.more_topics]
    if bool(topics) == args.all:
        raise UserError("[ERROR] [ros2bag]: Must specify only one option out of --all and a list of topics")
    output = args.output or Path(time.strftime("rosbag2_%Y_%m_%d-%H_%M_%S"))
    if output.exists():
        raise UserError(f"[ERROR] [ros2bag]: Output folder '{output}' already exists.")
    parameters: dict[str, object] = {"output": str(output), "storage": args.storage, "use_sim_time": args.use_sim_time}
    if topics:
        parameters["topics"] = topics
    recorder = package_executable("continuum_manipulator", "recorder")
    ros_args = [word for name, value in parameters.items() for word in ("-p", f"{name}:={_flow(value)}")]
    become([str(recorder), *args.ros_args, "--ros-args", "-r", f"__node:={args.node_name}", *ros_args])


def _flow(value: object) -> str:
    """Return a parameter's value in one line of YAML, with texts always quoted."""
    text = yaml.safe_dump(value, default_flow_style=True, default_style='"' if isinstance(value, str) else None)
    return text.removesuffix("\n").removesuffix("\n...")

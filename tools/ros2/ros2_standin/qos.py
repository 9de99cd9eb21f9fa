"""Quality of service: the stock options, and profiles that match the existing publishers."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from copy import copy

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.qos import (
    QoSDurabilityPolicy,
    QoSHistoryPolicy,
    QoSLivelinessPolicy,
    QoSPresetProfiles,
    QoSProfile,
    QoSReliabilityPolicy,
)

from ros2_standin.session import nonnegative_float, nonnegative_int

_BURST = 200
"""Number of messages that a subscription keeps for a busy reader."""

_KINDS = {
    "reliability": QoSReliabilityPolicy,
    "durability": QoSDurabilityPolicy,
    "history": QoSHistoryPolicy,
    "liveliness": QoSLivelinessPolicy,
}


def add_qos_arguments(parser: argparse.ArgumentParser, verb: str, preset: str) -> None:
    """Add the options ``--qos-*``, which override the preset."""
    parser.add_argument(
        "--qos-profile",
        choices=QoSPresetProfiles.short_keys(),
        help=f"Quality of service preset profile to {verb} with (default: {preset})",
    )
    parser.add_argument("--qos-depth", metavar="N", type=nonnegative_int, help="Queue size setting")
    for name, kind in _KINDS.items():
        parser.add_argument(
            f"--qos-{name}", choices=kind.short_keys(), help=f"Quality of service {name} setting to {verb} with"
        )
    parser.add_argument(
        "--qos-liveliness-lease-duration-seconds",
        metavar="S",
        type=nonnegative_float,
        help="Liveliness lease duration setting",
    )
    parser.set_defaults(qos_preset=preset)


def qos_from_arguments(args: argparse.Namespace) -> QoSProfile:
    """Return the preset with the overrides of the ``--qos-*`` options."""
    profile = copy(QoSPresetProfiles.get_from_short_key(args.qos_profile or args.qos_preset))
    if args.qos_depth is not None:
        profile.depth = args.qos_depth
    for name, kind in _KINDS.items():
        if (chosen := getattr(args, f"qos_{name}")) is not None:
            setattr(profile, name, kind[chosen.upper()])
    if args.qos_liveliness_lease_duration_seconds is not None:
        profile.liveliness_lease_duration = Duration(seconds=args.qos_liveliness_lease_duration_seconds)
    return profile


def qos_for_subscribing(args: argparse.Namespace, node: Node, topic: str) -> QoSProfile:
    """As ``qos_from_arguments``, but unspecified policies match the topic's publishers, with depth for bursts."""
    profile = qos_from_arguments(args)
    if args.qos_depth is None:
        profile.depth = max(profile.depth, _BURST)
    offered = [info.qos_profile for info in node.get_publishers_info_by_topic(topic)]
    if args.qos_profile is None and offered:
        reliability, durability = compatible(offered)
        if args.qos_reliability is None:
            profile.reliability = reliability
        if args.qos_durability is None:
            profile.durability = durability
    return profile


def compatible(offered: Sequence[QoSProfile]) -> tuple[QoSReliabilityPolicy, QoSDurabilityPolicy]:
    """Return the strictest request that all ``offered`` profiles (at least one) satisfy."""
    reliable = all(profile.reliability == QoSReliabilityPolicy.RELIABLE for profile in offered)
    lasting = all(profile.durability == QoSDurabilityPolicy.TRANSIENT_LOCAL for profile in offered)
    return (
        QoSReliabilityPolicy.RELIABLE if reliable else QoSReliabilityPolicy.BEST_EFFORT,
        QoSDurabilityPolicy.TRANSIENT_LOCAL if lasting else QoSDurabilityPolicy.VOLATILE,
    )

"""Qualities of service on the command line of ``ros2 topic echo`` and ``pub``.

The profiles are those of rmw's ``qos_profiles.h``.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from typing import NamedTuple

from gazelle.graph import Entity

__all__ = ["Profile", "add_qos_arguments", "chosen_profile", "warn_of_incompatible"]


class Profile(NamedTuple):
    """A quality of service; ``unknown`` stands for what the system or the other end decides."""

    reliability: str = "reliable"
    durability: str = "volatile"
    depth: int = 10
    history: str = "keep_last"

    @property
    def queue_size(self) -> int:
        """Most messages that wait, 0 for no limit."""
        return 0 if self.history == "keep_all" else self.depth


_SENSOR_DATA = Profile("best_effort", depth=5)
_PROFILES = {
    "unknown": Profile("unknown", "unknown", 0, "unknown"),
    "default": Profile(),
    "system_default": Profile("system_default", "system_default", 0, "system_default"),
    "sensor_data": _SENSOR_DATA,
    "services_default": Profile(),
    "parameters": Profile(depth=1000),
    "parameter_events": Profile(depth=1000),
    "action_status_default": Profile(durability="transient_local", depth=1),
    "best_available": Profile("best_available", "best_available"),
}
_HISTORIES = ("system_default", "keep_last", "keep_all", "unknown")
_RELIABILITIES = ("system_default", "reliable", "best_effort", "unknown", "best_available")
_DURABILITIES = ("system_default", "transient_local", "volatile", "unknown", "best_available")
_LIVELINESSES = ("system_default", "automatic", "manual_by_topic", "unknown", "best_available")


def add_qos_arguments(parser: argparse.ArgumentParser, verb: str, default: str) -> None:
    """Add the options; `verb` is ``subscribe`` or ``publish``, `default` a profile's name."""
    add = parser.add_argument
    add(
        "--qos-profile",
        choices=tuple(_PROFILES),
        default=default,
        help=f"Quality of service preset profile to {verb} with (default: {default})",
    )
    add("--qos-depth", metavar="N", type=int, help=f"Queue size setting to {verb} with")
    rows = (("history", _HISTORIES), ("reliability", _RELIABILITIES), ("durability", _DURABILITIES))
    for name, choices in rows:
        text = f"{name.capitalize()} setting to {verb} with (overrides that of --qos-profile)"
        add(f"--qos-{name}", choices=choices, help=text)
    add(
        "--qos-liveliness",
        choices=_LIVELINESSES,
        help="Liveliness setting; this graph tells the end of nodes at once and has no leases",
    )
    add(
        "--qos-liveliness-lease-duration-seconds",
        type=float,
        help="Liveliness lease duration setting; see --qos-liveliness",
    )


def chosen_profile(
    options: argparse.Namespace, publishers: Iterable[Entity] | None = None
) -> Profile:
    """Return the profile that the options say.

    Args:
        options: the parsed options.
        publishers: of a topic that is subscribed; without any option of the user's, the profile
            suits them all.
    """
    _tell_unused(options)
    profile = _PROFILES[options.qos_profile]
    own = {
        name: getattr(options, f"qos_{name}")
        for name in ("reliability", "durability", "history", "depth")
        if getattr(options, f"qos_{name}") is not None
    }
    if own or publishers is None:
        profile = profile._replace(**own)
        is_empty = profile.durability == "transient_local" and profile.depth == 0
        return profile._replace(depth=1) if is_empty else profile
    ends = list(publishers)
    return _suiting(profile, ends) if ends else profile


def warn_of_incompatible(topic: str, profile: Profile, publishers: Iterable[Entity]) -> None:
    """Say where ROS 2 would deliver nothing; here messages come all the same."""
    for one in publishers:
        policy = ""
        if profile.durability == "transient_local" and not one.qos.latched:
            policy = "DURABILITY"
        if profile.reliability == "reliable" and not one.qos.reliable:
            policy = "RELIABILITY"
        if policy:
            print(
                f"New publisher discovered on topic '{topic}', offering incompatible QoS. No "
                "messages will be received from it in ROS 2 (here they are). Last incompatible "
                f"policy: {policy}",
                file=sys.stderr,
                flush=True,
            )


def _suiting(profile: Profile, publishers: list[Entity]) -> Profile:
    reliable = _agreed(
        [one.qos.reliable for one in publishers], "QoSReliabilityPolicy", "RELIABLE", "BEST_EFFORT"
    )
    latched = _agreed(
        [one.qos.latched for one in publishers],
        "QoSDurabilityPolicy",
        "TRANSIENT_LOCAL",
        "VOLATILE",
    )
    return profile._replace(reliability=reliable, durability=latched)


def _agreed(offers: list[bool], policy: str, strong: str, weak: str) -> str:
    if all(offers):
        return strong.lower()
    if any(offers):
        print(
            f"Some, but not all, publishers are offering {policy}.{strong}. Falling back to "
            f"{policy}.{weak} as it will connect to all publishers"
        )
    return weak.lower()


def _tell_unused(options: argparse.Namespace) -> None:
    if options.qos_liveliness or options.qos_liveliness_lease_duration_seconds:
        print(
            "liveliness settings change nothing here: the end of a node is told at once",
            file=sys.stderr,
        )

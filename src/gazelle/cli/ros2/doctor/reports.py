"""The reports of ``ros2 doctor --report``."""

from __future__ import annotations

import os
import platform
from typing import NamedTuple

from gazelle._version import __version__
from gazelle.cli.ros2.doctor.checks import counted_topics
from gazelle.cli.ros2.doctor.sight import Sight

__all__ = ["Report", "reports"]


class Report(NamedTuple):
    """A section: which check it belongs to, its title, names and values."""

    category: str
    name: str
    items: tuple[tuple[str, object], ...]


def reports(sight: Sight) -> list[Report]:
    """Return all sections in the order they are printed."""
    found = [_network(sight)]
    if sight.workspace is not None:
        packages = sorted(sight.workspace.packages.items())
        items = tuple((name, one.version or "no version") for name, one in packages)
        found.append(Report("package", "PACKAGE VERSIONS", items))
    return [*found, _platform(), _middleware(), _ros2(), _topics(sight)]


def _network(sight: Sight) -> Report:
    items = (
        ("inet", "127.0.0.1"),
        ("graph's port", sight.port or "none: no graph is running"),
        ("ROS_DOMAIN_ID", os.environ.get("ROS_DOMAIN_ID", "0")),
    )
    return Report("network", "NETWORK CONFIGURATION", items)


def _platform() -> Report:
    items = (
        ("system", platform.system()),
        ("platform info", platform.platform()),
        ("release", platform.release()),
        ("processor", platform.processor() or platform.machine()),
    )
    return Report("platform", "PLATFORM INFORMATION", items)


def _middleware() -> Report:
    return Report("middleware", "RMW MIDDLEWARE", (("middleware name", "Gazelle's own, on Zenoh"),))


def _ros2() -> Report:
    items = (
        ("distribution name", os.environ.get("ROS_DISTRO", "not set")),
        ("gazelle version", __version__),
    )
    return Report("platform", "ROS 2 INFORMATION", items)


def _topics(sight: Sight) -> Report:
    rows = counted_topics(sight) or [("none", 0, 0)]
    items = tuple(
        item
        for name, publishers, subscriptions in rows
        for item in (
            ("topic", name),
            ("publisher count", publishers),
            ("subscriber count", subscriptions),
        )
    )
    return Report("topic", "TOPIC LIST", items)

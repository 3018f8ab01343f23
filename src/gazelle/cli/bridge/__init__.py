"""``gazelle bridge``: other programs' ways into the graph."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import NamedTuple

from gazelle.diagnostics import did_you_mean

__all__ = ["main"]


class _Bridge(NamedTuple):
    module: str
    help: str


# Each module has ``main(argv) -> int``.
_BRIDGES = {
    "foxglove": _Bridge("gazelle.cli.bridge.foxglove", "Foxglove and viewers of its protocol"),
    "ros1": _Bridge("gazelle.cli.bridge.ros1", "nodes and tools of an installed ROS 1"),
    "ros2": _Bridge("gazelle.cli.bridge.ros2", "nodes and tools of an installed ROS 2"),
}


def main(argv: list[str]) -> int:
    """Run ``gazelle bridge NAME …``."""
    name = argv[0] if argv else ""
    if name in {"", "-h", "--help"}:
        print(_usage())
        return 0 if name else 2
    bridge = _BRIDGES.get(name)
    if bridge is None:
        hint = did_you_mean(name, _BRIDGES) or f"there is {', '.join(_BRIDGES)}"
        print(f"gazelle bridge: '{name}' is not a bridge; {hint}", file=sys.stderr)
        return 2
    return int(import_module(bridge.module).main(argv[1:]))


def _usage() -> str:
    lines = [f"  {name:<10} {one.help}" for name, one in _BRIDGES.items()]
    return "\n".join(["usage: gazelle bridge NAME …", "", "bridges:", *lines])

"""``ros2``: commands of ROS 2."""

from __future__ import annotations

import sys
from importlib import import_module
from typing import NamedTuple

from gazelle.diagnostics import did_you_mean

__all__ = ["main"]


class _Command(NamedTuple):
    module: str
    help: str


# Each module has ``main(argv) -> int``.
_COMMANDS = {
    "action": _Command("gazelle.cli.ros2.action", "Various action related sub-commands"),
    "control": _Command("gazelle.cli.ros2.control", "Various control related sub-commands"),
    "param": _Command("gazelle.cli.ros2.param", "Various param related sub-commands"),
}


def main(argv: list[str]) -> int:
    """Run ``ros2 COMMAND …``."""
    name = argv[0] if argv else ""
    if name in {"", "-h", "--help"}:
        print(_usage())
        return 0
    command = _COMMANDS.get(name)
    if command is None:
        hint = did_you_mean(name, _COMMANDS)
        text = f"ros2: error: argument Call `ros2 <command> -h`: invalid choice: '{name}'"
        known = f"choose from {', '.join(map(repr, _COMMANDS))}"
        print(f"{text} ({hint or known})", file=sys.stderr)
        return 2
    return int(import_module(command.module).main(argv[1:]))


def _usage() -> str:
    lines = [f"  {name:<10} {command.help}" for name, command in _COMMANDS.items()]
    return "\n".join(
        [
            "usage: ros2 [-h] Call `ros2 <command> -h` for more detailed usage. ...",
            "",
            "Commands:",
            *lines,
        ]
    )

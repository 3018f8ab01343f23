"""``ros2``: commands of ROS 2."""

from __future__ import annotations

import argparse
import contextlib
import io
import sys
from importlib import import_module
from typing import NamedTuple

from gazelle.diagnostics import did_you_mean

__all__ = ["main"]

_MORE = "Call `ros2 <command> -h` for more detailed usage."
_BUFFERING = "--use-python-default-buffering"


class _Command(NamedTuple):
    module: str
    help: str


# Each module has ``main(argv) -> int``.
_COMMANDS = {
    "action": _Command("gazelle.cli.ros2.action", "Various action related sub-commands"),
    "bag": _Command("gazelle.cli.ros2.bag", "Various rosbag related sub-commands"),
    "component": _Command("gazelle.cli.ros2.component", "Various component related sub-commands"),
    "control": _Command("gazelle.cli.ros2.control", "Various control related sub-commands"),
    "daemon": _Command("gazelle.cli.ros2.daemon", "Various daemon related sub-commands"),
    "doctor": _Command("gazelle.cli.ros2.doctor", "Check ROS setup and other potential issues"),
    "interface": _Command("gazelle.cli.ros2.interface", "Show information about ROS interfaces"),
    "launch": _Command("gazelle.cli.ros2.launch", "Run a launch file"),
    "lifecycle": _Command("gazelle.cli.ros2.lifecycle", "Various lifecycle related sub-commands"),
    "multicast": _Command("gazelle.cli.ros2.multicast", "Various multicast related sub-commands"),
    "node": _Command("gazelle.cli.ros2.node", "Various node related sub-commands"),
    "param": _Command("gazelle.cli.ros2.param", "Various param related sub-commands"),
    "pkg": _Command("gazelle.cli.ros2.pkg", "Various package related sub-commands"),
    "run": _Command("gazelle.cli.ros2.run", "Run a package specific executable"),
    "service": _Command("gazelle.cli.ros2.service", "Various service related sub-commands"),
    "topic": _Command("gazelle.cli.ros2.topic", "Various topic related sub-commands"),
    "wtf": _Command("gazelle.cli.ros2.doctor", "Use `wtf` as alias to `doctor`"),
}
# Commands of ROS 2 that are not here, and what does their work.
_ELSEWHERE = {
    "security": "the graph is for you on this machine only; there is nothing to encrypt",
}


def main(argv: list[str]) -> int:
    """Run ``ros2 COMMAND …``."""
    tokens = list(argv)
    buffered = bool(tokens) and tokens[0] == _BUFFERING
    if buffered:
        del tokens[0]
    name = tokens[0] if tokens else ""
    if name in {"", "-h", "--help"}:
        print(_parser().format_help(), end="")
        return 0
    command = _COMMANDS.get(name)
    if command is None:
        return _refuse(name)
    if not buffered:
        _buffer_lines()
    return int(import_module(command.module).main(tokens[1:]))


def _refuse(name: str) -> int:
    if name in _ELSEWHERE:
        print(f"ros2 {name}: {_ELSEWHERE[name]}", file=sys.stderr)
        return 2
    hint = did_you_mean(name, _COMMANDS)
    known = f"choose from {', '.join(map(repr, _COMMANDS))}"
    print(_parser().format_usage(), end="", file=sys.stderr)
    print(
        f"ros2: error: argument {_MORE}: invalid choice: '{name}' ({hint or known})",
        file=sys.stderr,
    )
    return 2


def _buffer_lines() -> None:
    """Hand each line on at once, also into a pipe, as ros2cli does."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        with contextlib.suppress(ValueError, OSError):
            sys.stdout.reconfigure(line_buffering=True)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ros2",
        description="ros2 is an extensible command-line tool for ROS 2.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        _BUFFERING,
        action="store_true",
        help="Do not force line buffering in stdout and instead use the python default buffering",
    )
    width = max(map(len, _COMMANDS))
    lines = [f"{name:<{width}}  {one.help}" for name, one in sorted(_COMMANDS.items())]
    parser.add_subparsers(title="Commands", description="\n".join(lines), metavar=_MORE)
    return parser

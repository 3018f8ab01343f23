"""``ros2 run PACKAGE EXECUTABLE …``."""

from __future__ import annotations

import argparse
import os
import shlex
import signal
import subprocess
import sys
from collections.abc import Sequence
from contextlib import nullcontext
from types import FrameType

from gazelle.cli.ros2.verbs import fail, guarded
from gazelle.cpp.lookup import CPP_VARIABLE
from gazelle.diagnostics import Diagnostics, render
from gazelle.launch.cpp_nodes import find_and_compile
from gazelle.launch.environment import is_own_command, node_environment
from gazelle.node_specs.registry import builtin_executables
from gazelle.process_lifetime import interrupts_held
from gazelle.workspace import Workspace

__all__ = ["main"]

_PASSED_ON = (signal.SIGTERM, signal.SIGHUP)


def main(argv: list[str]) -> int:
    """Run an executable of a package in the foreground."""
    return guarded(lambda: _run(_parser().parse_args(argv)))


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ros2 run", description="Run a package specific executable"
    )
    parser.add_argument(
        "--prefix",
        help="Prefix command, which should go before the executable. Command must be wrapped in "
        "quotes if it contains spaces (e.g. --prefix 'gdb -ex run --args').",
    )
    parser.add_argument(
        "--cpp",
        action="store_true",
        help="Take the C++ of the package where Gazelle has a node of that name",
    )
    parser.add_argument("package_name", help="Name of the ROS package")
    parser.add_argument("executable_name", help="Name of the executable")
    parser.add_argument(
        "argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable"
    )
    return parser


def _run(options: argparse.Namespace) -> int:
    workspace, diagnostics = Workspace.discover(), Diagnostics()
    package, name = options.package_name, options.executable_name
    if options.cpp:
        os.environ[CPP_VARIABLE] = "1"
    found = find_and_compile(
        package, name, workspace=workspace, diagnostics=diagnostics, ros_version=2
    )
    render(diagnostics)
    if found is None:
        if package not in workspace.packages and not builtin_executables(package):
            return fail(f"Package '{package}' not found")
        is_there = any(item.code.startswith("cpp.") for item in diagnostics.errors)
        return fail(f"'{name}' does not compile" if is_there else "No executable found")
    prefix = shlex.split(options.prefix) if options.prefix else []
    # Programs that are there for both generations, such as turtlesim's, ask for it.
    environment = node_environment({**os.environ, "ROS_VERSION": "2"}, workspace)
    return _run_words([*prefix, *found.command, *options.argv], environment)


def _run_words(argv: Sequence[str], environment: dict[str, str]) -> int:
    sys.stdout.flush()
    signals = _SignalsPassedOn()
    try:
        with interrupts_held() if is_own_command(argv, None) else nullcontext():
            process = subprocess.Popen(argv, env=environment)
    except OSError as error:
        return fail(f"cannot run '{argv[0]}': {error.strerror}")
    signals.pass_to(process)
    while process.returncode is None:
        try:
            process.wait()
        except KeyboardInterrupt:
            # The terminal sends it to the node too, which ends in its own time.
            continue
    code = process.returncode
    if code < 0:
        print(f"[ros2run]: {signal.strsignal(-code)}")
    elif code:
        print(f"[ros2run]: Process exited with failure {code}")
    return code


class _SignalsPassedOn:
    """Lets the node end when this process is told to; ros2run leaves it behind.

    It listens before the node is there, which would be left behind else by who ends us meanwhile.
    """

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._early: list[int] = []
        for one in _PASSED_ON:
            signal.signal(one, self._on_signal)

    def pass_to(self, process: subprocess.Popen[bytes]) -> None:
        """Send the node what came so far and what comes."""
        self._process = process
        for number in self._early:
            process.send_signal(number)

    def _on_signal(self, number: int, _frame: FrameType | None) -> None:
        if self._process is None:
            self._early.append(number)
        else:
            self._process.send_signal(number)

"""Which Python has ROS 2, and what it is started with."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

__all__ = ["Interpreter", "candidates", "child_environment", "is_open", "sourced_hint"]

_DROP_INS = Path(__file__).parents[2] / "compat" / "modules"
_ROS_HOME = Path("/opt/ros")
_BEYOND = ("subnet", "system_default")


class Interpreter(NamedTuple):
    """A Python that may have ``rclpy``.

    Attributes:
        path: of the program.
        source: how it was found.
    """

    path: str
    source: str


def candidates(given: str | None, environ: Mapping[str, str]) -> tuple[Interpreter, ...]:
    """Return the Pythons to try, the most likely first.

    Args:
        given: what the user named; then there is no other.
        environ: its ``PATH``, ``AMENT_PREFIX_PATH`` and ``PYTHONPATH`` count.
    """
    if given is not None:
        return (Interpreter(given, "--python"),)
    found: dict[str, Interpreter] = {}
    for one in _all(environ):
        # The path as it is written: a virtual environment's Python is a link to another one.
        found.setdefault(one.path, one)
    return tuple(found.values())


def child_environment(environ: Mapping[str, str]) -> dict[str, str]:
    """Return the environment for ROS's Python: without Gazelle's stand-ins for ROS's modules."""
    found = dict(environ)
    parts = [one for one in environ.get("PYTHONPATH", "").split(os.pathsep) if one]
    kept = [one for one in parts if Path(one) != _DROP_INS]
    found.pop("PYTHONPATH", None)
    if kept:
        found["PYTHONPATH"] = os.pathsep.join(kept)
    # ROS's Python is not that of the virtual environment Gazelle may run in.
    for name in ("PYTHONHOME", "__PYVENV_LAUNCHER__"):
        found.pop(name, None)
    return found


def is_open(environ: Mapping[str, str]) -> bool:
    """Return whether the user lets other machines find the bridge."""
    reach = environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "").strip().lower()
    if reach:
        # Whatever rcl does not know counts as LOCALHOST there.
        return reach in _BEYOND
    only = environ.get("ROS_LOCALHOST_ONLY")
    return only is not None and only.strip() != "1"


def sourced_hint(environ: Mapping[str, str], ros_home: Path = _ROS_HOME) -> str:
    """Return what to do so that a Python with ``rclpy`` is found."""
    if not environ.get("AMENT_PREFIX_PATH"):
        setups = sorted(ros_home.glob("*/setup.bash")) if ros_home.is_dir() else []
        if setups:
            return f"source {setups[-1]} in this shell, then start the bridge again"
    return (
        "source ROS 2's setup.bash first, or name its Python: gazelle bridge ros2 --python PATH; "
        "ROS 2 is installed with apt (ros-<distro>-ros-base), RoboStack, or pip in an environment "
        "of its own (ros-rclpy ros-rmw-fastrtps-cpp ros-std-msgs …)"
    )


def _all(environ: Mapping[str, str]) -> Iterator[Interpreter]:
    path = environ.get("PATH", os.defpath)
    for folder in path.split(os.pathsep):
        command = Path(folder) / "ros2"
        python = _of_shebang(command, path)
        if python:
            yield Interpreter(python, f"the first line of {command}")
    if environ.get("AMENT_PREFIX_PATH") or environ.get("PYTHONPATH"):
        for name in ("python3", "/usr/bin/python3"):
            python = shutil.which(name, path=path) or ""
            if python:
                yield Interpreter(python, "the shell's python3")
    yield Interpreter(sys.executable, "the Python that runs Gazelle")


def _of_shebang(command: Path, path: str) -> str:
    """Return the Python in a script's first line, empty when there is none."""
    try:
        with command.open("rb") as file:
            line = file.readline(512).decode("utf-8", "replace").strip()
    except OSError:
        return ""
    tokens = line.removeprefix("#!").split()
    if not line.startswith("#!") or not any("python" in word for word in tokens):
        return ""
    program = tokens[0]
    if Path(program).name == "env":
        program = next((word for word in tokens[1:] if "python" in word), "")
    return shutil.which(program, path=path) or ""

"""Arguments of ``spawn_model`` and ``spawn_entity.py``."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from typing import NoReturn

from gazelle.errors import GazelleError

__all__ = ["SpawnUsageError", "is_ros2", "read_spawn_arguments"]

_TIMEOUT_S = 30.0


class SpawnUsageError(GazelleError):
    """The arguments are wrong; the message is the usage and what is wrong."""


class _Parser(ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise SpawnUsageError(f"{self.format_usage()}{self.prog}: error: {message}")


def is_ros2(argv: Sequence[str]) -> bool:
    """Tell whether these are the arguments of ``spawn_entity.py``."""
    return "-entity" in argv


def read_spawn_arguments(
    argv: Sequence[str], *, default_namespace: str = "/", ros2: bool | None = None
) -> Namespace:
    """Read the arguments of either program.

    Args:
        argv: the arguments.
        default_namespace: of ROS 1's robots.
        ros2: whether it is ROS 2's program; found out of the arguments when None.

    Raises:
        SpawnUsageError: they are wrong or incomplete.
    """
    ros2 = is_ros2(argv) if ros2 is None else ros2
    parser = _Parser(prog="spawn_entity.py" if ros2 else "spawn_model", add_help=False)
    if ros2:
        parser.add_argument("-entity", dest="model", required=True, metavar="ENTITY_NAME")
        # The older name of -timeout.
        parser.add_argument(
            "-spawn_service_timeout", dest="timeout", type=float, default=_TIMEOUT_S
        )
    else:
        parser.add_argument("-model", dest="model", required=True, metavar="MODEL_NAME")
        kind = parser.add_mutually_exclusive_group(required=True)
        kind.add_argument("-urdf", action="store_true")
        kind.add_argument("-sdf", action="store_true")
        # Gazebo 1's word for SDF.
        kind.add_argument("-gazebo", dest="sdf", action="store_true")
    _add_source(parser)
    _add_pose(parser)
    parser.add_argument("-reference_frame", default="")
    parser.add_argument("-gazebo_namespace", default="" if ros2 else "/gazebo")
    parser.add_argument("-robot_namespace", default="" if ros2 else default_namespace)
    parser.add_argument("-timeout", type=float, default=_TIMEOUT_S)
    parser.add_argument("-unpause", action="store_true")
    parser.add_argument("-wait", default="", metavar="MODEL_NAME")
    parser.add_argument(
        "-J", dest="joints", action="append", nargs=2, default=[], metavar=("JOINT", "POSITION")
    )
    parser.add_argument("-package_to_model", action="store_true")
    parser.add_argument("-b", dest="bond", action="store_true")
    found = parser.parse_args(list(argv))
    for name, position in found.joints:
        _check_number(parser, f"-J {name}", position)
    return found


def _add_source(parser: ArgumentParser) -> None:
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("-file", default="", metavar="FILE_NAME")
    source.add_argument("-param", default="", metavar="PARAM_NAME")
    source.add_argument("-topic", default="", metavar="TOPIC_NAME")
    source.add_argument("-database", default="", metavar="MODEL_NAME")
    source.add_argument("-stdin", action="store_true")


def _add_pose(parser: ArgumentParser) -> None:
    for name in ("-x", "-y", "-z", "-R", "-P", "-Y"):
        parser.add_argument(name, type=float, default=0.0)


def _check_number(parser: ArgumentParser, name: str, text: str) -> None:
    try:
        float(text)
    except ValueError:
        parser.error(f"{name} needs a number, not '{text}'")

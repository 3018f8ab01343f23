"""``static_transform_publisher`` of the packages tf (again and again) and tf2_ros (latched)."""

from __future__ import annotations

import secrets
import threading
from argparse import ArgumentParser
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple, NoReturn

from gazelle.errors import LaunchError
from gazelle.geometry import Pose
from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_transform
from gazelle.interfaces.stamps import set_header
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node, ticks
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader
from gazelle.parameters.trees import nested

__all__ = ["PARAMETERS", "StaticTransform", "parse_arguments", "parse_options", "run_tf", "run_tf2"]

PARAMETERS = ParameterTable(
    "static_transform_publisher",
    "Publishes one fixed transform, latched. Parameters count where no words are given, as they do"
    " for the component `tf2_ros::StaticTransformBroadcasterNode`.",
    ("tf2_ros/static_transform_publisher",),
    (
        Parameter("frame_id", "text", "/frame", "the frame above", ros_versions=(2,)),
        Parameter("child_frame_id", "text", "/child", "the frame below", ros_versions=(2,)),
        *(
            Parameter(f"translation.{axis}", "number", 0.0, "where it is", "m", ros_versions=(2,))
            for axis in "xyz"
        ),
        *(
            Parameter(
                f"rotation.{part}", "number", float(part == "w"), "how it is turned, a quaternion",
                ros_versions=(2,),
            )
            for part in "xyzw"
        ),
    ),
)  # fmt: skip

_USAGE = (
    "usage: static_transform_publisher x y z yaw pitch roll frame_id child_frame_id {period}\n"
    "   or: static_transform_publisher x y z qx qy qz qw frame_id child_frame_id {period}"
)


_NAME = "static_transform_publisher"
_NUMBERS = ("x", "y", "z", "roll", "pitch", "yaw", "qx", "qy", "qz", "qw")
_OPTIONS = frozenset({*(f"--{name}" for name in _NUMBERS), "--frame-id", "--child-frame-id"})


class _Parser(ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise LaunchError(f"{self.format_usage()}{self.prog}: error: {message}")


class StaticTransform(NamedTuple):
    """What the command line says."""

    T_parent_child: Pose
    frame_id: str
    child_frame_id: str
    period_ms: float


def parse_arguments(argv: Sequence[str], *, with_period: bool) -> StaticTransform:
    """Return the transform of a command line; yaw comes before pitch and roll.

    Raises:
        LaunchError: the number of words or a number is wrong.
    """
    usage = _USAGE.format(period="period(milliseconds)" if with_period else "")
    counts = {8: 6, 9: 7} if not with_period else {9: 6, 10: 7}
    if len(argv) not in counts:
        raise LaunchError(f"static_transform_publisher got {len(argv)} arguments\n{usage}")
    count = counts[len(argv)]
    if not with_period and count == 7 and _is_number(argv[8]) and not _is_number(argv[6]):
        raise LaunchError(
            f"static_transform_publisher of tf2_ros takes no period: leave out '{argv[8]}'. The "
            f"original takes the words before for a quaternion and sends '{argv[7]}' -> "
            f"'{argv[8]}'\n{usage}"
        )
    try:
        numbers = [float(word) for word in argv[:count]]
        period_ms = float(argv[-1]) if with_period else 0.0
    except ValueError as error:
        raise LaunchError(f"static_transform_publisher: {error}\n{usage}") from error
    x, y, z = numbers[:3]
    if count == 6:
        yaw, pitch, roll = numbers[3:]
        pose = Pose.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
    else:
        qx, qy, qz, qw = numbers[3:]
        pose = Pose((x, y, z), (qx, qy, qz, qw))
    return StaticTransform(pose, argv[count], argv[count + 1], period_ms)


def parse_options(argv: Sequence[str]) -> StaticTransform:
    """Return the transform of ROS 2's options, ``--x 1 --yaw 0.5 --frame-id a --child-frame-id b``.

    Raises:
        LaunchError: an option is unknown, a number or a frame is missing, or the turn is given
            twice.
    """
    parser = _Parser(prog=_NAME, add_help=False, allow_abbrev=False)
    for name in _NUMBERS:
        parser.add_argument(f"--{name}", type=float)
    parser.add_argument("--frame-id", required=True)
    parser.add_argument("--child-frame-id", required=True)
    given = parser.parse_args(list(argv))
    x, y, z, roll, pitch, yaw, *quat = (getattr(given, name) for name in _NUMBERS)
    if any(one is not None for one in quat):
        if any(one is not None for one in (roll, pitch, yaw)):
            parser.error("give a quaternion or roll, pitch and yaw, not both")
        # 0 0 0 1 is what an option that is left out stands for.
        qx, qy, qz = (one or 0.0 for one in quat[:3])
        pose = Pose(
            (x or 0.0, y or 0.0, z or 0.0), (qx, qy, qz, 1.0 if quat[3] is None else quat[3])
        )
    else:
        turn = (roll or 0.0, pitch or 0.0, yaw or 0.0)
        pose = Pose.from_xyz_rpy((x or 0.0, y or 0.0, z or 0.0), turn)
    return StaticTransform(pose, given.frame_id, given.child_frame_id, 0.0)


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def run_tf(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish on /tf at the period given, stamped that far ahead as tf's own does."""
    transform = parse_arguments(arguments.rest, with_period=True)
    node = start_node(arguments, graph)
    type_: Any = message_type("tf2_msgs/msg/TFMessage")
    publisher = node.create_publisher("/tf", type_, queue_size=100)
    period_ns = int(transform.period_ms * 1_000_000)
    for _ in ticks(node, period_ns, stop):
        stamp_ns = node.clock.now_ns() + period_ns
        publisher.publish(type_(transforms=[_message(transform, stamp_ns)]))
    node.shutdown()
    return 0


def run_tf2(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish once on /tf_static, latched.

    Raises:
        LaunchError: words or parameters say no transform.
    """
    transform: StaticTransform | None = None
    if any(word in _OPTIONS for word in arguments.rest):
        transform = parse_options(arguments.rest)
    elif arguments.rest or not _has_parameters(arguments):
        transform = parse_arguments(arguments.rest, with_period=False)
    if arguments.ros_version == 2 and arguments.name == _NAME:
        # Many of them run side by side, as a rule without names.
        arguments = replace(arguments, name=f"{_NAME}_{secrets.token_hex(8)}")
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        transform = transform or _of_parameters(own)
    if transform.frame_id == transform.child_frame_id:
        node.shutdown()
        frame = transform.frame_id
        raise LaunchError(f"cannot publish static transform from '{frame}' to '{frame}', exiting")
    type_: Any = message_type("tf2_msgs/msg/TFMessage")
    publisher = node.create_publisher("/tf_static", type_, latch=True)
    publisher.publish(type_(transforms=[_message(transform, node.clock.now_ns())]))
    stop.wait()
    node.shutdown()
    return 0


def _has_parameters(arguments: NodeArguments) -> bool:
    given = nested(arguments.params)
    return arguments.ros_version == 2 and any(
        row.key.partition(".")[0] in given for row in PARAMETERS.rows
    )


def _of_parameters(own: ParameterReader) -> StaticTransform:
    x, y, z = (own.number(f"translation.{axis}") for axis in "xyz")
    qx, qy, qz, qw = (own.number(f"rotation.{part}") for part in "xyzw")
    pose = Pose((x, y, z), (qx, qy, qz, qw))
    return StaticTransform(pose, own.text("frame_id"), own.text("child_frame_id"), 0.0)


def _message(transform: StaticTransform, stamp_ns: int) -> Any:
    message: Any = message_type("geometry_msgs/msg/TransformStamped")()
    set_header(message, stamp_ns, transform.frame_id.lstrip("/"))
    message.child_frame_id = transform.child_frame_id.lstrip("/")
    set_transform(message.transform, transform.T_parent_child)
    return message

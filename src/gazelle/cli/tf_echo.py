"""``tf_echo SOURCE TARGET [RATE]``: a transform between two frames, again and again."""

from __future__ import annotations

import math
import sys
import threading
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from gazelle.cli.error_text import error_text
from gazelle.cli.ros_tool import Tool, ToolError, join_graph, run_tool
from gazelle.graph import Graph, Node, TimeJumpError
from gazelle.graph.names import parse_command_line

if TYPE_CHECKING:
    from gazelle.graph.tf import StampedPose, TransformBuffer
    from gazelle.nodes.arguments import NodeArguments

    _Text = Callable[..., str]

__all__ = ["main", "ros2_transform_text", "run", "transform_text"]

_ROS2_FLAG = "--tf2"

_USAGE = """Usage: tf_echo source_frame target_frame [echo_rate]

This will echo the transform from the coordinate frame of the source_frame
to the coordinate frame of the target_frame.
Note: This is the transform to get data from target_frame into the source_frame.
Default echo rate is 1 if echo_rate is not given.
"""
_FIRST_S = 1.0
_BAD_ARGUMENTS = 255


def main(argv: list[str]) -> int:
    """Run ``tf_echo``, with ``--tf2`` ROS 2's ``tf2_echo``; ends with Ctrl-C."""
    line = parse_command_line([word for word in argv if word != _ROS2_FLAG])
    text = ros2_transform_text if _ROS2_FLAG in argv else transform_text
    tool = Tool("tf_echo", {"echo": lambda _words: _client(line.rest, line.params, text)}, _USAGE)
    return run_tool(tool, ["echo"])


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Run as the node ``tf/tf_echo``, which the built-in nodes' registry can name."""
    try:
        source, target, rate_hz, precision = _settings(list(arguments.rest), arguments.params)
    except ToolError as error:
        print(error_text(error), file=sys.stderr)
        return _BAD_ARGUMENTS
    node = graph.create_node("tf_echo", namespace=arguments.namespace, anonymous=True)
    show = partial(transform_text, precision=precision)
    _echo(node, source, target, rate_hz=rate_hz, show=show, stop=stop)
    return 0


def transform_text(found: StampedPose, precision: int = 3) -> str:
    """Return the lines of one transform: time, translation, rotation in three forms."""
    rpy = found.pose.rpy_rad
    degrees = [math.degrees(angle) for angle in rpy]
    return (
        f"At time {found.stamp_ns / 1e9:.{precision}f}\n"
        f"- Translation: {_vector(found.pose.position_m, precision)}\n"
        f"- Rotation: in Quaternion {_vector(found.pose.quat_xyzw, precision)}\n"
        f"            in RPY (radian) {_vector(rpy, precision)}\n"
        f"            in RPY (degree) {_vector(degrees, precision)}"
    )


def ros2_transform_text(found: StampedPose, precision: int = 3) -> str:
    """Return the lines as ROS 2's ``tf2_echo`` prints them, the matrix behind."""
    rpy = found.pose.rpy_rad
    degrees = [math.degrees(angle) for angle in rpy]
    sec, nanosec = divmod(found.stamp_ns, 1_000_000_000)
    rows = [
        "".join(f" {value:{precision + 3}.{precision}f}" for value in row)
        for row in found.pose.matrix().tolist()
    ]
    lines = [
        # The nanoseconds have no zeros in front there either.
        f"At time {sec}.{nanosec}",
        f"- Translation: {_vector(found.pose.position_m, precision)}",
        f"- Rotation: in Quaternion {_vector(found.pose.quat_xyzw, precision)}",
        f"- Rotation: in RPY (radian) {_vector(rpy, precision)}",
        f"- Rotation: in RPY (degree) {_vector(degrees, precision)}",
        "- Matrix:",
        *rows,
    ]
    return "\n".join(lines)


def _client(argv: list[str], params: Mapping[str, Any], text: _Text) -> int:
    try:
        source, target, rate_hz, precision = _settings(argv, params)
    except ToolError as error:
        print(error_text(error), file=sys.stderr)
        return _BAD_ARGUMENTS
    stop = threading.Event()
    with join_graph() as graph:
        node = graph.create_node("tf_echo", anonymous=True)
        graph.clock.follow(node)
        show = partial(text, precision=precision)
        _echo(node, source, target, rate_hz=rate_hz, show=show, stop=stop)
    return 0


def _settings(argv: list[str], params: Mapping[str, Any]) -> tuple[str, str, float, int]:
    """Return source, target, rate in Hz and digits.

    Raises:
        ToolError: with the text to print.
    """
    if not 2 <= len(argv) <= 3:
        raise ToolError(_USAGE)
    try:
        rate_hz = float(argv[2] if len(argv) == 3 else params.get("rate", 1.0))
        precision = int(params.get("precision", 3))
    except (TypeError, ValueError):
        raise ToolError("Echo rate and precision must be numbers") from None
    if rate_hz <= 0:
        raise ToolError("Echo rate must be > 0.0")
    if precision < 1:
        raise ToolError("Precision must be > 0")
    # Frames of tf had a leading slash once; it means nothing.
    return argv[0].removeprefix("/"), argv[1].removeprefix("/"), rate_hz, precision


def _echo(
    node: Node,
    source: str,
    target: str,
    *,
    rate_hz: float,
    show: Callable[[StampedPose], str],
    stop: threading.Event,
) -> None:
    from gazelle.graph.tf import TransformBuffer, TransformListener

    node.on_shutdown(lambda _reason: stop.set())
    buffer = TransformBuffer()
    TransformListener(buffer, node)
    buffer.can_transform(source, target, timeout_s=_FIRST_S)
    while not stop.is_set():
        print(_report(buffer, source, target, node.clock.now_ns(), show), flush=True)
        try:
            if not node.clock.sleep(round(1e9 / rate_hz)):
                return
        except TimeJumpError:
            continue


def _report(
    buffer: TransformBuffer,
    source: str,
    target: str,
    now_ns: int,
    show: Callable[[StampedPose], str],
) -> str:
    from gazelle.graph.tf import TransformError, frames_as_string

    try:
        return show(buffer.lookup_transform(source, target))
    except TransformError as error:
        secs, nsecs = divmod(now_ns, 1_000_000_000)
        return (
            f"Failure at {secs}.{nsecs:09d}\nException thrown:{error}\n"
            f"The current list of frames is:\n{frames_as_string(buffer)}"
        )


def _vector(values: Any, precision: int) -> str:
    return "[" + ", ".join(f"{value:.{precision}f}" for value in values) + "]"

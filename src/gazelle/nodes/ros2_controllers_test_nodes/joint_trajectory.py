"""``publisher_joint_trajectory_controller``: one trajectory after another, for ever.

Each has one point, reached after 4 s. Positions, velocities, accelerations and effort of a goal
have a number for each joint; at least one of them must be given.

Names, defaults and texts are those of ``ros2_controllers_test_nodes`` (humble to rolling). With a
single joint, values that are not given are not zeros here, as they are there by accident.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from typing import Any

from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import ticks
from gazelle.nodes.ros2_controllers_test_nodes.parameters import (
    GOAL,
    GoalParameters,
    are_numbers,
    start,
)
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "StartingPoint", "read_goals", "run"]

_TURN_RAD = 2 * 3.14159
PARAMETERS = ParameterTable(
    "publisher_joint_trajectory_controller",
    "Sends one goal after another to a joint_trajectory_controller, for ever. A value of another"
    " type than the default's ends it.",
    ("ros2_controllers_test_nodes/publisher_joint_trajectory_controller",),
    (
        Parameter(
            "controller_name", "text", "position_trajectory_controller",
            "its `joint_trajectory` is published on",
        ),
        Parameter(
            "wait_sec_between_publish", "integer", 6, "between two, and before the first", "s"
        ),
        Parameter("goal_names", "texts", ["pos1", "pos2"], "groups with a goal each, in order"),
        Parameter("joints", "texts", [""], "names of the joints, in the order of the numbers"),
        Parameter(
            "check_starting_point", "flag", False, "send only from where limits allow it"
        ),
        Parameter(
            "starting_point_limits.<joint>", "numbers", (-_TURN_RAD, _TURN_RAD),
            "lowest and highest position", "m or rad",
        ),
        Parameter(GOAL, "numbers", None, "a bare list of positions, as in Humble"),
        Parameter(f"{GOAL}.positions", "numbers", None, "of the joints", "m or rad"),
        Parameter(f"{GOAL}.velocities", "numbers", None, "of the joints", "m/s or rad/s"),
        Parameter(f"{GOAL}.accelerations", "numbers", None, "of the joints", "m/s² or rad/s²"),
        Parameter(f"{GOAL}.effort", "numbers", None, "of the joints", "N or Nm"),
    ),
)  # fmt: skip

_DURATION_S = 4
_FIELDS = ("positions", "velocities", "accelerations", "effort")
_STRUCTURE = (
    "Use the following structure: \n<goal_name>:\n"
    "  positions: [joint1, joint2, joint3, ...]\n"
    "  velocities: [v_joint1, v_joint2, ...]\n"
    "  accelerations: [a_joint1, a_joint2, ...]\n"
    "  effort: [eff_joint1, eff_joint2, ...]"
)


class StartingPoint:
    """Whether the first joint state that came is within limits.

    Args:
        limits: lowest and highest position by joint, None for not to be checked.

    Attributes:
        heard: a joint state came.
        fits: goals may be sent.
    """

    def __init__(self, limits: Mapping[str, Sequence[float]] | None) -> None:
        """Wait for the first one, if there is something to check."""
        self._limits = limits or {}
        self.heard = False
        self.fits = limits is None

    def take(self, state: Any) -> list[str]:
        """Look at the first joint state; return the joints that are beyond their limits."""
        if self.heard:
            return []
        self.heard = True
        beyond = [
            name
            for name, position in zip(state.name, state.position, strict=False)
            if name in self._limits
            and not self._limits[name][0] <= position <= self._limits[name][1]
        ]
        self.fits = not beyond
        return beyond


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Send until told to stop; 1 where no goal is of use."""
    node, parameters = start(arguments, graph, PARAMETERS)
    joints = _joints(parameters)
    starting_point = StartingPoint(_limits(parameters, joints))
    goals = read_goals(node, parameters, len(joints))
    if not goals:
        node.log("error", "No valid goal found. Exiting...")
        node.shutdown()
        return 1
    topic = f"/{parameters.value('controller_name')}/joint_trajectory"
    kind: Any = message_type("trajectory_msgs/msg/JointTrajectory")
    publisher = node.create_publisher(topic, kind, queue_size=1)
    seconds = parameters.value("wait_sec_between_publish")
    names = len(parameters.goal_names)
    node.log("info", f'Publishing {names} goals on topic "{topic}" every {seconds} s')
    if not starting_point.fits:
        node.create_subscription(
            "joint_states", "sensor_msgs/msg/JointState", _checker(node, starting_point)
        )
    arguments.ready()
    place = 0
    for _now_ns in ticks(node, parameters.period_ns, stop):
        if starting_point.fits:
            node.log("info", f"Sending goal {goals[place]}.")
            publisher.publish(kind(joint_names=list(joints), points=[goals[place]]))
            place = (place + 1) % len(goals)
        else:
            node.log("warn", _held(starting_point))
    node.shutdown()
    return 0


def read_goals(node: Node, parameters: GoalParameters, joints: int) -> list[Any]:
    """Return a ``JointTrajectoryPoint`` of each goal that is of use; the node tells of each.

    Args:
        node: logs.
        parameters: of the node.
        joints: how many there are.

    Raises:
        LaunchError: a goal is an empty list.
    """
    goals = []
    for name in parameters.goal_names:
        point = _point(_fields(node, parameters, name), joints)
        if point is None:
            text = f'Goal "{name}" definition is wrong. This goal will not be used. {_STRUCTURE}'
            node.log("warn", text)
            continue
        node.log("info", f'Goal "{name}" has definition {point}')
        goals.append(point)
    return goals


def _fields(node: Node, parameters: GoalParameters, name: str) -> Mapping[str, Any]:
    """Return positions and so on of a goal; Humble takes a bare list as positions."""
    given = parameters.value(name)
    if not isinstance(given, list):
        return given if isinstance(given, Mapping) else {}
    if not given:
        raise LaunchError(f'Values for goal "{name}" not set!')
    text = f'Goal "{name}" is defined as a list. This is deprecated. {_STRUCTURE}'
    node.log("warn", f"{text}\nFrom Iron on ROS does not take it.")
    return {"positions": given}


def _point(fields: Mapping[str, Any], joints: int) -> Any:
    """Return the point, None when no field has a number for each joint."""
    point: Any = message_type("trajectory_msgs/msg/JointTrajectoryPoint")()
    is_given = False
    for field in _FIELDS:
        numbers: Any = fields.get(field)
        if are_numbers(numbers) and len(numbers) == joints:
            setattr(point, field, [float(one) for one in numbers])
            is_given = True
    point.time_from_start.sec = _DURATION_S
    return point if is_given else None


def _joints(parameters: GoalParameters) -> tuple[str, ...]:
    joints = tuple(str(name) for name in parameters.value("joints"))
    if not any(joints):
        raise LaunchError(
            '"joints" parameter is not set! Give the node a list of joint names, in the order of '
            "the numbers of its goals"
        )
    return joints


def _limits(
    parameters: GoalParameters, joints: Sequence[str]
) -> Mapping[str, Sequence[float]] | None:
    if not parameters.value("check_starting_point"):
        return None
    limits: dict[str, Sequence[float]] = {}
    for name in joints:
        given = parameters.value(f"starting_point_limits.{name}")
        pair: Any = [-_TURN_RAD, _TURN_RAD] if given is None else given
        if not are_numbers(pair) or len(pair) != 2:
            raise LaunchError(
                f'"starting_point" parameter is not set correctly! starting_point_limits.{name} '
                f"is {given!r}, not two numbers, the lowest and the highest position"
            )
        limits[name] = pair
    return limits


def _checker(node: Node, starting_point: StartingPoint) -> Any:
    def take(state: Any) -> None:
        for name in starting_point.take(state):
            node.log("warn", f"Starting point limits exceeded for joint {name} !")

    return take


def _held(starting_point: StartingPoint) -> str:
    if starting_point.heard:
        return "Start configuration is not within configured limits!"
    return 'Start configuration could not be checked! Check "joint_state" topic!'

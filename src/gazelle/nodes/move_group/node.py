"""``move_group``: plans and executes motions for whoever asks, see `gazelle.nodes.move_group`."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

from gazelle.description.moveit import MoveItConfig, config_from_parameters
from gazelle.diagnostics import Diagnostics, render_text
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type
from gazelle.motion.model import RobotModel
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.move_group.action_servers import offer_execute_action, offer_move_action
from gazelle.nodes.move_group.context import MoveGroupContext, make_context
from gazelle.nodes.move_group.kinematics_services import offer_kinematics
from gazelle.nodes.move_group.parameters import report_parameters
from gazelle.nodes.move_group.planning_scene_services import offer_scene
from gazelle.nodes.move_group.planning_services import offer_planning
from gazelle.nodes.move_group.sequences import offer_sequences
from gazelle.nodes.parameters import log_findings, parameter_tree, start_node
from gazelle.parameters.trees import nested
from gazelle.workspace import Workspace

__all__ = ["gathered_parameters", "run"]

_DESCRIPTION = "robot_description"
_PARTS = ("", "_semantic", "_kinematics", "_planning")
_TOPIC_S = 10.0


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Plan and execute until told to stop."""
    node = start_node(arguments, graph)
    node.on_shutdown(lambda _reason: stop.set())
    try:
        parameters = gathered_parameters(node, arguments, stop)
        config = _config(node, parameters)
        if config is None:
            return 1
        context = _context(node, config, parameters, arguments)
        node.log("info", "You can start planning now!")
        arguments.ready()
        context.monitor.publish_until(stop)
        if context.executor is not None:
            context.executor.stop("the end of move_group")
        return 0
    finally:
        node.shutdown()


def gathered_parameters(
    node: Node, arguments: NodeArguments, stop: threading.Event
) -> dict[str, Any]:
    """Return all parameters of a move_group as one tree.

    ROS 2 gives them to the node itself, ROS 1 has ``robot_description…`` above it. A description
    that is no parameter may come by the topic of that name, as in ROS 2.

    Args:
        node: whose parameters are read.
        arguments: of the command line.
        stop: ends waiting for the topic.
    """
    tree = parameter_tree(node, arguments)
    for part in _PARTS:
        name = f"{_DESCRIPTION}{part}"
        if name not in tree:
            found = node.parameters.search(name)
            if found is not None:
                value = node.parameters.get(found)
                tree[name] = nested(value) if isinstance(value, Mapping) else value
    for name in (_DESCRIPTION, f"{_DESCRIPTION}_semantic"):
        if not tree.get(name):
            text = _of_topic(node, name, stop)
            if text:
                tree[name] = text
    return tree


def _config(node: Node, parameters: Mapping[str, Any]) -> MoveItConfig | None:
    diagnostics = Diagnostics()
    config = config_from_parameters(
        parameters, workspace=Workspace.discover(), diagnostics=diagnostics
    )
    log_findings(node, diagnostics, render_text)
    if config is None:
        node.log("fatal", "Unable to construct robot model. Please make sure all needed "
                 "information is on the parameter server.")  # fmt: skip
    return config


def _context(
    node: Node, config: MoveItConfig, parameters: Mapping[str, Any], arguments: NodeArguments
) -> MoveGroupContext:
    diagnostics = Diagnostics()
    robot = RobotModel.from_config(config, diagnostics=diagnostics)
    node.log("info", f"Loading robot model '{robot.name}'...")
    context = make_context(node, config, robot, parameters, ros_version=arguments.ros_version)
    context.maker.warm_up(context.monitor.scene)
    with node.announced_together():
        offer_scene(context)
        offer_kinematics(context)
        offer_planning(context)
        offer_move_action(context)
        offer_execute_action(context)
        offer_sequences(context)
    log_findings(node, diagnostics, render_text)
    told = Diagnostics()
    report_parameters(config, node.name, told, ros_version=arguments.ros_version)
    log_findings(node, told)
    return context


def _of_topic(node: Node, name: str, stop: threading.Event) -> str:
    """Return what a latched topic says, an empty text when nobody says anything in time."""
    got = threading.Event()
    texts: list[str] = []

    def take(message: Any) -> None:
        texts.append(str(message.data))
        got.set()

    subscription = node.create_subscription(name, message_type("std_msgs/msg/String"), take)
    node.log("info", f"parameter '{name}' is not set; waiting for it on topic {subscription.topic}")
    waited_s = 0.0
    while not got.wait(0.1) and not stop.is_set() and waited_s < _TOPIC_S:
        waited_s += 0.1
    subscription.unregister()
    node.drop(subscription)
    return texts[-1] if texts else ""

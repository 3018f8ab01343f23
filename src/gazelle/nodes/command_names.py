"""Names of built-in nodes that command: joysticks, choosing among velocities, goals in turn."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["COMMANDS", "CommandNode"]


class CommandNode(NamedTuple):
    """A row; see `gazelle.nodes.registry.BuiltinNode`. The target lies in ``gazelle.nodes``."""

    package: str
    type: str
    target: str
    light: bool
    help: str
    aliases: tuple[tuple[str, str], ...] = ()
    name: str = ""


COMMANDS = (
    CommandNode(
        "twist_mux",
        "twist_mux",
        "twist_mux.mux:run",
        True,
        "passes on one of several velocity commands, by priorities, time-outs and locks",
    ),
    CommandNode(
        "twist_mux",
        "twist_marker",
        "twist_mux.marker:run",
        True,
        "shows a velocity command as an arrow",
    ),
    CommandNode(
        "twist_mux",
        "joystick_relay.py",
        "twist_mux.relay:run",
        True,
        "makes velocities of a joystick's shares, in steps, while it has priority",
        (("twist_mux", "joystick_relay"),),
        "joystick_relay",
    ),
    CommandNode(
        "joy",
        "joy_node",
        "joy.node:run",
        True,
        "publishes what a joystick does",
        (("joy_linux", "joy_linux_node"),),
    ),
    CommandNode(
        "joy",
        "joy_enumerate_devices",
        "joy.node:list_devices",
        True,
        "lists joysticks",
    ),
    CommandNode(
        "teleop_twist_joy",
        "teleop_node",
        "teleop.joystick:run",
        True,
        "drives any robot by a joystick",
        name="teleop_twist_joy_node",
    ),
    CommandNode(
        "ros2_controllers_test_nodes",
        "publisher_forward_position_controller",
        "controller_goals.forward_position:run",
        True,
        "sends one list of commands after another to a forward controller",
        (("ros2_control_test_nodes", "publisher_forward_position_controller"),),
    ),
    CommandNode(
        "ros2_controllers_test_nodes",
        "publisher_joint_trajectory_controller",
        "controller_goals.joint_trajectory:run",
        True,
        "sends one goal after another to a joint_trajectory_controller",
        (("ros2_control_test_nodes", "publisher_joint_trajectory_controller"),),
        "publisher_position_trajectory_controller",
    ),
    CommandNode(
        "force_torque_sensor_broadcaster",
        "wrench_transformer_node",
        "filters.wrench_transformer:run",
        True,
        "turns wrenches into other frames",
        name="fts_wrench_transformer",
    ),
)

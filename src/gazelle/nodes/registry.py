"""Which built-in node answers to which ``(package, type)``."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

from gazelle.nodes.command_names import COMMANDS
from gazelle.nodes.localisation_names import LOCALISATION
from gazelle.nodes.ros_gz.names import ROS_GZ_NAMES
from gazelle.nodes.slam.names import SLAM_NAMES
from gazelle.nodes.view_names import VIEWS

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.nodes.arguments import NodeArguments

    NodeFunction = Callable[[NodeArguments, Graph, threading.Event], int]

__all__ = ["BuiltinNode", "builtin_node", "builtin_nodes", "builtin_types"]


# Python 3.11 fails now and then to parse two modules at once, which a host of several nodes would
# ask of it where modules are parsed anew, as pytest does.
_IMPORTING = threading.RLock()


@dataclass(frozen=True, slots=True)
class BuiltinNode:
    """A node that Gazelle brings.

    Attributes:
        package, type: its first name.
        target: ``module:function``; the function takes `NodeArguments`, the graph and an event
            that tells it to stop, and returns an exit code.
        light: it may share a process with other light ones.
        help: one line about it.
        aliases: other ``(package, type)`` names it answers to.
        name: what the node calls itself when nobody names it, its type when empty.
        writes_at_end: it writes files when it is told to end, and must not be hurried.
    """

    package: str
    type: str
    target: str
    light: bool
    help: str
    aliases: tuple[tuple[str, str], ...] = ()
    name: str = ""
    writes_at_end: bool = False

    def load(self) -> Callable[..., Any]:
        """Import and return the function."""
        module, _, function = self.target.partition(":")
        with _IMPORTING:
            return getattr(import_module(module), function)  # type: ignore[no-any-return]


_SERVER_NAMES = (
    ("gazebo_ros", "gazebo"),
    ("gazebo_ros", "debug"),
    ("gazebo_ros", "perf"),
    ("gazebo", "gazebo"),
    ("gazebo", "gzserver"),
)
_SPAWN_NAMES = (
    ("gazebo_ros", "spawn_model.py"),
    ("gazebo", "spawn_model"),
    ("gazebo", "spawn_model.py"),
    ("gazebo_tools", "gazebo_model"),
)

_NODES = (
    BuiltinNode(
        "gazebo_ros",
        "gzserver",
        "gazelle.nodes.gzserver:run",
        light=False,
        help="the simulator",
        aliases=_SERVER_NAMES,
    ),
    BuiltinNode(
        "gazebo_ros",
        "spawn_model",
        "gazelle.nodes.spawn_model:run",
        light=True,
        help="puts a model into the running world",
        aliases=_SPAWN_NAMES,
    ),
    BuiltinNode(
        "gazebo_ros",
        "spawn_entity.py",
        "gazelle.nodes.spawn_model:run_entity",
        light=True,
        help="puts a model into the running world, ROS 2's name",
    ),
    BuiltinNode(
        "joint_state_publisher",
        "joint_state_publisher",
        "gazelle.studio.views.companions:joint_state_publisher",
        light=True,
        help="publishes joint states of a robot description, with sliders if use_gui is true",
    ),
    BuiltinNode(
        "robot_state_publisher",
        "robot_state_publisher",
        "gazelle.nodes.robot_state_publisher:run",
        light=True,
        help="turns joint states into tf",
        aliases=(("robot_state_publisher", "state_publisher"),),
    ),
    BuiltinNode(
        "controller_manager",
        "controller_manager",
        "gazelle.nodes.controller_manager_command:run",
        light=True,
        help="lists, loads, starts, stops and unloads controllers",
        aliases=(("pr2_controller_manager", "pr2_controller_manager"),),
    ),
    BuiltinNode(
        "controller_manager",
        "ros2_control_node",
        "gazelle.nodes.ros2_control_node:run",
        light=False,
        help="runs controllers on mock hardware, without a simulation",
        name="controller_manager",
    ),
    BuiltinNode(
        "controller_manager",
        "spawner",
        "gazelle.nodes.controller_spawner:run",
        light=True,
        help="loads and starts controllers",
        aliases=(("pr2_controller_manager", "spawner"),),
    ),
    BuiltinNode(
        "controller_manager",
        "spawner.py",
        "gazelle.nodes.controller_spawner_ros2:run",
        light=True,
        help="loads and activates controllers, ROS 2's older name",
    ),
    BuiltinNode(
        "controller_manager",
        "unspawner",
        "gazelle.nodes.controller_spawner:run_unspawner",
        light=True,
        help="stops controllers",
        aliases=(("pr2_controller_manager", "unspawner"),),
    ),
    BuiltinNode(
        "controller_manager",
        "hardware_spawner",
        "gazelle.nodes.hardware_spawner:run",
        light=True,
        help="configures or activates hardware of ros2_control",
    ),
    BuiltinNode(
        "controller_manager",
        "unspawner.py",
        "gazelle.nodes.controller_spawner_ros2:run_unspawner",
        light=True,
        help="deactivates and unloads controllers, ROS 2's older name",
    ),
    *(
        BuiltinNode(
            "rosbag",
            name,
            f"gazelle.nodes.rosbag.{name}:run",
            light=False,
            help=about,
            writes_at_end=name == "record",
        )
        for name, about in (
            ("record", "records topics into a bag"),
            ("play", "plays a bag"),
        )
    ),
    BuiltinNode(
        "rclcpp_components",
        "component_container",
        "gazelle.nodes.component_container:run",
        light=False,
        help="runs built-in nodes under the names of components",
        aliases=tuple(
            ("rclcpp_components", f"component_container_{kind}")
            for kind in ("mt", "isolated", "event")
        ),
        name="ComponentManager",
    ),
    *(
        BuiltinNode(package, kind, f"gazelle.nodes.ros_gz.{target}", light, about, names, name)
        for package, kind, target, light, about, names, name in ROS_GZ_NAMES
    ),
    BuiltinNode(
        "move_base",
        "move_base",
        "gazelle.nodes.move_base.node:run",
        light=False,
        help="drives to goals around obstacles",
    ),
    BuiltinNode(
        "moveit_ros_move_group",
        "move_group",
        "gazelle.nodes.move_group:run",
        light=False,
        help="plans and executes motions of arms, as MoveIt does",
    ),
    *(
        BuiltinNode(
            package,
            name,
            f"gazelle.nodes.nav2.{target}:run",
            light=False,
            help=about,
            aliases=aliases,
        )
        for package, name, target, about, aliases in (
            ("nav2_planner", "planner_server", "planner_server", "plans paths (Nav2)", ()),
            (
                "nav2_controller",
                "controller_server",
                "controller_server",
                "follows paths (Nav2)",
                (),
            ),
            (
                "nav2_behaviors",
                "behavior_server",
                "behavior_server",
                "spins, backs up, waits (Nav2)",
                (("nav2_recoveries", "recoveries_server"),),
            ),
            (
                "nav2_bt_navigator",
                "bt_navigator",
                "bt_navigator",
                "drives to poses by behaviour trees (Nav2)",
                (),
            ),
            (
                "nav2_waypoint_follower",
                "waypoint_follower",
                "waypoint_follower",
                "drives to one pose after another (Nav2)",
                (),
            ),
            ("nav2_smoother", "smoother_server", "smoother_server", "smooths paths (Nav2)", ()),
            (
                "nav2_velocity_smoother",
                "velocity_smoother",
                "velocity_smoother",
                "limits accelerations of commands (Nav2)",
                (),
            ),
            (
                "nav2_collision_monitor",
                "collision_monitor",
                "collision_monitor",
                "slows or stops commands by what sensors see (Nav2)",
                (),
            ),
            (
                "nav2_lifecycle_manager",
                "lifecycle_manager",
                "lifecycle_manager",
                "brings managed nodes up and down (Nav2)",
                (),
            ),
        )
    ),
    *(
        BuiltinNode(
            row.package,
            row.type,
            f"gazelle.nodes.{row.target}",
            light=row.light,
            help=row.help,
            name=row.name,
        )
        for row in LOCALISATION
    ),
    BuiltinNode(
        "rosout", "rosout", "gazelle.nodes.rosout:run", light=True, help="collects log messages"
    ),
    BuiltinNode(
        "tf",
        "static_transform_publisher",
        "gazelle.nodes.static_transform_publisher:run_tf",
        light=True,
        help="publishes one fixed transform again and again",
    ),
    BuiltinNode(
        "tf2_ros",
        "static_transform_publisher",
        "gazelle.nodes.static_transform_publisher:run_tf2",
        light=True,
        help="publishes one fixed transform, latched",
    ),
    *(
        BuiltinNode(
            "topic_tools", name, f"gazelle.nodes.topic_tools:run_{name}", light=True, help=about
        )
        for name, about in (
            ("relay", "publishes every message of a topic again"),
            ("throttle", "publishes so many messages a second of a topic"),
            ("drop", "leaves out some messages of a topic"),
        )
    ),
    *(
        BuiltinNode(
            "topic_tools", name, f"gazelle.nodes.topic_transform:run_{name}", light=True, help=about
        )
        for name, about in (
            ("transform", "publishes what a Python expression makes of a topic or a field"),
            ("relay_field", "fills messages with fields of another topic"),
        )
    ),
    *(
        BuiltinNode(
            "topic_tools", name, f"gazelle.nodes.topic_mux:run_{name}", light=True, help=about
        )
        for name, about in (
            ("mux", "publishes one of several topics, which services select"),
            ("demux", "publishes a topic as one of several, which services select"),
        )
    ),
    *(
        BuiltinNode(
            package,
            names[0],
            f"gazelle.nodes.slam.node:{target}",
            light=False,
            help=about,
            aliases=tuple((package, name) for name in names[1:]),
            name=name,
        )
        for package, names, target, about, name in SLAM_NAMES
    ),
    *(
        BuiltinNode(
            "frontier_exploration",
            f"explore_{role}",
            f"gazelle.nodes.frontier_exploration.{role}:run",
            light=role == "client",
            help=about,
        )
        for role, about in (
            ("server", "explores what lies inside of a polygon, by move_base"),
            ("client", "makes a polygon of clicked points and lets explore_server explore it"),
        )
    ),
    BuiltinNode(
        "turtlesim",
        "turtle_teleop_key",
        "gazelle.nodes.turtlesim.teleop:run",
        light=False,
        help="drives a turtle from the keyboard",
        name="teleop_turtle",
    ),
    BuiltinNode(
        "turtlesim",
        "mimic",
        "gazelle.nodes.turtlesim.mimic:run",
        light=True,
        help="lets one turtle do what another one does",
        name="turtle_mimic",
    ),
    BuiltinNode(
        "turtlesim",
        "draw_square",
        "gazelle.nodes.turtlesim.draw_square:run",
        light=True,
        help="lets a turtle draw squares",
    ),
    BuiltinNode(
        "turtlebot3_fake",
        "turtlebot3_fake_node",
        "gazelle.nodes.turtlebot3.fake:run",
        light=True,
        help="a TurtleBot3 that drives without physics",
    ),
    BuiltinNode(
        "turtlebot3_fake_node",
        "turtlebot3_fake_node",
        "gazelle.nodes.turtlebot3.fake:run_ros2",
        light=True,
        help="a TurtleBot3 that drives without physics, ROS 2's package",
    ),
    BuiltinNode(
        "turtlebot3_gazebo",
        "turtlebot3_drive",
        "gazelle.nodes.turtlebot3.drive:run",
        light=True,
        help="wanders about without bumping into things",
    ),
    BuiltinNode(
        "turtlebot3_slam",
        "flat_world_imu_node",
        "gazelle.nodes.turtlebot3.flat_world_imu:run",
        light=True,
        help="makes an IMU's accelerations those of flat ground",
    ),
    BuiltinNode(
        "turtlebot3_teleop",
        "turtlebot3_teleop_key",
        "gazelle.nodes.turtlebot3.teleop:run",
        light=False,
        help="drives a TurtleBot3 from the keyboard",
        name="turtlebot3_teleop",
    ),
    BuiltinNode(
        "turtlebot3_teleop",
        "teleop_keyboard",
        "gazelle.nodes.turtlebot3.teleop:run_ros2",
        light=False,
        help="drives a TurtleBot3 from the keyboard, ROS 2's name",
    ),
    BuiltinNode(
        "teleop_twist_keyboard",
        "teleop_twist_keyboard.py",
        "gazelle.nodes.teleop.twist_keyboard:run",
        light=False,
        help="drives any robot from the keyboard",
        name="teleop_twist_keyboard",
    ),
    BuiltinNode(
        "teleop_twist_keyboard",
        "teleop_twist_keyboard",
        "gazelle.nodes.teleop.twist_keyboard:run_ros2",
        light=False,
        help="drives any robot from the keyboard, ROS 2's name",
    ),
    *(
        BuiltinNode(
            row.package,
            row.type,
            f"gazelle.nodes.{row.target}",
            light=row.light,
            help=row.help,
            aliases=row.aliases,
            name=row.name,
        )
        for row in COMMANDS
    ),
    *(
        BuiltinNode(
            view.package,
            view.type,
            view.target,
            light=False,
            help=view.help,
            aliases=view.aliases,
            name=view.name,
        )
        for view in VIEWS
    ),
)


def builtin_nodes() -> tuple[BuiltinNode, ...]:
    """Return all built-in nodes."""
    return _NODES


def builtin_node(package: str, type_name: str) -> BuiltinNode | None:
    """Return the node that answers to a name, or None."""
    wanted = (package, type_name)
    return next(
        (node for node in _NODES if wanted in ((node.package, node.type), *node.aliases)), None
    )


def builtin_types(package: str) -> tuple[str, ...]:
    """Return the types that exist under a package's name."""
    names = [name for node in _NODES for name in ((node.package, node.type), *node.aliases)]
    return tuple(sorted({type_name for owner, type_name in names if owner == package}))

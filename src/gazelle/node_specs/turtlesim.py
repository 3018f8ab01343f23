"""turtlesim."""

from __future__ import annotations

from gazelle.node_specs.spec import NodeSpec, calls, listens, offers, publishes

__all__ = ["TURTLES"]

TURTLES = (
    NodeSpec(
        package="turtlesim",
        executable="turtle_teleop_key",
        entry="gazelle.nodes.turtlesim.teleop:run",
        does="drives a turtle from the keyboard",
        is_light=False,
        parameters="gazelle.nodes.turtlesim.teleop:PARAMETERS",
        name="teleop_turtle",
        topics=(publishes("turtle1/cmd_vel", "geometry_msgs/msg/Twist"),),
        is_complete=True,
    ),
    NodeSpec(
        package="turtlesim",
        executable="mimic",
        entry="gazelle.nodes.turtlesim.mimic:run",
        does="lets one turtle do what another one does",
        is_light=True,
        name="turtle_mimic",
        topics=(
            publishes("output/cmd_vel", "geometry_msgs/msg/Twist"),
            listens("input/pose", "turtlesim/msg/Pose"),
        ),
        is_complete=True,
        namespaces=("input", "output"),
    ),
    NodeSpec(
        package="turtlesim",
        executable="draw_square",
        entry="gazelle.nodes.turtlesim.draw_square:run",
        does="lets a turtle draw squares",
        is_light=True,
        topics=(
            publishes("turtle1/cmd_vel", "geometry_msgs/msg/Twist"),
            listens("turtle1/pose", "turtlesim/msg/Pose"),
        ),
        services=(calls("reset", "std_srvs/srv/Empty", remark="at the start"),),
        is_complete=True,
    ),
    NodeSpec(
        package="turtlesim",
        executable="turtlesim_node",
        entry="gazelle.studio.windows.gui_nodes:turtlesim",
        does="turtles that draw",
        is_light=False,
        parameters="gazelle.nodes.turtlesim.parameters:PARAMETERS",
        name="turtlesim",
        topics=(
            publishes("turtle1/color_sensor", "turtlesim/msg/Color"),
            publishes("turtle1/pose", "turtlesim/msg/Pose"),
            listens("turtle1/cmd_vel", "geometry_msgs/msg/Twist"),
        ),
        services=(
            offers("clear", "std_srvs/srv/Empty"),
            offers("kill", "turtlesim/srv/Kill"),
            offers("reset", "std_srvs/srv/Empty"),
            offers("spawn", "turtlesim/srv/Spawn"),
            offers("turtle1/set_pen", "turtlesim/srv/SetPen"),
            offers("turtle1/teleport_absolute", "turtlesim/srv/TeleportAbsolute"),
            offers("turtle1/teleport_relative", "turtlesim/srv/TeleportRelative"),
            offers("~save_image", "std_srvs/srv/Trigger"),
        ),
    ),
)

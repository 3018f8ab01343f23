"""turtlesim."""

from __future__ import annotations

from gazelle.node_specs.spec import NodeSpec

__all__ = ["TURTLES"]

TURTLES = (
    NodeSpec(
        package="turtlesim",
        executable="turtle_teleop_key",
        entry="gazelle.nodes.turtlesim.teleop:run",
        does="drives a turtle from the keyboard",
        is_light=False,
        name="teleop_turtle",
    ),
    NodeSpec(
        package="turtlesim",
        executable="mimic",
        entry="gazelle.nodes.turtlesim.mimic:run",
        does="lets one turtle do what another one does",
        is_light=True,
        name="turtle_mimic",
    ),
    NodeSpec(
        package="turtlesim",
        executable="draw_square",
        entry="gazelle.nodes.turtlesim.draw_square:run",
        does="lets a turtle draw squares",
        is_light=True,
    ),
    NodeSpec(
        package="turtlesim",
        executable="turtlesim_node",
        entry="gazelle.studio.views.companions:turtlesim",
        does="turtles that draw",
        is_light=False,
        name="turtlesim",
    ),
)

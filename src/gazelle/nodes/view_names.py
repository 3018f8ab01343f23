"""Windows of ROS and Gazebo by ``(package, type)``, and what opens a panel in their place.

The page that shows them is a higher layer: it is named here as every node is, and imported when
one is started.
"""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["VIEWS", "ViewName"]

_Names = tuple[tuple[str, str], ...]


class ViewName(NamedTuple):
    """A window.

    Attributes:
        package, type: its first name.
        target: ``module:function``.
        help: one line about it.
        aliases: other names.
        name: of its node, the type when empty.
    """

    package: str
    type: str
    target: str
    help: str
    aliases: _Names = ()
    name: str = ""


def _rqt(package: str, help_line: str, *aliases: tuple[str, str]) -> ViewName:
    """Return a plug-in of rqt that takes no words."""
    return ViewName(package, package, f"gazelle.studio.views.plain:{package}", help_line, aliases)


_WORDS = "gazelle.studio.views.nodes"
_BESIDE = "gazelle.studio.views.companions"
_ACTION_WINDOWS = tuple(
    (package, name)
    for package in ("actionlib", "actionlib_tools")
    for name in ("axclient.py", "axserver.py")
)

VIEWS: tuple[ViewName, ...] = (
    ViewName(
        "gazebo_ros",
        "gzclient",
        f"{_WORDS}:gzclient",
        "shows the world",
        (("gazebo", "gzclient"), ("gazebo_ros", "gzclient.py")),
    ),
    ViewName(
        "rviz", "rviz", f"{_WORDS}:rviz", "displays of topics in 3D", (("rqt_rviz", "rqt_rviz"),)
    ),
    ViewName("rviz2", "rviz2", f"{_WORDS}:rviz", "displays of topics in 3D"),
    ViewName("rqt_gui", "rqt_gui", f"{_WORDS}:rqt", "all panels of rqt", (("rqt_gui", "rqt"),)),
    ViewName("rqt_plot", "rqt_plot", f"{_WORDS}:rqt_plot", "numbers over time"),
    ViewName(
        "rqt_image_view",
        "rqt_image_view",
        f"{_WORDS}:image_view",
        "pictures of a topic",
        (("image_view", "image_view"),),
    ),
    ViewName("rqt_bag", "rqt_bag", f"{_WORDS}:rqt_bag", "a bag's timeline"),
    ViewName(
        "actionlib",
        "axclient.py",
        "gazelle.studio.views.plain:action_caller",
        "sends goals",
        _ACTION_WINDOWS[1:],
    ),
    ViewName(
        "joint_state_publisher_gui",
        "joint_state_publisher_gui",
        f"{_BESIDE}:joint_state_publisher_gui",
        "publishes joint states, moved by sliders",
    ),
    ViewName(
        "turtlesim",
        "turtlesim_node",
        f"{_BESIDE}:turtlesim",
        "turtles that draw",
        name="turtlesim",
    ),
    _rqt("rqt_action", "types of actions"),
    _rqt("rqt_console", "what nodes log"),
    _rqt("rqt_ez_publisher", "messages from sliders"),
    _rqt("rqt_graph", "who publishes to whom"),
    _rqt("rqt_logger_level", "levels of nodes' loggers"),
    _rqt("rqt_msg", "types of messages"),
    _rqt("rqt_publisher", "messages from forms and expressions"),
    _rqt(
        "rqt_reconfigure", "parameters of running nodes", ("dynamic_reconfigure", "reconfigure_gui")
    ),
    _rqt("rqt_robot_steering", "velocities from sliders and keys"),
    _rqt("rqt_service_caller", "calls services"),
    _rqt("rqt_srv", "types of services"),
    _rqt("rqt_tf_tree", "frames and who broadcasts them"),
    _rqt("rqt_top", "nodes and their processes"),
    _rqt("rqt_topic", "topics with rates and values"),
)

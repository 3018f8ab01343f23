"""``rviz``, ``rqt_plot`` and their kin as commands: the nodes of the same names."""

from __future__ import annotations

import os

__all__ = ["VIEW_COMMANDS", "main"]

VIEW_COMMANDS: dict[str, tuple[str, str]] = {
    "gzclient": ("gazebo_ros/gzclient", "show the running world"),
    "rqt": ("rqt_gui/rqt_gui", "open the page: panels for topics, plots, graphs, services …"),
    "rqt_bag": ("rqt_bag/rqt_bag", "show a bag's timeline"),
    "rqt_console": ("rqt_console/rqt_console", "show what nodes log"),
    "rqt_graph": ("rqt_graph/rqt_graph", "show who publishes to whom"),
    "rqt_image_view": ("rqt_image_view/rqt_image_view", "show pictures of a topic"),
    "rqt_logger_level": ("rqt_logger_level/rqt_logger_level", "set levels of nodes' loggers"),
    "rqt_plot": ("rqt_plot/rqt_plot", "plot numbers of topics"),
    "rqt_publisher": ("rqt_publisher/rqt_publisher", "publish from forms and expressions"),
    "rqt_reconfigure": ("rqt_reconfigure/rqt_reconfigure", "change parameters of running nodes"),
    "rqt_robot_steering": ("rqt_robot_steering/rqt_robot_steering", "drive with sliders and keys"),
    "rqt_service_caller": ("rqt_service_caller/rqt_service_caller", "call services from forms"),
    "rqt_tf_tree": ("rqt_tf_tree/rqt_tf_tree", "show frames and who broadcasts them"),
    "rqt_topic": ("rqt_topic/rqt_topic", "show topics with rates and values"),
    "rviz": ("rviz/rviz", "show topics in 3D"),
    "rviz2": ("rviz2/rviz2", "show topics in 3D"),
}


def main(argv: list[str]) -> int:
    """Show a panel until Ctrl-C; `argv` begins with the command's name."""
    # Every command imports this module's table.
    from gazelle.nodes.__main__ import main as run_node

    os.environ.setdefault("ROS_NAMESPACE", "/")
    node, _ = VIEW_COMMANDS[argv[0]]
    return run_node([node, *argv[1:]])

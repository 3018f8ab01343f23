"""Commands that launch files, rosrun and ros2 run name as nodes."""

from __future__ import annotations

from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName

__all__ = ["COMMANDS"]

# The words behind ``gazelle`` by name.
COMMANDS: dict[NodeName, str] = {
    **{
        NodeName(name, name, ROS_1): name
        for name in ("rosmsg", "rosnode", "rosparam", "rosservice", "rostopic")
    },
    NodeName("dynamic_reconfigure", "dynparam", ROS_1): "dynparam",
    NodeName("tf", "tf_echo", ROS_1): "tf_echo",
    NodeName("tf2_ros", "tf2_echo", ROS_2): "tf_echo --tf2",
    NodeName("tf", "tf_monitor", ROS_1): "tf_monitor",
    NodeName("tf2_ros", "tf2_monitor", ROS_2): "tf_monitor",
    NodeName("tf", "view_frames", ROS_1): "view_frames",
    NodeName("tf2_tools", "view_frames", ROS_2): "view_frames --tf2",
    NodeName("tf2_tools", "view_frames.py"): "view_frames --tf2",
    NodeName("xacro", "xacro"): "xacro",
    NodeName("xacro", "xacro.py", ROS_1): "xacro",
}

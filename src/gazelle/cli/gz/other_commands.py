"""What to use instead of the commands of ``gz`` and ``ign`` that Gazelle has under other names."""

from __future__ import annotations

__all__ = ["GZ_INSTEAD", "IGN_INSTEAD"]

GZ_INSTEAD = {
    "camera": "the browser page of the simulator",
    "debug": "gazelle --help",
    "marker": "a visualization_msgs/Marker topic",
    "physics": "rosservice call /gazebo/set_physics_properties",
    "plugin": "gazelle doctor FILE, which says what a plug-in is here",
}
IGN_INSTEAD = {
    "fuel": "models in local folders; nothing is downloaded",
    "gui": "ign gazebo -g",
    "launch": "roslaunch",
    "log": "rosbag",
    "msg": "rosmsg show",
    "param": "rosparam, or ros2 param",
    "plugin": "gazelle doctor FILE, which says what a plug-in is here",
    "sim": "ign gazebo, as Fortress calls it, or gz sim",
}

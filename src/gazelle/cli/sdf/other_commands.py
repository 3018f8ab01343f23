"""What to use instead of the commands of ``gz`` and ``ign`` that Gazelle has under other names."""

from __future__ import annotations

__all__ = ["GZ_INSTEAD", "IGN_INSTEAD"]

GZ_INSTEAD = {
    "camera": "the browser page of the simulator",
    "debug": "gazelle --help",
    "joint": "rosservice call /gazebo/apply_joint_effort",
    "log": "rosbag",
    "marker": "a visualization_msgs/Marker topic",
    "model": "spawn_model, or rosservice call /gazebo/get_model_state, set_model_state, "
    "delete_model",
    "physics": "rosservice call /gazebo/set_physics_properties",
    "stats": "rostopic echo /clock",
    "topic": "rostopic list, rostopic echo",
    "world": "rosservice call /gazebo/pause_physics, unpause_physics, reset_world, "
    "reset_simulation",
}
IGN_INSTEAD = {
    "fuel": "models in local folders; nothing is downloaded",
    "gazebo": "gazelle gazebo FILE",
    "gui": "gazelle gazebo FILE",
    "launch": "roslaunch",
    "log": "rosbag",
    "model": "rosservice call /gazebo/get_model_state",
    "msg": "rosmsg show",
    "param": "rosparam, or ros2 param",
    "plugin": "gazelle doctor FILE, which says what a plug-in is here",
    "service": "rosservice list",
    "sim": "gazelle gazebo FILE",
    "topic": "rostopic list, rostopic echo",
}

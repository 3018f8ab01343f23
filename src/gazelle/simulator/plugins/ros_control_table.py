"""Keys of ``libgazebo_ros_control``."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.table import PluginTable

__all__ = ["DEFAULT_ROBOT_SIM", "OF_2011", "TABLE"]

OF_2011 = "gazebo_ros_controller_manager"
"""The library of the PR2's time."""

DEFAULT_ROBOT_SIM = "gazebo_ros_control/DefaultRobotHWSim"

_MSGS = "controller_manager_msgs"

TABLE = PluginTable(
    ParameterTable(
        "ros_control",
        "Simulated hardware and the controller manager of ROS 1. Joints come from the "
        "`<transmission>` elements; controllers and their parameters are on the controllers page.",
        ("gazebo_ros_control", OF_2011),
        (
            Parameter(
                "robotNamespace",
                "text",
                "",
                "namespace of manager, controllers and parameters; the model's name when absent",
            ),
            Parameter(
                "controlPeriod", "number", 0.0, "control period; a physics step when absent", "s"
            ),
            Parameter("robotParam", "text", "robot_description", "parameter with the URDF"),
            Parameter(
                "robotSimType",
                "text",
                DEFAULT_ROBOT_SIM,
                "class of the hardware; others are compiled code, and the default is used instead",
            ),
            Parameter(
                "eStopTopic",
                "text",
                "",
                "emergency stop: while true, no effort, no speed, positions stay; on release the "
                "controllers restart",
            ),
            Parameter(
                "legacyModeNS",
                "flag",
                False,
                "true reads PID gains from `/gazebo_ros_control/pid_gains`, without the"
                " namespace, as "
                "Kinetic and Melodic do; when absent both places are looked at",
            ),
            Parameter("alwaysOn", "refused", "", "a model plug-in always runs"),
            Parameter("updateRate", "refused", "", "the control period is `controlPeriod`"),
            Parameter("interface:audio", "refused", "", "a placeholder that Gazebo of 2011 needed"),
        ),
    ),
    topics=(Topic("{eStopTopic}", "std_msgs/msg/Bool", kind="listens"),),
    services=tuple(
        Topic(f"controller_manager/{verb}", f"{_MSGS}/{kind}", kind="service")
        for verb, kind in (
            ("list_controllers", "ListControllers"),
            ("list_controller_types", "ListControllerTypes"),
            ("load_controller", "LoadController"),
            ("reload_controller_libraries", "ReloadControllerLibraries"),
            ("switch_controller", "SwitchController"),
            ("unload_controller", "UnloadController"),
        )
    ),
    behaviour=(
        "The description is read from the parameter `robotParam`, searched upwards from "
        "`robotNamespace`; without that parameter the model's own is used (Gazebo would wait for "
        "it for ever).",
        "Joints are driven directly: mechanical reductions of transmissions do not act "
        "(`DefaultRobotHWSim`). Transmissions of several joints, which Gazebo leaves out, drive "
        "each of their joints.",
        "`EffortJointInterface`: the effort acts on the joint, at most its limit, from controller "
        "to controller until the next command; where a position or velocity limit is passed, none "
        "acts further outwards (`EffortJointSaturationHandle`).",
        "`PositionJointInterface`: the joint is put to the commanded position whatever it takes, "
        "at most as fast as its velocity limit; with gains in "
        "`<namespace>/gazebo_ros_control/pid_gains/<joint>` a PID makes an effort of the error.",
        "`VelocityJointInterface`: a motor with the joint's effort limit; with gains a PID makes "
        "an effort of the error. An effort limit of 0 stops it, as in Gazebo.",
        "PIDs run at every step on the states of the last control period.",
        "`<safety_controller>` and `joint_limits/<joint>` parameters act as in "
        "joint_limits_interface. Limits count per physics step.",
        "Joints that a configured controller names hold where they were spawned until a controller "
        "claims them; of continuous joints those that a controller of positions or trajectories "
        "names. Gazebo lets them fall.",
        "Stopped controllers leave their last command behind, as in Gazebo.",
        "IMUs and force-torque sensors of the model are there for controllers; DefaultRobotHWSim "
        "has none.",
        "A joint that is not in the model is reported and left out; Gazebo would start nothing.",
        "`gazebo_ros_controller_manager` of 2011 (PR2) means the same; its namespace is the root.",
    ),
)

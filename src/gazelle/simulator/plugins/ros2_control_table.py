"""Keys of ``libgazebo_ros2_control`` and of gz-sim's ``gz_ros2_control``."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.table import PluginTable

__all__ = ["GZ_TABLE", "TABLE"]

_MSGS = "controller_manager_msgs"
_SERVICES = tuple(
    Topic(f"{{controller_manager_name}}/{verb}", f"{_MSGS}/{kind}", kind="service")
    for verb, kind in (
        ("configure_controller", "ConfigureController"),
        ("list_controllers", "ListControllers"),
        ("list_controller_types", "ListControllerTypes"),
        ("list_hardware_components", "ListHardwareComponents"),
        ("list_hardware_interfaces", "ListHardwareInterfaces"),
        ("load_controller", "LoadController"),
        ("reload_controller_libraries", "ReloadControllerLibraries"),
        ("switch_controller", "SwitchController"),
        ("unload_controller", "UnloadController"),
    )
)
_COMMON = (
    "Hardware comes from the `<ros2_control>` blocks of the model; `initial_value` of position and "
    "velocity states sets joints when the model is spawned.",
    "`mock_components/GenericSystem` mirrors commands into states, with its parameters, and moves "
    "nothing; Gazebo would not load it here.",
    "A class of other hardware is reported; nothing takes its place.",
    "Commands are kept within `min` and `max` of their `<command_interface>`, as ros2_control does "
    'since Jazzy, unless `<limits enable="false"/>`.',
    "Joints with a `<mimic>` follow in the physics. The parameters `mimic`, `multiplier` and "
    "`offset` of a block's joint make it follow where the description has no `<mimic>`.",
    "Of the joints' `<limit>` the effort acts, in the physics, and no effort drives a joint beyond "
    "the velocity; on other commands of ROS 2's simulated hardware velocity limits do not act, nor "
    "do `<transmission>` elements, as in Gazebo.",
    "IMU and force-torque sensors of the model are states by the sensor's name.",
    "A command that was never given (NaN) leaves the joint as it is: held.",
)
_HOLD = Parameter("hold_joints", "flag", True, "joints without a claimed command stand still")
_PARAMETERS = (
    Parameter("parameters", "text", "", "parameter file; may be repeated, later ones win"),
    Parameter("controller_manager_name", "text", "controller_manager", "node name of the manager"),
)
_DESCRIPTION = (
    Parameter(
        "robot_param",
        "text",
        "robot_description",
        "parameter whose `<ros2_control>` blocks count for a model without any, as from SDF",
    ),
    Parameter(
        "robot_param_node",
        "text",
        "robot_state_publisher",
        "node whose parameter it is; else it is searched upwards from the namespace",
    ),
)
_SIM_TYPE = "the class stands in the `<ros2_control>` block"

TABLE = PluginTable(
    ParameterTable(
        "ros2_control",
        "Simulated hardware and the controller manager of ROS 2 in Gazebo Classic.",
        ("gazebo_ros2_control",),
        (
            *_PARAMETERS,
            _HOLD,
            *_DESCRIPTION,
            Parameter("robot_sim_type", "refused", "", _SIM_TYPE, aliases=("robotSimType",)),
        ),
    ),
    services=_SERVICES,
    behaviour=(
        *_COMMON,
        "`position` puts the joint where it is told and `velocity` moves it so, whatever it takes; "
        "`effort` acts on the joint, at most its limit (`SetPosition`, `SetVelocity`, `SetForce`).",
        "With `pos_kp`, `pos_ki`, `pos_kd` or `vel_kp` … in the joint, or "
        "`pid_gains.position.<joint>.kp` … of the plug-in's node, PIDs make efforts of the errors, "
        "at every step.",
        "Of several claimed commands of a joint position counts, then velocity, then effort.",
    ),
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim ros2_control",
        "Simulated hardware and the controller manager of ROS 2 in gz-sim.",
        (
            "gz_ros2_control-system",
            "ign_ros2_control-system",
            "gz_ros2_control::GazeboSimROS2ControlPlugin",
            "ign_ros2_control::IgnitionROS2ControlPlugin",
        ),
        (
            *_PARAMETERS,
            _HOLD,
            Parameter(
                "position_proportional_gain",
                "number",
                0.1,
                "share of a position error that is made up for in one control period",
            ),
            *_DESCRIPTION,
        ),
    ),
    services=_SERVICES,
    behaviour=(
        *_COMMON,
        "Joints have motors with the joint's effort limit. `position` asks for the speed "
        "`position_proportional_gain` · error · update rate, `velocity` for its own; `effort` acts "
        "on the joint.",
        "Of several claimed commands of a joint velocity counts, then position, then effort.",
    ),
)

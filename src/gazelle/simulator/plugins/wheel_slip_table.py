"""Names and keys of the wheel slip plug-ins."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.table import PluginTable

__all__ = ["GAZEBO_TABLE", "GZ_TABLE", "TABLE"]

_LAW = (
    "A wheel slides at slip · F under the friction force F, with slip = compliance · r |ω| /"
    " `wheel_normal_force`: the slip ratio is the compliance times the force ratio, up to the"
    " friction coefficient (docs/contact.md).",
    "The rate is looked at 100 times a second; a wheel that does not turn does not slip.",
    "`fdir1` is not needed: the directions are those of the wheel's joint.",
)
_WHEEL = Parameter(
    "wheel",
    "group",
    "",
    "a wheel by its `link_name`, with slip_compliance_lateral, slip_compliance_longitudinal,"
    " wheel_normal_force in N and wheel_radius in m (else that of its collision); repeatable",
)

TABLE = PluginTable(
    ParameterTable(
        "wheel_slip",
        "Lets wheels slip in proportion to force, with parameters that can be changed live.",
        ("gazebo_ros_wheel_slip",),
        (
            _WHEEL,
            Parameter(
                "robotNamespace",
                "text",
                "wheel_slip",
                "below the model's name (ROS 1)",
                generations=(1,),
            ),
            Parameter(
                "wheel_spin_tolerance", "number", 1e-3, "rim speed below which slip is 0", "m/s"
            ),
            Parameter("publisher_update_rate", "number", 100.0, "rate of `wheel_slip`", "Hz"),
        ),
    ),
    topics=(
        Topic("wheel_slip", "gazebo_msgs/msg/WheelSlip", rate="`publisher_update_rate` (ROS 2)"),
        Topic(
            "/M/wheel_slip/parameter_updates",
            "dynamic_reconfigure/msg/Config",
            rate="changes (ROS 1)",
        ),
    ),
    services=(
        Topic(
            "/M/wheel_slip/set_parameters (ROS 1)",
            "dynamic_reconfigure/srv/Reconfigure",
            kind="service",
        ),
        Topic("set_parameters … (ROS 2)", "rcl_interfaces/srv/SetParameters …", kind="service"),
    ),
    behaviour=(
        *_LAW,
        "ROS 1 takes `slip_compliance_unitless_lateral` and `_longitudinal` by"
        " dynamic_reconfigure, for all wheels.",
        "ROS 2 has them as parameters of its node, for all wheels or `/link` for one. The"
        " parameters `friction_coefficient_…` are not offered: friction is that of the surface.",
    ),
    in_both_ros=True,
)

GAZEBO_TABLE = PluginTable(
    ParameterTable(
        "WheelSlipPlugin",
        "Gazebo Classic's wheel slip without ROS.",
        ("WheelSlipPlugin",),
        (_WHEEL,),
    ),
    behaviour=_LAW,
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim wheel slip",
        "The gz-sim system of the same purpose.",
        (
            "gz-sim-wheel-slip-system",
            "ignition-gazebo-wheel-slip-system",
            "gz::sim::systems::WheelSlip",
            "ignition::gazebo::systems::WheelSlip",
        ),
        (_WHEEL,),
    ),
    behaviour=_LAW,
)

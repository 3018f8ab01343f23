"""What the documentation says of ROS 2's pid_controller."""

from __future__ import annotations

from gazelle.control.pid.reading import gain_rows
from gazelle.control.table import ControllerTable
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["PID_CONTROLLER_TABLE"]

_ONLY = (2,)


def _row(
    key: str, kind: ParameterKind, default: object, meaning: str, *, live: bool = False
) -> Parameter:
    return Parameter(key, kind, default, meaning, live=live, generations=_ONLY)


PID_CONTROLLER_TABLE = ControllerTable(
    ParameterTable(
        "pid_controller",
        "A PID for each degree of freedom, from references on a topic to any command interface.",
        ("pid_controller/PidController",),
        (
            _row("dof_names", "texts", None, "whose command_interface is claimed; required"),
            _row(
                "reference_and_state_dof_names",
                "texts",
                (),
                "whose state is read; dof_names if empty",
            ),
            _row("command_interface", "text", None, "what is commanded; required"),
            _row(
                "reference_and_state_interfaces",
                "texts",
                None,
                "a state, or it and its rate; required",
            ),
            _row("set_current_state_as_first_setpoint", "flag", True, "hold where it begins"),
            _row("use_external_measured_states", "flag", False, "states come on ~/measured_state"),
            _row("enable_feedforward", "flag", False, "use feedforward_gain", live=True),
            *gain_rows("gains.<dof>", _ONLY),
            _row("gains.<dof>.feedforward_gain", "number", 0.0, "times the reference", live=True),
            _row(
                "gains.<dof>.angle_wraparound",
                "flag",
                False,
                "take the shorter way round",
                live=True,
            ),
            _row("gains.<dof>.save_i_term", "flag", True, "keep the integral over a restart"),
            _row("gains.<dof>.activate_state_publisher", "flag", False, "offer ~/<dof>/pid_state"),
            _row(
                "gains.<dof>.saturation",
                "refused",
                None,
                "u_clamp_max and u_clamp_min alone decide",
            ),
        ),
    ),
    interfaces="claims command_interface of dof_names; reads the interfaces of the references",
    topics=(
        Topic("~/reference", "control_msgs/MultiDOFCommand", "listens", generations=_ONLY),
        Topic(
            "~/measured_state",
            "control_msgs/MultiDOFCommand",
            "listens",
            "with use_external_measured_states",
            generations=_ONLY,
        ),
        Topic(
            "~/controller_state",
            "control_msgs/MultiDOFStateStamped",
            rate="every update",
            generations=_ONLY,
        ),
        Topic(
            "~/<dof>/pid_state",
            "control_msgs/PidState",
            rate="every update, with activate_state_publisher",
            generations=_ONLY,
        ),
        Topic("~/set_feedforward_control", "std_srvs/SetBool", "service", generations=_ONLY),
    ),
    behaviour=(
        "With two interfaces the rate's error is what d acts on, once a reference of the rate is "
        "known (pid_controller.cpp).",
        "Nothing is commanded of a degree of freedom while its reference or state is unknown.",
        "References stay until the next; NaN in a message leaves one as it is.",
        "It cannot be chained: references come on the topic.",
    ),
)

"""``gz joint``: a force on a joint."""

from __future__ import annotations

from collections.abc import Mapping

from gazelle.cli.gz.options import GzCommand, GzError, GzOption, number
from gazelle.cli.gz.world_link import world_link
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import message_type

__all__ = ["COMMAND", "run"]

_GAINS = ("pos-t", "pos-p", "pos-i", "pos-d", "vel-t", "vel-p", "vel-i", "vel-d")
COMMAND = GzCommand(
    "joint",
    "Apply a force to a joint. Position and velocity targets\n\twith PID gains are not here; "
    "use a controller.",
    (
        GzOption("world-name", "w", "World name; Gazelle has one world.", takes=True),
        GzOption("model-name", "m", "Model name.", takes=True),
        GzOption("joint-name", "j", "Joint name.", takes=True),
        GzOption("force", "f", "Force to apply to a joint (N).", takes=True),
        *(GzOption(name, "", "Not here; use a controller.", takes=True) for name in _GAINS),
    ),
)


def run(options: Mapping[str, str]) -> int:
    """Keep a force or torque on a joint until another one is set.

    Raises:
        GzError: names are missing or unknown, or there is no world.
    """
    given = [f"--{name}" for name in _GAINS if name in options]
    if given:
        raise GzError(
            f"{', '.join(given)}: no PID is behind gz joint here; load a controller of "
            "ros_control (effort_controllers/JointPositionController) or ros2_control"
        )
    for name, letter in (("model-name", "m"), ("joint-name", "j"), ("force", "f")):
        if not options.get(name):
            raise GzError(f"--{name} (-{letter}) is required; see gz help joint")
    _apply(options["model-name"], options["joint-name"], number(options, "force"))
    return 0


def _apply(model: str, joint: str, force: float) -> None:
    scoped = f"{model}::{joint}"
    with world_link() as link:
        link.check_model(model)
        found = link.call(
            "get_model_properties", "gazebo_msgs/GetModelProperties", model_name=model
        )
        names = list(found.joint_names)
        if joint not in names:
            hint = did_you_mean(joint, names) or f"joints: {', '.join(names) or 'none'}"
            raise GzError(f"model[{model}] has no joint[{joint}]; {hint}")
        link.call("clear_joint_forces", "gazebo_msgs/JointRequest", joint_name=scoped)
        for_ever = message_type("builtin_interfaces/Duration")(sec=-1)
        link.call(
            "apply_joint_effort",
            "gazebo_msgs/ApplyJointEffort",
            joint_name=scoped,
            effort=force,
            duration=for_ever,
        )

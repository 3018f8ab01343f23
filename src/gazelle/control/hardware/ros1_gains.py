"""Gains of a ROS 1 robot's position and velocity joints."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.control.hardware.host import ParameterStore
from gazelle.control.hardware.ros1_joints import Ros1Joint
from gazelle.control.parameters import controller_parameters
from gazelle.control.pid import PidGains, read_gains
from gazelle.control.pid.reading import gain_rows
from gazelle.description.model import Model
from gazelle.diagnostics import Diagnostics
from gazelle.parameters import ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["GAINS_NAME", "gains_parameters", "read_joint_gains"]

GAINS_NAME = "gazebo_ros_control/pid_gains"


def gains_parameters(
    parameters: ParameterStore, namespace: str, diagnostics: Diagnostics
) -> ParameterReader:
    """Return ``<namespace>/gazebo_ros_control/pid_gains``; keys begin with the joint's name."""
    place = f"{namespace}/{GAINS_NAME}"
    tree = parameters.get(place, {})
    rows = gain_rows("<joint>", (1,))
    table = ParameterTable(GAINS_NAME, "PIDs of simulated joints.", rows=rows)
    return controller_parameters(
        "gazebo_ros_control",
        tree if isinstance(tree, dict) else {},
        table,
        diagnostics,
        full_name=lambda key: f"{place}/{key.replace('.', '/')}",
    )


def read_joint_gains(
    parameters: ParameterReader, model: Model, joints: Sequence[Ros1Joint]
) -> dict[str, PidGains]:
    """Return the gains of the position and velocity joints that have some.

    Position joints without are ideal servos, which is said once.
    """
    found = {}
    ideal = []
    for joint in joints:
        if joint.interface not in {"position", "velocity"}:
            continue
        gains = read_gains(parameters, "", joint.name)
        if gains is not None:
            found[joint.name] = gains
        elif joint.interface == "position":
            ideal.append(joint.name)
    if found:
        parameters.report_unknown()
    if ideal:
        text = f"position joints {', '.join(ideal)} follow their commands whatever it takes: there"
        text += f" are no gains in {parameters.full_name('<joint>')} (No p gain specified for pid)"
        parameters.diagnostics.report("control.ideal-servo", text, model.span)
    return found

"""ROS 1's joint_state_controller: publishes ``joint_states``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.publish_rate import PublishRate
from gazelle.control.interface_values import Array, Indices
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["JointStateController"]

_INTERFACES = ("position", "velocity", "effort")


class JointStateController(Controller):
    """Publishes position, velocity and effort of the hardware's joints."""

    TABLE = ControllerTable(
        ParameterTable(
            "joint_state_controller",
            "Publishes the state of all joints, or of those it is told.",
            ("joint_state_controller/JointStateController",),
            (
                Parameter("publish_rate", "number", None, "how often; required", "Hz"),
                Parameter(
                    "joints", "texts", (), "joints and their order; all of the hardware if empty"
                ),
                Parameter(
                    "extra_joints",
                    "group",
                    None,
                    "list of {name, position, velocity, effort} that are published as they stand",
                ),
            ),
        ),
        interfaces="claims none; reads position, velocity and effort of the joints",
        topics=(Topic("joint_states", "sensor_msgs/JointState", rate="publish_rate"),),
        behaviour=(
            "The first message comes with the first update; the rate is kept on average "
            "(joint_state_controller.cpp).",
            "A joint that lacks a state is published as 0 in that field.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the joints."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("publish_rate")
        self._rate = PublishRate(parameters.number("publish_rate"), at_once=True)
        names = list(parameters.texts("joints") or self.robot.joints)
        resources = [context.joint(name) for name in names]
        self._columns: list[tuple[Indices, Indices]] = []
        for interface in _INTERFACES:
            rows = [k for k, joint in enumerate(resources) if interface in joint.state_interfaces]
            known = tuple(f"{names[k]}/{interface}" for k in rows)
            self.states += known
            self._columns.append((np.array(rows, dtype=np.intp), context.state_indices(known)))
        extra = self._extra_joints(names)
        self._names = [*names, *extra]
        fixed = np.zeros((len(_INTERFACES), len(names)))
        rows_of_extra = np.array(list(extra.values()), dtype=np.float64).reshape(
            -1, len(_INTERFACES)
        )
        self._template: Array = np.hstack([fixed, rows_of_extra.T])
        self._publisher = context.ports.publisher("joint_states", "sensor_msgs/JointState")

    def start(self, time_ns: int) -> None:
        """Begin to count; the rate is kept over restarts."""
        self._rate.start(time_ns)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish when it is due and somebody listens."""
        if not self._rate.due(time_ns) or not self._publisher.matched:
            return
        values = self._template.copy()
        for row, (joints, indices) in zip(values, self._columns, strict=True):
            row[joints] = self.robot.interface_values.states[indices]
        message = stamped("sensor_msgs/JointState", time_ns)
        message.name = list(self._names)
        message.position, message.velocity, message.effort = values
        self._publisher.publish(message)

    def _extra_joints(self, names: list[str]) -> dict[str, tuple[float, ...]]:
        found: dict[str, tuple[float, ...]] = {}
        rows = self.context.parameters.raw("extra_joints", [])
        if not isinstance(rows, list | tuple):
            self._report("Extra joints specification is not an array. Ignoring.")
            return found
        for row in rows:
            problem = _problem(row, [*names, *found])
            if problem:
                self._report(problem)
            else:
                found[str(row["name"])] = tuple(float(row.get(key, 0.0)) for key in _INTERFACES)
        return found

    def _report(self, text: str) -> None:
        self.context.parameters.report("parameter.bad-value", text, key="extra_joints")


def _problem(row: Any, names: list[str]) -> str:
    if not isinstance(row, Mapping):
        return f"Extra joint specification is not a struct, but rather {row!r}. Ignoring."
    if "name" not in row:
        return f"Extra joint does not specify name: {dict(row)}. Ignoring."
    if row["name"] in names:
        return f"Joint state interface already contains specified extra joint '{row['name']}'."
    for key in _INTERFACES:
        value = row.get(key, 0.0)
        if isinstance(value, bool) or not isinstance(value, int | float):
            return f"Extra joint '{row['name']}' does not specify a valid default {key}. Ignoring."
    return ""

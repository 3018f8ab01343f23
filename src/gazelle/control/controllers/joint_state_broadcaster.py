"""ROS 2's joint_state_broadcaster: ``joint_states`` and ``dynamic_joint_states``."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Indices
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["JointStateBroadcaster"]

_FIELDS = ("position", "velocity", "effort")


class JointStateBroadcaster(Controller):
    """Publishes state interfaces at every update."""

    TABLE = ControllerTable(
        ParameterTable(
            "joint_state_broadcaster",
            "Publishes the state interfaces of the hardware, joints as `joint_states` and"
            " everything "
            "as `dynamic_joint_states`.",
            ("joint_state_broadcaster/JointStateBroadcaster",),
            (
                Parameter("joints", "texts", (), "joints to publish, together with `interfaces`"),
                Parameter(
                    "interfaces", "texts", (), "interfaces to publish, together with `joints`"
                ),
                Parameter("extra_joints", "texts", (), "further joints, published as 0"),
                Parameter("use_local_topics", "flag", False, "topics below `~/`"),
                Parameter(
                    "map_interface_to_joint_state.position",
                    "text",
                    "position",
                    "published as position",
                ),
                Parameter(
                    "map_interface_to_joint_state.velocity",
                    "text",
                    "velocity",
                    "published as velocity",
                ),
                Parameter(
                    "map_interface_to_joint_state.effort", "text", "effort", "published as effort"
                ),
                Parameter(
                    "use_urdf_to_filter", "flag", True, "`joint_states` has joints of the URDF only"
                ),
                Parameter("frame_id", "text", "base_link", "frame of both messages"),
                Parameter(
                    "publish_dynamic_joint_states", "flag", True, "offer `dynamic_joint_states`"
                ),
            ),
        ),
        interfaces="claims none; reads all state interfaces, or `interfaces` of `joints`",
        topics=(
            Topic("joint_states", "sensor_msgs/JointState", rate="every update", frame="frame_id"),
            Topic(
                "dynamic_joint_states",
                "control_msgs/DynamicJointState",
                rate="every update",
                frame="frame_id",
            ),
        ),
        behaviour=(
            "A joint with at least one of position, velocity and effort is in `joint_states`; what "
            "it lacks is NaN (joint_state_broadcaster.cpp).",
            "Joints come in the order of the hardware's description.",
            "An interface mapped to a field takes its place, unless `interfaces` names that field.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the interfaces."""
        super().__init__(context)
        parameters = context.parameters
        self._wishes = self._wanted()
        # Whoever asks for everything takes what is there when it starts.
        self.takes_all_states = self._wishes == tuple(self.robot.interface_values.state_index)
        if not self._wishes:
            text = f"{context.name}: No state interfaces found to publish."
            if self.robot.absent:
                names = "', '".join(dict.fromkeys(self.robot.absent.values()))
                text += f" Hardware '{names}' was not loaded (see above)"
            raise ControllerError(text)
        self._interface_names = self._mapping()
        self._look_up()
        self._frame_id = parameters.text("frame_id")
        prefix = "~/" if parameters.flag("use_local_topics") else ""
        ports = context.ports
        self._publisher = ports.publisher(f"{prefix}joint_states", "sensor_msgs/JointState")
        self._dynamic = None
        if parameters.flag("publish_dynamic_joint_states"):
            topic, kind = f"{prefix}dynamic_joint_states", "control_msgs/DynamicJointState"
            self._dynamic = ports.publisher(topic, kind)

    def start(self, time_ns: int) -> None:
        """Take the interfaces of the hardware that is configured by now."""
        self._look_up()

    def _look_up(self) -> None:
        found = self._wishes
        if self.takes_all_states:
            found = self.robot.lifecycle.available(found)
        self.states = found
        indices = self.context.state_indices(found)
        self._values: dict[str, dict[str, int]] = {}
        for state, index in zip(found, indices.tolist(), strict=True):
            owner, _, interface = state.rpartition("/")
            name = self._interface_names.get(interface, interface)
            self._values.setdefault(owner, {})[name] = index
        extra = self.context.parameters.texts("extra_joints")
        self._extra = [name for name in extra if name not in self._values]
        self._names = [*self._joint_names(), *self._extra]
        self._columns = [self._column(field) for field in _FIELDS]

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish what somebody listens to."""
        if self._publisher.matched:
            self._publisher.publish(self._joint_states(time_ns))
        if self._dynamic is not None and self._dynamic.matched:
            self._dynamic.publish(self._dynamic_joint_states(time_ns))

    def _wanted(self) -> tuple[str, ...]:
        joints = self.context.parameters.texts("joints")
        interfaces = self.context.parameters.texts("interfaces")
        if not joints or not interfaces:
            return tuple(self.robot.interface_values.state_index)
        for joint in joints:
            if joint not in self.robot.sensors:
                self.context.joint(joint)
        return tuple(f"{joint}/{interface}" for joint in joints for interface in interfaces)

    def _mapping(self) -> dict[str, str]:
        parameters, found = self.context.parameters, {}
        named = parameters.texts("interfaces") if parameters.texts("joints") else ()
        for field in _FIELDS:
            key = f"map_interface_to_joint_state.{field}"
            interface = parameters.text(key)
            if field not in named:
                found[interface] = field
            elif interface != field:
                text = (
                    f"Mapping from '{interface}' to interface '{field}' will not be done, because "
                )
                text += f"'{field}' is defined in 'interface' parameter."
                parameters.report("parameter.idle", text, key=key)
        return found

    def _joint_names(self) -> list[str]:
        names = [owner for owner, found in self._values.items() if set(found) & set(_FIELDS)]
        parameters = self.context.parameters
        in_urdf = {joint.name for joint in self.robot.model.joints}
        if not in_urdf or parameters.texts("joints") or not parameters.flag("use_urdf_to_filter"):
            return names
        return [name for name in names if name in in_urdf]

    def _column(self, field: str) -> tuple[Indices, Indices]:
        rows = [k for k, name in enumerate(self._names) if field in self._values.get(name, {})]
        indices = [self._values[self._names[k]][field] for k in rows]
        return np.array(rows, dtype=np.intp), np.array(indices, dtype=np.intp)

    def _joint_states(self, time_ns: int) -> Any:
        states = self.robot.interface_values.states
        values = np.full((len(_FIELDS), len(self._names)), math.nan)
        if self._extra:
            values[:, -len(self._extra) :] = 0.0
        for row, (joints, indices) in zip(values, self._columns, strict=True):
            row[joints] = states[indices]
        message = stamped("sensor_msgs/JointState", time_ns, self._frame_id)
        message.name = list(self._names)
        message.position, message.velocity, message.effort = values
        return message

    def _dynamic_joint_states(self, time_ns: int) -> Any:
        states = self.robot.interface_values.states
        value = message_type("control_msgs/InterfaceValue")
        message = stamped("control_msgs/DynamicJointState", time_ns, self._frame_id)
        message.joint_names = [*self._values, *self._extra]
        message.interface_values = [
            value(interface_names=list(indices), values=states[list(indices.values())])
            for indices in self._values.values()
        ]
        zero = np.zeros(len(_FIELDS))
        message.interface_values += [
            value(interface_names=list(_FIELDS), values=zero.copy()) for _ in self._extra
        ]
        return message

"""Services about joints."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.description.model import Joint, JointType
from gazelle.diagnostics import did_you_mean
from gazelle.simulator.gazebo_ros.model_services import Row
from gazelle.simulator.gazebo_ros.timed_efforts import JointEfforts
from gazelle.simulator.input_validation import InputRefusedError
from gazelle.simulator.model_replacement import replace_model

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["JointServices"]

# gazebo_msgs/GetJointProperties. Gazebo itself always answers REVOLUTE.
_TYPES = {
    JointType.REVOLUTE: 0,
    JointType.CONTINUOUS: 1,
    JointType.PRISMATIC: 2,
    JointType.FIXED: 3,
    JointType.BALL: 4,
    JointType.UNIVERSAL: 5,
}


class JointServices:
    """``get/set_joint_properties``, ``apply_joint_effort``, ``clear_joint_forces``."""

    def __init__(self, server: WorldServer) -> None:
        self._server = server
        self._efforts = JointEfforts(server)
        server.world_resources.on_calm(self._efforts.forget)

    def rows(self) -> list[Row]:
        """Return the services below ``/gazebo``."""
        return [
            *self.property_rows(),
            Row("apply_joint_effort", "gazebo_msgs/ApplyJointEffort", self._apply),
            Row("clear_joint_forces", "gazebo_msgs/JointRequest", self._clear),
        ]

    def property_rows(self) -> list[Row]:
        """Return the services of ``libgazebo_ros_properties``."""
        return [
            Row("get_joint_properties", "gazebo_msgs/GetJointProperties", self._get_properties),
            Row("set_joint_properties", "gazebo_msgs/SetJointProperties", self._set_properties),
        ]

    def ros2_rows(self) -> list[Row]:
        """Return the services of gazebo_ros in ROS 2."""
        return [
            Row("clear_joint_efforts", "gazebo_msgs/JointRequest", self._clear),
            Row("apply_joint_effort", "gazebo_msgs/ApplyJointEffort", self._apply),
        ]

    def _find(self, name: str) -> str | None:
        """Gazebo takes the first joint of this name in any model; a scoped name is exact."""
        names = self._server.engine.joint_names
        if name in names:
            return name
        return next((item for item in names if item.split("::", 1)[1] == name), None)

    def _unknown(self, service: str, name: str) -> str:
        names = [item.split("::", 1)[1] for item in self._server.engine.joint_names]
        hint = did_you_mean(name, names)
        return f"{service}: joint not found" + (f"; {hint}" if hint else "")

    def _get_properties(self, request: Any, response: Any) -> None:
        name = self._find(request.joint_name)
        response.success = name is not None
        if name is None:
            response.status_message = self._unknown("GetJointProperties", request.joint_name)
            return
        joint = self._server.engine.joint(name)
        response.type = _TYPES.get(joint.type, 0)
        response.damping = np.array([joint.axis.damping])
        response.position = np.array([joint.position])
        response.rate = np.array([joint.velocity])
        response.status_message = "GetJointProperties: got properties"

    def _set_properties(self, request: Any, response: Any) -> None:
        name = self._find(request.joint_name)
        response.success = name is not None
        if name is None:
            response.status_message = self._unknown("SetJointProperties", request.joint_name)
            return
        model_name, joint_name = name.split("::", 1)
        model = self._server.engine.world.model(model_name)
        assert model is not None
        joints = tuple(
            _changed(joint, request.ode_joint_config) if joint.name == joint_name else joint
            for joint in model.joints
        )
        replace_model(self._server.engine, replace(model, joints=joints))
        config = request.ode_joint_config
        if len(config.vel) and len(config.fmax):
            joint = self._server.engine.joint(name)
            joint.set_velocity_target(float(config.vel[0]), float(config.fmax[0]))
        response.status_message = "SetJointProperties: properties set"

    def _apply(self, request: Any, response: Any) -> None:
        name = self._find(request.joint_name)
        response.success = name is not None
        if name is None:
            response.status_message = self._unknown("ApplyJointEffort", request.joint_name)
            return
        joint = self._server.engine.joint(name)
        if not joint.is_driveable:
            text = f"'{name}' ({joint.type.value}) has no single coordinate that an effort drives"
            raise InputRefusedError(f"joint {text}")
        self._efforts.add(name, float(request.effort), request.start_time, request.duration)
        response.status_message = "ApplyJointEffort: effort set"

    def _clear(self, request: Any, response: Any) -> None:
        name = self._find(request.joint_name)
        if name is not None:
            self._efforts.clear(name)


def _changed(joint: Joint, config: Any) -> Joint:
    """Apply the ODE words that have a meaning here; the others are ODE's own softness."""
    axis = joint.axis
    if axis is None:
        return joint
    if len(config.damping):
        axis = replace(axis, damping=float(config.damping[0]))
    if len(config.hi_stop):
        axis = replace(axis, upper=float(config.hi_stop[0]))
    if len(config.lo_stop):
        axis = replace(axis, lower=float(config.lo_stop[0]))
    return replace(joint, axis=axis)

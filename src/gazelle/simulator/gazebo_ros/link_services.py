"""Services and topics about links, wrenches included."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.description.model import Inertial, Link
from gazelle.geometry import Pose
from gazelle.interfaces.poses import pose_message, twist_message
from gazelle.simulator.gazebo_ros.model_services import Entities, Row, place_link, state_from
from gazelle.simulator.gazebo_ros.timed_efforts import at_time, duration_ns
from gazelle.simulator.model_replacement import replace_model

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["LinkServices"]

_UNSCOPED = "did you forget to scope the link by model name?"


class LinkServices:
    """``get/set_link_state``, ``get/set_link_properties``, ``apply_body_wrench`` and their kin."""

    def __init__(self, server: WorldServer, entities: Entities) -> None:
        self._server = server
        self._entities = entities

    def rows(self) -> list[Row]:
        """Return the services below ``/gazebo``."""
        return [
            Row("get_link_state", "gazebo_msgs/GetLinkState", self._get_state),
            Row("set_link_state", "gazebo_msgs/SetLinkState", self._set_state),
            *self.property_rows(),
            Row("apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", self._apply_body_wrench),
            Row("clear_body_wrenches", "gazebo_msgs/BodyRequest", self._clear_body_wrenches),
        ]

    def property_rows(self) -> list[Row]:
        """Return the services of ``libgazebo_ros_properties``."""
        return [
            Row("get_link_properties", "gazebo_msgs/GetLinkProperties", self._get_properties),
            Row("set_link_properties", "gazebo_msgs/SetLinkProperties", self._set_properties),
        ]

    def ros2_rows(self) -> list[Row]:
        """Return the services of gazebo_ros in ROS 2."""
        return [
            Row("apply_link_wrench", "gazebo_msgs/ApplyLinkWrench", self._apply_link_wrench),
            Row("clear_link_wrenches", "gazebo_msgs/LinkRequest", self._clear_link_wrenches),
        ]

    def set_state(self, state: Any) -> str:
        """Apply a ``gazebo_msgs/LinkState``; returns what went wrong, empty when nothing did."""
        if self._entities.link(state.link_name) is None:
            return "SetLinkState: link does not exist" + self._entities.hint(state.link_name)
        frame = self._entities.frame(state.reference_frame)
        if frame is None:
            return "SetLinkState: failed"
        wanted = state_from(state).in_world(frame)
        return place_link(self._server.engine, state.link_name, wanted)

    def _get_state(self, request: Any, response: Any) -> None:
        state = self._entities.link(request.link_name)
        frame = self._entities.frame(request.reference_frame)
        if state is None or frame is None:
            what = "link" if state is None else "reference reference_frame"
            name = request.link_name if state is None else request.reference_frame
            text = f"GetLinkState: {what} not found, {_UNSCOPED}"
            response.success = False
            response.status_message = text + self._entities.hint(name)
            return
        relative = state.relative_to(frame)
        response.link_state.link_name = request.link_name
        response.link_state.pose = pose_message(relative.T_world_entity)
        response.link_state.twist = twist_message(relative.linear_m_s, relative.angular_rad_s)
        response.link_state.reference_frame = request.reference_frame
        response.success = True
        response.status_message = "GetLinkState: got state"

    def _set_state(self, request: Any, response: Any) -> None:
        problem = self.set_state(request.link_state)
        response.success = not problem
        response.status_message = problem or "SetLinkState: success"

    def _get_properties(self, request: Any, response: Any) -> None:
        link = self._description(request.link_name)
        if link is None:
            text = f"GetLinkProperties: link not found, {_UNSCOPED}"
            response.success = False
            response.status_message = text + self._entities.hint(request.link_name)
            return
        inertial = link.inertial or Inertial(0.0, inertia_kg_m2=(0, 0, 0, 0, 0, 0))
        response.com = pose_message(inertial.T_link_com)
        response.gravity_mode = link.gravity
        response.mass = float(inertial.mass_kg)
        names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        for name, value in zip(names, inertial.inertia_kg_m2, strict=True):
            setattr(response, name, float(value))
        response.success = True
        response.status_message = "GetLinkProperties: got properties"

    def _set_properties(self, request: Any, response: Any) -> None:
        link = self._description(request.link_name)
        if link is None:
            text = f"SetLinkProperties: link not found, {_UNSCOPED}"
            response.success = False
            response.status_message = text + self._entities.hint(request.link_name)
            return
        com = request.com.position
        tensor = (
            request.ixx, request.ixy, request.ixz, request.iyy, request.iyz, request.izz,
        )  # fmt: skip
        inertial = Inertial(
            float(request.mass),
            Pose((com.x, com.y, com.z)),
            tuple(float(v) for v in tensor),  # type: ignore[arg-type]
        )
        changed = replace(link, inertial=inertial, gravity=bool(request.gravity_mode))
        model_name = request.link_name.split("::", 1)[0]
        model = self._server.engine.world.model(model_name)
        assert model is not None
        links = tuple(changed if item is link else item for item in model.links)
        replace_model(self._server.engine, replace(model, links=links))
        response.success = True
        response.status_message = "SetLinkProperties: properties set"

    def _apply_body_wrench(self, request: Any, response: Any) -> None:
        self._apply_wrench(
            request.body_name, "ApplyBodyWrench: body does not exist", request, response
        )

    def _apply_link_wrench(self, request: Any, response: Any) -> None:
        self._apply_wrench(
            request.link_name, "ApplyLinkWrench: link does not exist", request, response
        )

    def _apply_wrench(self, name: str, unknown: str, request: Any, response: Any) -> None:
        if self._entities.link(name) is None:
            response.success = False
            response.status_message = unknown + self._entities.hint(name)
            return
        frame = self._entities.frame(request.reference_frame)
        if frame is None:
            response.success = False
            response.status_message = "ApplyBodyWrench: reference_frame not found"
            return
        axes = Pose(quat_xyzw=frame.T_world_entity.quat_xyzw)
        force = axes.rotate(_xyz(request.wrench.force))
        # As gazebo_ros does: the force acts at the centre of mass, the point only adds torque.
        torque = np.add(
            axes.rotate(_xyz(request.wrench.torque)),
            np.cross(axes.rotate(_xyz(request.reference_point)), force),
        )
        engine, lasting = self._server.engine, duration_ns(request.duration)

        def push() -> None:
            # Its model may have gone since it was asked for.
            if name in engine.link_names:
                engine.link(name).apply_wrench(force, torque, duration_ns=lasting)

        at_time(self._server, request.start_time, push)
        response.success = True
        response.status_message = ""

    def _clear_body_wrenches(self, request: Any, response: Any) -> None:
        self._clear(request.body_name)

    def _clear_link_wrenches(self, request: Any, response: Any) -> None:
        self._clear(request.link_name)

    def _clear(self, name: str) -> None:
        if self._entities.link(name) is not None:
            self._server.engine.link(name).clear_wrenches()

    def _description(self, name: str) -> Link | None:
        model_name, _, link_name = name.partition("::")
        model = self._server.engine.world.model(model_name)
        return None if model is None else model.link(link_name)


def _xyz(message: Any) -> tuple[float, float, float]:
    return (float(message.x), float(message.y), float(message.z))

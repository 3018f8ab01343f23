"""Services about the world's lights."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.description.model import Light
from gazelle.diagnostics import did_you_mean
from gazelle.simulator.gazebo_ros.entities import Row

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["LightServices"]


class LightServices:
    """``get/set_light_properties`` and ``delete_light``."""

    def __init__(self, server: WorldServer) -> None:
        self._server = server

    def rows(self) -> list[Row]:
        """Return the services below ``/gazebo``."""
        return [
            *self.property_rows(),
            Row("delete_light", "gazebo_msgs/DeleteLight", self._delete_light),
        ]

    def ros2_rows(self) -> list[Row]:
        """Return the services of gazebo_ros's system plug-ins in ROS 2: none."""
        return []

    def property_rows(self) -> list[Row]:
        """Return the services of ``libgazebo_ros_properties``."""
        return [
            Row("get_light_properties", "gazebo_msgs/GetLightProperties", self._get_light),
            Row("set_light_properties", "gazebo_msgs/SetLightProperties", self._set_light),
        ]

    def _get_light(self, request: Any, response: Any) -> None:
        light = self._light(request.light_name)
        response.success = light is not None
        if light is None:
            response.status_message = self._no_light("getLightProperties", request.light_name)
            return
        diffuse = response.diffuse
        diffuse.r, diffuse.g, diffuse.b, diffuse.a = (float(value) for value in light.diffuse)
        response.attenuation_constant = float(light.attenuation_constant)
        response.attenuation_linear = float(light.attenuation_linear)
        response.attenuation_quadratic = float(light.attenuation_quadratic)

    def _set_light(self, request: Any, response: Any) -> None:
        light = self._light(request.light_name)
        response.success = light is not None
        if light is None:
            response.status_message = self._no_light("setLightProperties", request.light_name)
            return
        diffuse = request.diffuse
        changed = replace(
            light,
            diffuse=(float(diffuse.r), float(diffuse.g), float(diffuse.b), float(diffuse.a)),
            attenuation_constant=float(request.attenuation_constant),
            attenuation_linear=float(request.attenuation_linear),
            attenuation_quadratic=float(request.attenuation_quadratic),
        )
        sensors = self._server.sensors
        sensors.lights = tuple(changed if item is light else item for item in sensors.lights)

    def _delete_light(self, request: Any, response: Any) -> None:
        light = self._light(request.light_name)
        response.success = light is not None
        if light is None:
            response.status_message = self._no_light("DeleteLight", request.light_name)
            return
        sensors = self._server.sensors
        sensors.lights = tuple(item for item in sensors.lights if item is not light)
        response.status_message = f"DeleteLight: {request.light_name} successfully deleted"

    def _light(self, name: str) -> Light | None:
        return next((item for item in self._server.sensors.lights if item.name == name), None)

    def _no_light(self, service: str, name: str) -> str:
        hint = did_you_mean(name, [item.name for item in self._server.sensors.lights])
        return f"{service}: Requested light {name} not found!" + (f" {hint}" if hint else "")

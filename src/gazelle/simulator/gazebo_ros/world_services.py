"""Services about the world: pausing, resetting and physics."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gazelle.description.model import Light
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import message_type
from gazelle.simulator.gazebo_ros.model_services import Row
from gazelle.simulator.gazebo_ros.physics_parameters import PhysicsParameters
from gazelle.simulator.input_validation import InputRefusedError

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["LightServices", "WorldServices"]


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


class WorldServices:
    """``pause_physics``, ``reset_world``, ``get_physics_properties`` and their kin."""

    def __init__(self, server: WorldServer, physics: PhysicsParameters) -> None:
        self._server = server
        self._physics = physics

    def rows(self) -> list[Row]:
        """Return the services below ``/gazebo``."""
        return [
            *self.ros2_rows(),
            Row("get_world_properties", "gazebo_msgs/GetWorldProperties", self._get_world),
            Row("get_physics_properties", "gazebo_msgs/GetPhysicsProperties", self._get_physics),
            Row("set_physics_properties", "gazebo_msgs/SetPhysicsProperties", self._set_physics),
            Row("get_state_hash", "std_srvs/Trigger", self._get_state_hash),
            Row("control_world", "ros_gz_interfaces/ControlWorld", self._control_world),
        ]

    def ros2_rows(self) -> list[Row]:
        """Return the services that ROS 2 offers at the root too."""
        server = self._server
        return [
            Row("pause_physics", "std_srvs/Empty", lambda request, response: server.pause()),
            Row("unpause_physics", "std_srvs/Empty", lambda request, response: server.unpause()),
            Row("reset_simulation", "std_srvs/Empty", lambda request, response: server.reset()),
            Row(
                "reset_world", "std_srvs/Empty", lambda request, response: server.reset(time=False)
            ),
        ]

    def _control_world(self, request: Any, response: Any) -> None:
        """Pause or not, and take steps; what ``gz world`` asks of Gazebo's world_control."""
        control = request.world_control
        if control.reset.all or control.reset.model_only:
            self._server.reset(time=bool(control.reset.all))
        self._server.paused = bool(control.pause)
        steps = int(control.multi_step) or int(control.step)
        if steps:
            self._server.step_in_command(steps)
        elif not control.pause:
            self._server.unpause()
        response.success = True

    def _get_world(self, request: Any, response: Any) -> None:
        response.sim_time = self._server.time_ns * 1e-9
        response.model_names = [model.name for model in self._server.engine.world.models]
        response.rendering_enabled = True
        response.success = True
        response.status_message = "GetWorldProperties: got properties"

    def _get_state_hash(self, request: Any, response: Any) -> None:
        response.success = True
        response.message = self._server.engine.state_hash()

    def _get_physics(self, request: Any, response: Any) -> None:
        values = self._physics.values
        response.time_step = float(values["time_step"])
        response.pause = self._server.paused
        response.max_update_rate = float(values["max_update_rate"])
        response.gravity.x = float(values["gravity_x"])
        response.gravity.y = float(values["gravity_y"])
        response.gravity.z = float(values["gravity_z"])
        for field in message_type("gazebo_msgs/ODEPhysics").FIELDS:
            setattr(response.ode_config, field.name, values[field.name])
        response.success = True
        response.status_message = "GetPhysicsProperties: got properties"

    def _set_physics(self, request: Any, response: Any) -> None:
        values: dict[str, Any] = {
            "time_step": float(request.time_step),
            "max_update_rate": float(request.max_update_rate),
            "gravity_x": float(request.gravity.x),
            "gravity_y": float(request.gravity.y),
            "gravity_z": float(request.gravity.z),
        }
        for field in message_type("gazebo_msgs/ODEPhysics").FIELDS:
            values[field.name] = getattr(request.ode_config, field.name)
        if problem := self._physics.problem_of(values):
            raise InputRefusedError(problem)
        idle = self._physics.set(values)
        response.success = True
        response.status_message = "physics engine updated"
        if idle:
            names = ", ".join(idle)
            response.status_message += f"; kept without effect, for ODE is not at work: {names}"

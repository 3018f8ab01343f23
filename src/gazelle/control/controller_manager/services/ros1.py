"""Services of ros_control's controller_manager (wiki: controller_manager, section 3)."""

from __future__ import annotations

from typing import Any

from gazelle.control.controller_manager.controller_manager import ControllerManager
from gazelle.control.controller_manager.controller_spec import ControllerRecord
from gazelle.control.controller_manager.services.requests import Actor
from gazelle.control.controller_node_interface import Ports
from gazelle.control.controllers.registry import known_types

__all__ = ["offer_ros1"]

_BASE_CLASS = "controller_interface::ControllerBase"
_STATE_INTERFACE = "hardware_interface::JointStateInterface"
_BEST_EFFORT, _STRICT = 1, 2


def offer_ros1(manager: ControllerManager, ports: Ports) -> None:
    """Offer the services below the ports' own name, ``controller_manager``."""
    services = _Services(manager, ports)
    for name, type_name, handler in (
        ("list_controllers", "ListControllers", services.list_controllers),
        ("list_controller_types", "ListControllerTypes", services.list_types),
        ("load_controller", "LoadController", services.load),
        ("unload_controller", "UnloadController", services.unload),
        ("switch_controller", "SwitchController", services.switch),
        ("reload_controller_libraries", "ReloadControllerLibraries", services.reload),
    ):
        ports.service(f"~/{name}", f"controller_manager_msgs/{type_name}", handler)


class _Services:
    def __init__(self, manager: ControllerManager, ports: Ports) -> None:
        self._manager = manager
        self._ports = ports
        self._actor = Actor(manager, ports)

    def list_controllers(self, request: Any, response: Any) -> None:
        response.controller = [self._state(one) for one in self._manager.controllers.values()]

    def list_types(self, request: Any, response: Any) -> None:
        response.types = list(known_types())
        response.base_classes = [_BASE_CLASS] * len(response.types)

    def load(self, request: Any, response: Any) -> None:
        response.ok = self._actor.done(lambda: self._manager.load(request.name))

    def unload(self, request: Any, response: Any) -> None:
        response.ok = self._actor.done(lambda: self._manager.unload(request.name))

    def switch(self, request: Any, response: Any) -> None:
        strictness = request.strictness
        if strictness not in (_BEST_EFFORT, _STRICT):
            text = "Controller Manager: To switch controllers you need to specify a strictness "
            text += f"level of controller_manager_msgs::SwitchController::STRICT ({_STRICT}) or "
            text += f"::BEST_EFFORT ({_BEST_EFFORT}). Defaulting to ::BEST_EFFORT."
            self._ports.log("warn", text)
        response.ok = self._actor.done(
            lambda: self._manager.switch(
                request.start_controllers, request.stop_controllers, strict=strictness == _STRICT
            )
        )

    def reload(self, request: Any, response: Any) -> None:
        response.ok = self._actor.done(lambda: self._manager.unload_all(force=request.force_kill))

    def _state(self, record: ControllerRecord) -> Any:
        from gazelle.interfaces import ros1_message_type

        state = ros1_message_type("controller_manager_msgs/ControllerState")
        claimed = ros1_message_type("controller_manager_msgs/HardwareInterfaceResources")
        return state(
            name=record.name,
            state=record.ros1_word,
            type=record.type,
            claimed_resources=[
                claimed(hardware_interface=interface, resources=joints)
                for interface, joints in self._resources(record).items()
            ],
        )

    def _resources(self, record: ControllerRecord) -> dict[str, list[str]]:
        """Return the joints a controller claims by ROS 1 hardware interface."""
        found: dict[str, list[str]] = {}
        for name in record.commands:
            joint, _, interface = name.rpartition("/")
            found.setdefault(self._interface(joint, interface), []).append(joint)
        return found or {_STATE_INTERFACE: []}

    def _interface(self, joint: str, interface: str) -> str:
        word = f"{interface.capitalize()}JointInterface"
        resource = self._manager.robot.joints.get(joint)
        names = () if resource is None else resource.hardware_interfaces
        found = next((name for name in names if name.endswith(word)), word)
        return "hardware_interface::" + found.replace("::", "/").rpartition("/")[2]

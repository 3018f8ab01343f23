"""Services of ros2_control's controller_manager, and its node's parameters."""

from __future__ import annotations

from typing import Any

from gazelle.control.controller_manager.controller_manager import ControllerManager
from gazelle.control.controller_manager.records import ControllerRecord, OwnedPorts
from gazelle.control.controller_manager.services.acting import Actor
from gazelle.control.controllers.registry import known_types
from gazelle.control.parameters import flattened
from gazelle.control.robot import HardwareComponent

__all__ = ["offer_ros2"]

_BASE_CLASS = "controller_interface::ControllerInterface"
_STRICT = 2
_ACTIVE = 3


def offer_ros2(manager: ControllerManager, ports: OwnedPorts) -> None:
    """Offer the services and parameters of the node ``controller_manager``."""
    services = _Services(manager, ports)
    for name, type_name, handler in (
        # Only ROS 2 has this one: whoever sees any of the others has seen it before.
        ("configure_controller", "ConfigureController", services.configure),
        ("list_controllers", "ListControllers", services.list_controllers),
        ("list_controller_types", "ListControllerTypes", services.list_types),
        ("list_hardware_components", "ListHardwareComponents", services.list_components),
        ("list_hardware_interfaces", "ListHardwareInterfaces", services.list_interfaces),
        ("load_controller", "LoadController", services.load),
        ("cleanup_controller", "CleanupController", services.cleanup),
        ("unload_controller", "UnloadController", services.unload),
        ("switch_controller", "SwitchController", services.switch),
        ("reload_controller_libraries", "ReloadControllerLibraries", services.reload),
        ("set_hardware_component_state", "SetHardwareComponentState", services.set_component),
    ):
        ports.service(f"~/{name}", f"controller_manager_msgs/{type_name}", handler)
    values = dict(flattened(manager.source.manager_tree()))
    values.setdefault("update_rate", round(manager.update_rate_hz))
    ports.offer_parameters(values, services.set_parameters)


class _Services:
    def __init__(self, manager: ControllerManager, ports: OwnedPorts) -> None:
        self._manager = manager
        self._ports = ports
        self._actor = Actor(manager, ports)

    def list_controllers(self, request: Any, response: Any) -> None:
        response.controller = [_state(one) for one in self._manager.controllers.values()]

    def list_types(self, request: Any, response: Any) -> None:
        response.types = list(known_types())
        response.base_classes = [_BASE_CLASS] * len(response.types)

    def list_components(self, request: Any, response: Any) -> None:
        components = self._manager.robot.components
        response.component = [self._component(one) for one in components]

    def list_interfaces(self, request: Any, response: Any) -> None:
        bank = self._manager.robot.bank
        response.command_interfaces = self._interfaces(bank.command_index)
        response.state_interfaces = [_interface(name, claimed=False) for name in bank.state_index]

    def load(self, request: Any, response: Any) -> None:
        self._ports.log("info", f"Loading controller '{request.name}'")
        response.ok = self._actor.done(lambda: self._manager.load(request.name))

    def configure(self, request: Any, response: Any) -> None:
        self._ports.log("info", f"Configuring controller '{request.name}'")
        response.ok = self._actor.done(lambda: self._manager.configure(request.name))

    def cleanup(self, request: Any, response: Any) -> None:
        response.ok = self._actor.done(lambda: self._manager.cleanup(request.name))

    def unload(self, request: Any, response: Any) -> None:
        response.ok = self._actor.done(lambda: self._manager.unload(request.name))

    def switch(self, request: Any, response: Any) -> None:
        start, stop = _switched(request)
        notes: list[str] = []

        def act() -> None:
            notes.extend(self._manager.switch(start, stop, strict=request.strictness == _STRICT))

        reason = self._actor.attempt(act)
        for text in notes:
            self._ports.log("warn", text)
        if reason:
            self._ports.log("error", reason)
        elif start or stop:
            self._ports.log("info", _switch_text(start, stop))
        response.ok = not reason
        done = "; ".join(notes) or "Successfully switched controllers!"
        if hasattr(response, "message"):
            response.message = reason or done

    def reload(self, request: Any, response: Any) -> None:
        response.ok = self._actor.done(lambda: self._manager.unload_all(force=request.force_kill))

    def set_component(self, request: Any, response: Any) -> None:
        """Simulated hardware is always active; other states are refused."""
        names = [one.name for one in self._manager.robot.components]
        wanted = request.target_state.label or request.target_state.id
        response.state.id, response.state.label = _ACTIVE, "active"
        if request.name not in names:
            text = f"hardware component with name '{request.name}' does not exist; there are: "
            self._ports.log("error", text + (", ".join(names) or "none"))
            response.ok = False
        elif wanted in ("active", _ACTIVE):
            response.ok = True
        else:
            text = f"hardware component '{request.name}' stays active: simulated hardware has no "
            self._ports.log("error", f"{text}state '{wanted}'")
            response.ok = False

    def set_parameters(self, values: dict[str, Any]) -> str:
        """Take types and parameter files of controllers that are to be loaded."""
        for key, value in values.items():
            if key == "update_rate":
                return "update_rate cannot be changed while the controller manager runs"
            self._manager.source.set("", key, value)
        return ""

    def _claimed(self) -> frozenset[str]:
        active = (one for one in self._manager.controllers.values() if one.is_active)
        return frozenset(name for record in active for name in record.commands)

    def _interfaces(self, names: Any) -> list[Any]:
        claimed = self._claimed()
        return [_interface(name, claimed=name in claimed) for name in names]

    def _component(self, component: HardwareComponent) -> Any:
        robot = self._manager.robot
        joints = {joint.name for joint in component.joints}
        everywhere = {joint.name for one in robot.components for joint in one.joints}
        # Sensors that stand in no block of their own belong to the first component.
        is_first = component is robot.components[0]

        def own(name: str) -> bool:
            owner = name.rpartition("/")[0]
            return owner in joints or (is_first and owner not in everywhere)

        message = _message("HardwareComponentState")(
            name=component.name,
            type=component.type,
            class_type=component.plugin,
            plugin_name=component.plugin,
            rw_rate=round(self._manager.update_rate_hz),
            command_interfaces=self._interfaces(filter(own, robot.bank.command_index)),
            state_interfaces=[
                _interface(name, claimed=False) for name in filter(own, robot.bank.state_index)
            ],
        )
        message.state.id, message.state.label = _ACTIVE, "active"
        return message


def _switched(request: Any) -> tuple[list[str], list[str]]:
    """Return what to start and stop; Foxy's field names are understood."""
    start = getattr(request, "activate_controllers", None)
    stop = getattr(request, "deactivate_controllers", None)
    if start is None or stop is None:
        start, stop = request.start_controllers, request.stop_controllers
    return list(start), list(stop)


def _switch_text(start: list[str], stop: list[str]) -> str:
    parts = [f"Activating controllers: [ {' '.join(start)} ]"] if start else []
    parts += [f"Deactivating controllers: [ {' '.join(stop)} ]"] if stop else []
    return "; ".join([*parts, "Successfully switched controllers!"])


def _state(record: ControllerRecord) -> Any:
    return _message("ControllerState")(
        name=record.name,
        state=str(record.state),
        type=record.type,
        update_rate=round(record.update_rate_hz),
        claimed_interfaces=list(record.commands) if record.is_active else [],
        required_command_interfaces=list(record.commands),
        required_state_interfaces=list(record.states),
    )


def _interface(name: str, *, claimed: bool) -> Any:
    return _message("HardwareInterface")(
        name=name, data_type="double", is_available=True, is_claimed=claimed
    )


def _message(name: str) -> Any:
    from gazelle.interfaces import message_type

    return message_type(f"controller_manager_msgs/{name}")

"""Services of ros2_control's controller_manager, and its node's parameters."""

from __future__ import annotations

from typing import Any

from gazelle.control.controller_manager.controller_manager import ControllerManager
from gazelle.control.controller_manager.controller_spec import ControllerRecord, OwnedPorts
from gazelle.control.controller_manager.services.requests import Actor
from gazelle.control.controllers.registry import known_types
from gazelle.control.hardware.lifecycle import HardwareState
from gazelle.control.resource_manager import HardwareComponent
from gazelle.diagnostics import did_you_mean
from gazelle.parameters.trees import flattened

__all__ = ["offer_ros2"]

_BASE_CLASS = "controller_interface::ControllerInterface"
_STRICT = 2


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
        interface_values = self._manager.robot.interface_values
        response.command_interfaces = self._interfaces(interface_values.command_index)
        response.state_interfaces = self._interfaces(
            interface_values.state_index, claimed=frozenset()
        )

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
        """Bring a component of the hardware into a state."""
        lifecycle = self._manager.robot.lifecycle
        names = [one.name for one in self._manager.robot.components]
        wanted = _wanted_state(request.target_state)
        response.ok = False
        if request.name not in names:
            hint = did_you_mean(request.name, names) or f"there are: {', '.join(names) or 'none'}"
            text = f"hardware component with name '{request.name}' does not exist; {hint}"
            self._ports.log("error", text)
            return
        if wanted is None:
            known = ", ".join(state.label for state in HardwareState)
            given = request.target_state.label or request.target_state.id
            text = f"hardware component '{request.name}': no state '{given}'; there are: {known}"
            self._ports.log("error", text)
        else:
            self._warn_of_users(request.name, wanted)
            response.ok = self._actor.done(lambda: lifecycle.set(request.name, wanted))
        state = lifecycle.state(request.name)
        response.state.id, response.state.label = int(state), state.label
        if response.ok:
            self._ports.log("info", f"Set component '{request.name}' to '{state.label}' state.")

    def _warn_of_users(self, component: str, wanted: HardwareState) -> None:
        """Say which running controllers lose their hardware, as its documentation warns of."""
        if wanted is HardwareState.ACTIVE:
            return
        owners = self._manager.robot.lifecycle.owners
        users = [
            record.name
            for record in self._manager.controllers.values()
            if record.is_active and any(owners.get(name) == component for name in record.commands)
        ]
        if users:
            text = f"hardware '{component}' is no longer active while controllers command it: "
            text += f"{', '.join(users)}; nothing of what they send reaches it"
            self._ports.log("warn", text)

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

    def _interfaces(self, names: Any, *, claimed: frozenset[str] | None = None) -> list[Any]:
        taken = self._claimed() if claimed is None else claimed
        lifecycle = self._manager.robot.lifecycle
        return [
            _interface(name, claimed=name in taken, available=lifecycle.is_available(name))
            for name in names
        ]

    def _component(self, component: HardwareComponent) -> Any:
        robot = self._manager.robot
        first = robot.components[0].name
        state = robot.lifecycle.state(component.name)

        def own(name: str) -> bool:
            return robot.lifecycle.owners.get(name, first) == component.name

        message = _message("HardwareComponentState")(
            name=component.name,
            type=component.type,
            class_type=component.plugin,
            plugin_name=component.plugin,
            rw_rate=round(self._manager.update_rate_hz),
            command_interfaces=self._interfaces(filter(own, robot.interface_values.command_index)),
            state_interfaces=self._interfaces(
                filter(own, robot.interface_values.state_index), claimed=frozenset()
            ),
        )
        message.state.id, message.state.label = int(state), state.label
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


def _wanted_state(given: Any) -> HardwareState | None:
    """Return the state that a request names by its label, else by its number."""
    for state in HardwareState:
        if given.label == state.label or (not given.label and given.id == state):
            return state
    return None


def _interface(name: str, *, claimed: bool, available: bool) -> Any:
    return _message("HardwareInterface")(
        name=name, data_type="double", is_available=available, is_claimed=claimed
    )


def _message(name: str) -> Any:
    from gazelle.interfaces import message_type

    return message_type(f"controller_manager_msgs/{name}")

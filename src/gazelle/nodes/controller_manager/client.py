"""Calls a controller manager's services, of ros_control or ros2_control."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from gazelle.diagnostics import nearest_names
from gazelle.errors import GraphError
from gazelle.graph import Entity, Graph, Kind, Node
from gazelle.graph.gazebo_names import is_loading
from gazelle.interfaces import message_type, ros1_service_type, service_type
from gazelle.interfaces.stamps import set_stamp

__all__ = ["ManagerClient"]

_POLL_S = 0.1
_CALL_S = 30.0
_GONE_S = 10.0
# A manager's services come one after the other.
_QUIET_S = 0.5
_LATE_S = 1.5
_LOAD = "/load_controller"
_PACKAGE = "controller_manager_msgs"
BEST_EFFORT, STRICT = 1, 2


class ManagerClient:
    """One controller manager as its users see it.

    Attributes:
        name: the manager's global name, such as ``/mira/controller_manager``.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        stop: threading.Event | None = None,
        *,
        ros_version: int = 0,
    ) -> None:
        """Take a node and the manager's name; nothing is called yet.

        Args:
            node: a started node of the graph.
            name: resolved by the node.
            stop: ends waiting early.
            ros_version: of the manager, where the program is of one; 0 when its services tell.
        """
        self.name = node.resolve_name(name)
        self._node = node
        self._stop = stop or threading.Event()
        self._ros_version = ros_version

    @property
    def ros_version(self) -> int:
        """1 for ros_control, 2 for ros2_control, told from the services; 0 when it is not there."""
        graph = self._node.graph
        if not self._ros_version and graph.has_service(f"{self.name}/load_controller"):
            own = f"{self.name}/configure_controller"
            is_ros2 = graph.discovery.settles(
                lambda known: any(one.kind is Kind.SERVICE and one.name == own for one in known),
                quiet_s=_QUIET_S,
            )
            self._ros_version = 2 if is_ros2 else 1
        return self._ros_version

    def wait(
        self,
        service: str = "load_controller",
        timeout_s: float | None = None,
        *,
        late: Callable[[], None] | None = None,
        late_s: float = 10.0,
    ) -> bool:
        """Wait until a service is offered.

        Args:
            service: below the manager's name.
            timeout_s: on the node's clock, so a paused simulation takes no time, and on the wall's
                while nobody publishes ``/clock``, unless a simulator is loading; None for ever.
            late: called again and again while it is not there, every `late_s` real seconds.
            late_s: see `late`.

        Returns:
            False when the time was up, or waiting was ended.

        Raises:
            GraphError: the graph itself is gone.
        """
        graph, clock = self._node.graph, self._node.clock
        start_ns, told_s = clock.now_ns(), time.monotonic()
        looked_s, without_clock_s = told_s, 0.0
        used_sim_time, alive = clock.use_sim_time, _Alive(graph)
        while not self._stop.is_set():
            if graph.wait_for_service(f"{self.name}/{service}", _POLL_S):
                return True
            alive.check()
            if clock.use_sim_time != used_sim_time or clock.now_ns() < start_ns:
                # Another clock, or one that went back: count anew.
                used_sim_time, start_ns = clock.use_sim_time, clock.now_ns()
            since_s, looked_s = time.monotonic() - looked_s, time.monotonic()
            without_clock = clock.use_sim_time and not graph.publisher_count("/clock")
            if without_clock and not is_loading(graph):
                without_clock_s += since_s
            waited_s = max((clock.now_ns() - start_ns) * 1e-9, without_clock_s)
            if timeout_s is not None and waited_s > timeout_s:
                return False
            if late is not None and time.monotonic() - told_s > late_s:
                told_s = time.monotonic()
                late()
        return False

    def other_managers_text(self) -> str:
        """Return a sentence about the controller managers that there are."""
        found = self.managers()
        if not found:
            return (
                "there is no controller manager at all: the robot's description needs the plug-in "
                "libgazebo_ros_control.so or libgazebo_ros2_control.so, and the robot must be "
                "spawned; without a simulation ros2_control_node must run"
            )
        nearest = nearest_names(self.name, found) or found
        return f"controller managers are: {', '.join(nearest)}"

    def managers(self) -> tuple[str, ...]:
        """Return the names of all controller managers of the graph."""
        names = (one.name for one in self._node.graph.services())
        return tuple(name.removesuffix(_LOAD) for name in names if name.endswith(_LOAD))

    def find(
        self,
        *,
        may_be_another: bool,
        late: Callable[[], None] = lambda: None,
        timeout_s: float | None = None,
    ) -> bool:
        """Wait for the manager, for commands that people type; what is waited for is said once.

        Args:
            may_be_another: take the only one there is when it has another name, and say so.
            late: called when the manager lets itself be waited for.
            timeout_s: in wall time; None for ever.

        Returns:
            False when waiting was ended, or the time was up.

        Raises:
            GraphError: the graph is gone.
        """
        said, start_s = "", time.monotonic()
        alive = _Alive(self._node.graph)
        while not self._stop.is_set():
            there = self.managers()
            if self.name in there:
                return True
            if may_be_another and len(there) == 1 and not self._comes():
                _tell(f"there is no {self.name}; {there[0]}, the only one there is, is used")
                self.name = there[0]
                return True
            text = f"waiting for {self.name}; {self.other_managers_text()}"
            if text != said and time.monotonic() - start_s > _LATE_S:
                said = text
                _tell(text)
                late()
            alive.check()
            if timeout_s is not None and time.monotonic() - start_s > timeout_s:
                return False
            self._stop.wait(_POLL_S)
        return False

    def _comes(self) -> bool:
        """Tell whether the manager, or one more, comes with what else comes to the graph."""
        return self._node.graph.discovery.settles(
            lambda known: (
                self.name in (found := {_manager_of(one) for one in known}) or len(found) > 2
            )
        )

    def call(self, service: str, kind: str, *, timeout_s: float = _CALL_S, **fields: Any) -> Any:
        """Call a service with the layout of the manager's generation and return its answer.

        Raises:
            GraphError: nobody answers.
        """
        name = f"{self.name}/{service}"
        full = kind if "/" in kind else f"{_PACKAGE}/{kind}"
        kind_class: Any = service_type(full)
        make = kind_class.Request
        if self.ros_version == 1 and full.startswith(_PACKAGE):
            kind_class = ros1_service_type(full)
            make = kind_class._request_class
        client, request = self._node.create_client(name, kind_class), make(**fields)
        try:
            return client.call(request, timeout_s=timeout_s)
        finally:
            client.unregister()

    def controllers(self) -> Sequence[Any]:
        """Return the loaded controllers as the manager lists them."""
        found: Sequence[Any] = self.call("list_controllers", "ListControllers").controller
        return found

    def load(self, name: str) -> bool:
        """Load a controller."""
        return bool(self.call("load_controller", "LoadController", name=name).ok)

    def configure(self, name: str) -> bool:
        """Configure a controller; ROS 1's are when they are loaded."""
        if self.ros_version == 1:
            return True
        return bool(self.call("configure_controller", "ConfigureController", name=name).ok)

    def unload(self, name: str, *, timeout_s: float = _CALL_S) -> bool:
        """Unload a controller."""
        answer = self.call("unload_controller", "UnloadController", name=name, timeout_s=timeout_s)
        return bool(answer.ok)

    def switch(
        self,
        start: Sequence[str] = (),
        stop: Sequence[str] = (),
        *,
        strictness: int = STRICT,
        asap: bool = False,
        switch_timeout_s: float = 0.0,
        timeout_s: float = _CALL_S,
    ) -> Any:
        """Start and stop controllers; the answer has ``ok``, ROS 2's a ``message`` too."""
        if self.ros_version == 1:
            fields: dict[str, Any] = {
                "start_controllers": list(start),
                "stop_controllers": list(stop),
                "start_asap": asap,
                "timeout": switch_timeout_s,
            }
        else:
            timeout = message_type("builtin_interfaces/Duration")()
            set_stamp(timeout, round(switch_timeout_s * 1e9))
            fields = {
                "activate_controllers": list(start),
                "deactivate_controllers": list(stop),
                "activate_asap": asap,
                "timeout": timeout,
            }
        return self.call(
            "switch_controller",
            "SwitchController",
            strictness=strictness,
            timeout_s=timeout_s,
            **fields,
        )

    def set_parameters(self, values: Mapping[str, Any]) -> str:
        """Set parameters of a ROS 2 manager; return why that failed, empty when it did not.

        Raises:
            GraphError: nobody answers.
        """
        from gazelle.graph.ros2_parameter_values import value_message

        parameter = message_type("rcl_interfaces/Parameter")
        request = [parameter(name=key, value=value_message(value)) for key, value in values.items()]
        if not self.wait("set_parameters", _CALL_S):
            raise GraphError(f"Could not contact service {self.name}/set_parameters")
        answer = self.call("set_parameters", "rcl_interfaces/SetParameters", parameters=request)
        return next((one.reason or "refused" for one in answer.results if not one.successful), "")


class _Alive:
    """Watches that the graph has a hub."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._seen_s = time.monotonic()

    def check(self) -> None:
        """Look.

        Raises:
            GraphError: there has been no hub for some seconds.
        """
        now_s = time.monotonic()
        if self._graph.is_hub or self._graph.session.info.routers_zid():
            self._seen_s = now_s
        elif now_s - self._seen_s > _GONE_S:
            raise GraphError("the graph has ended: its launch or simulator is gone")


def _manager_of(one: Entity) -> str:
    """Return the manager that an entity is the service of, an empty name for none."""
    is_one = one.kind is Kind.SERVICE and one.name.endswith(_LOAD)
    return one.name.removesuffix(_LOAD) if is_one else ""


def _tell(text: str) -> None:
    sys.stderr.write(f"{text}\n")
    sys.stderr.flush()

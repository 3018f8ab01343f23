"""What controllers need of the outside world, over the simulator's node."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from gazelle.control.controller_node_interface import (
    GoalPort,
    LiveParameter,
    LivePort,
    PublisherPort,
)
from gazelle.graph.actions import ActionServer, ActionTiming
from gazelle.graph.ros2_node_parameters import NodeParameters, ParameterPolicy
from gazelle.simulator.plugins.context import Host, Resources, join_names
from gazelle.simulator.plugins.dynamic_reconfigure import DynamicParameter, DynamicParameters
from gazelle.simulator.scheduler import ORDER_CONTROL, period_in_steps

if TYPE_CHECKING:
    from gazelle.control.controller_manager import ControllerManager

__all__ = ["ControllerPorts", "make_ports", "offer_manager"]

# Services of ROS 1 and ROS 2 under these packages share their names only.
_OWN_LAYOUT = frozenset({"controller_manager_msgs"})
_STATUS_HZ = 5.0

Remappings = Sequence[tuple[str, str]]


def make_ports(
    host: Host,
    resources: Resources,
    namespace: str,
    controller_name: str,
    ros_version: int,
    remappings: Remappings = (),
) -> ControllerPorts:
    """Open the ports of one controller.

    Args:
        host: the world.
        resources: of the model; they close the ports, if the manager did not before.
        namespace: of the controller manager.
        controller_name: relative to it.
        ros_version: 1 or 2.
        remappings: rules of ROS 2's ``<ros>`` block, names as written and what to use instead.
    """
    ports = ControllerPorts(host, namespace, controller_name, ros_version, remappings)
    resources.on_close(ports.close)
    return ports


def offer_manager(
    manager: ControllerManager,
    host: Host,
    resources: Resources,
    *,
    name: str = "controller_manager",
    remappings: Remappings = (),
) -> None:
    """Offer a manager's services, and let it be found by programs of this process."""
    from gazelle.control.controller_manager.services import offer_ros1, offer_ros2

    ros_version = manager.robot.ros_version
    ports = make_ports(host, resources, manager.namespace, name, ros_version, remappings)
    with host.node.announced_together():
        if ros_version == 1:
            offer_ros1(manager, ports)
        else:
            offer_ros2(manager, ports)
    managers = host.controls.managers
    managers[manager.namespace] = manager

    def close() -> None:
        manager.close()
        if managers.get(manager.namespace) is manager:
            del managers[manager.namespace]

    resources.on_close(close)


class ControllerPorts:
    """The `OwnedPorts` of one controller, closed when it is unloaded."""

    def __init__(
        self, host: Host, namespace: str, name: str, ros_version: int, remappings: Remappings
    ) -> None:
        self._host = host
        self._resources = Resources(host)
        self._namespace = join_names("/", namespace)
        self._name = name
        self._node_name = join_names(self._namespace, name)
        self._ros_version = ros_version
        self._remappings = [(self._resolve(a), self._resolve(b)) for a, b in remappings]
        self._groups: dict[str, _LiveGroup] = {}

    def publisher(
        self, topic: str, type_name: str, *, latch: bool = False, reliable: bool = True
    ) -> PublisherPort:
        """Offer a topic."""
        name = self._full(topic)
        return self._resources.publisher(name, type_name, latch=latch, reliable=reliable)

    def subscription(
        self, topic: str, type_name: str | Sequence[str], callback: Callable[[Any], None]
    ) -> None:
        """Listen; of several types all are taken, and the first one is announced.

        Controllers know themselves what NaN means to them: mostly no command for one joint.
        """
        name = self._full(topic)
        if isinstance(type_name, str):
            self._resources.subscription(name, type_name, callback, takes_any_number=True)
            return
        types = [_full_type(one) for one in type_name]
        refused: set[str] = set()

        def take(message: Any) -> None:
            found = _full_type(getattr(message, "TYPE_NAME", "") or message._type)
            if found in types:
                callback(message)
            elif found not in refused:
                refused.add(found)
                self.log("warn", f"{name}: messages of type {found} are not taken, {types} are")

        self._resources.subscription(name, None, take, announced=types[0], takes_any_number=True)

    def service(self, name: str, type_name: str, handler: Callable[[Any, Any], None]) -> None:
        """Answer a service; a ROS 1 manager's have ROS 1's layout."""
        if self._ros_version != 1 or type_name.partition("/")[0] not in _OWN_LAYOUT:
            self._resources.service(self._full(name), type_name, handler)
            return
        from gazelle.interfaces import ros1_service_type

        service = ros1_service_type(type_name)

        def answer(request: Any) -> Any:
            response = service._response_class()
            self._host.commands.call(lambda: handler(request, response))
            return response

        made = self._host.node.create_service(self._full(name), service, answer)
        self._resources.on_close(made.unregister)

    def action_server(
        self,
        name: str,
        type_name: str,
        *,
        on_goal: Callable[[GoalPort], None],
        on_cancel: Callable[[GoalPort], bool],
    ) -> None:
        """Offer an action; its callbacks run between two steps."""
        host, actions = self._host, self._host.controls.actions
        server = ActionServer(
            host.node,
            self._full(name),
            type_name,
            on_goal=on_goal,
            on_cancel=on_cancel,
            ros_version=1 if self._ros_version == 1 else 2,
            run=host.commands.post,
            timing=ActionTiming(now_ns=lambda: host.engine.time_ns, status_hz=_STATUS_HZ),
        )
        actions[server.name] = server
        if self._ros_version == 1:
            period: Fraction = period_in_steps(_STATUS_HZ, host.engine.step_ns)
            self._resources.task(f"{server.name} status", period, server.tick, order=ORDER_CONTROL)

        def close() -> None:
            server.close()
            if actions.get(server.name) is server:
                del actions[server.name]

        self._resources.on_close(close)

    def live_parameters(
        self,
        group: str,
        parameters: Sequence[LiveParameter],
        on_change: Callable[[dict[str, Any]], None],
    ) -> LivePort:
        """Let others change parameters: dynamic_reconfigure, or parameters of the node."""
        if self._ros_version == 1:
            return self._reconfigure(group, parameters, on_change)
        made = _LiveGroup(group, {row.name: row.value for row in parameters}, on_change)
        self._groups[group] = made
        return made

    def log(self, level: str, text: str) -> None:
        """Say something on the console and on ``/rosout``."""
        self._host.node.log(level, text if self._name in text else f"[{self._name}] {text}")

    def offer_parameters(
        self, values: Mapping[str, Any], on_set: Callable[[dict[str, Any]], str]
    ) -> None:
        """Show parameters as those of a ROS 2 node; ROS 1 has its parameter store."""
        if self._ros_version == 1:
            return
        groups = self._groups

        def take(changes: dict[str, Any]) -> str:
            rest: dict[str, Any] = {}
            changed: dict[str, dict[str, Any]] = {}
            for key, value in changes.items():
                prefix, _, name = key.rpartition(".")
                if prefix in groups and name in groups[prefix].values:
                    changed.setdefault(prefix, {})[name] = value
                else:
                    rest[key] = value
            reason = on_set(rest) if rest else ""
            if not reason:
                for prefix, new in changed.items():
                    groups[prefix].change(new)
            return reason

        live = {f"{g.name}.{k}": v for g in groups.values() for k, v in g.values.items()}
        offered = NodeParameters(
            self._host.node,
            self._node_name,
            {**{key: value for key, value in values.items() if value is not None}, **live},
            take,
            policy=ParameterPolicy(allow_undeclared=True),
            run=self._host.commands.call,
            now_ns=lambda: self._host.engine.time_ns,
        )
        for group in groups.values():
            group.offered = offered
        self._resources.on_close(offered.close)

    def close(self) -> None:
        """Take everything of the controller off the graph; closing twice does nothing."""
        self._resources.close()

    def _reconfigure(
        self,
        group: str,
        parameters: Sequence[LiveParameter],
        on_change: Callable[[dict[str, Any]], None],
    ) -> LivePort:
        rows = [
            DynamicParameter(
                row.name, row.kind, row.value, row.description, row.lowest, row.highest
            )
            for row in parameters
        ]
        namespace = join_names(self._node_name, group)
        served = DynamicParameters(
            self._resources,
            self._host,
            namespace,
            rows,
            changed=lambda values: on_change(dict(values)),
            # The controller has read the store already, by rules of its own.
            reads_store=False,
        )
        return _Reconfigured(served)

    def _full(self, name: str) -> str:
        full = self._resolve(name)
        return next((target for source, target in self._remappings if source == full), full)

    def _resolve(self, name: str) -> str:
        if name.startswith("~"):
            return join_names(self._node_name, name[1:].lstrip("/"))
        return join_names(self._namespace, name)


class _Reconfigured:
    """Live parameters of dynamic_reconfigure."""

    def __init__(self, served: DynamicParameters) -> None:
        self._served = served

    def update(self, values: Mapping[str, Any]) -> None:
        self._served.values.update(values)
        self._served.announce()


class _LiveGroup:
    """Live parameters ``<group>.<name>`` of a ROS 2 controller's node."""

    def __init__(
        self, name: str, values: dict[str, Any], on_change: Callable[[dict[str, Any]], None]
    ) -> None:
        self.name = name
        self.values = values
        self.offered: NodeParameters | None = None
        self._on_change = on_change

    def change(self, new: Mapping[str, Any]) -> None:
        """Take over values that somebody has set."""
        self.values.update(new)
        self._on_change(dict(self.values))

    def update(self, values: Mapping[str, Any]) -> None:
        """Tell others values that changed by themselves."""
        self.values.update(values)
        if self.offered is not None:
            self.offered.update({f"{self.name}.{key}": value for key, value in values.items()})


def _full_type(name: str) -> str:
    parts = name.split("/")
    return "/".join((parts[0], "msg", parts[-1]))

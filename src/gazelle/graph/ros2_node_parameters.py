"""The parameters of a ROS 2 node, offered to others as rclcpp and rclpy do."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

from gazelle.diagnostics import did_you_mean
from gazelle.graph import type_support
from gazelle.graph.ros2_parameter_values import (
    ParameterType,
    parameter_type,
    value_from_message,
    value_message,
)
from gazelle.interfaces.stamps import set_stamp

__all__ = ["Descriptor", "NodeParameters", "ParameterPolicy"]


class _Closable(Protocol):
    def unregister(self) -> None: ...


class _Publisher(_Closable, Protocol):
    def publish(self, message: Any) -> None: ...


class _Node(Protocol):
    def announced_together(self) -> AbstractContextManager[None]: ...
    def create_publisher(self, topic: str, message_type: Any) -> _Publisher: ...
    def create_service(
        self, name: str, service_type: Any, handler: Callable[[Any], Any]
    ) -> _Closable: ...


@dataclass(frozen=True, slots=True)
class Descriptor:
    """What is said about one parameter.

    Attributes:
        read_only: it cannot be set.
        dynamic_typing: it may change its type.
        lowest, highest: range of a number, both or none.
    """

    description: str = ""
    read_only: bool = False
    dynamic_typing: bool = False
    lowest: float | None = None
    highest: float | None = None

    def allows(self, value: Any) -> bool:
        """Tell whether a value is within the range."""
        if self.lowest is None or self.highest is None:
            return True
        return isinstance(value, int | float) and self.lowest <= value <= self.highest


_PLAIN = Descriptor()


class ParameterPolicy(NamedTuple):
    """What others may do with the parameters of a node.

    Attributes:
        allow_undeclared: setting a name that is not declared declares it.
        is_strict: 3 is refused for 3.0, in rclpy's words.
        has_services: others can ask and set; changes are told in any case.
    """

    allow_undeclared: bool = False
    is_strict: bool = False
    has_services: bool = True


_USUAL_POLICY = ParameterPolicy()


def _at_once(command: Callable[[], Any]) -> Any:
    return command()


class NodeParameters:
    """Parameters of one node with the six services and ``/parameter_events``.

    Attributes:
        values: present values by name, with dots.
        node_name: global name of the node they belong to.
    """

    def __init__(
        self,
        node: _Node,
        node_name: str,
        values: Mapping[str, Any],
        on_set: Callable[[dict[str, Any]], str] = lambda changes: "",
        *,
        descriptors: Mapping[str, Descriptor] | None = None,
        policy: ParameterPolicy = _USUAL_POLICY,
        run: Callable[[Callable[[], Any]], Any] = _at_once,
        now_ns: Callable[[], int] = lambda: 0,
    ) -> None:
        """Offer the services.

        Args:
            node: creates them; need not have the same name.
            node_name: global name, such as ``/arm_controller``.
            values: declared parameters.
            on_set: hears changes before they count; returns why they are refused, or nothing.
            descriptors: what is said about them.
            policy: what others may do with them.
            run: runs a request's work, for example in the thread that owns the parameters.
            now_ns: stamp of events.
        """
        self.node_name = node_name
        self.values: dict[str, Any] = dict(values)
        self._descriptors = dict(descriptors or {})
        self._on_set = on_set
        self._policy = policy
        self._now_ns = now_ns
        self._closables: list[_Closable] = []
        with node.announced_together():
            self._events = node.create_publisher("/parameter_events", _message("ParameterEvent"))
            self._closables.append(self._events)
            if policy.has_services:
                self._offer(node, run)

    def declare(self, name: str, value: Any, descriptor: Descriptor = _PLAIN) -> None:
        """Add a parameter and tell others."""
        self.values[name] = value
        self._descriptors[name] = descriptor
        self._announce({name: value}, new=True)

    def undeclare(self, name: str) -> None:
        """Remove a parameter and tell others."""
        value = self.values.pop(name)
        self._descriptors.pop(name, None)
        self._announce({name: value}, deleted=True)

    def descriptor(self, name: str) -> Descriptor:
        """Return what is said about a parameter."""
        return self._descriptors.get(name, _PLAIN)

    def set(self, changes: Mapping[str, Any]) -> str:
        """Set several parameters together; returns why that is refused, empty when it is done."""
        taken: dict[str, Any] = {}
        for name, value in changes.items():
            reason, taken[name] = self._checked(name, value)
            if reason:
                return reason
        reason = self._on_set(taken)
        if reason:
            return reason
        new = {name: value for name, value in taken.items() if name not in self.values}
        self.values.update(taken)
        self._announce({k: v for k, v in taken.items() if k not in new})
        self._announce(new, new=True)
        return ""

    def update(self, values: Mapping[str, Any]) -> None:
        """Take over values that changed by themselves and tell others."""
        self.values.update(values)
        self._announce(dict(values))

    def close(self) -> None:
        """Withdraw the services; closing twice does nothing."""
        while self._closables:
            self._closables.pop().unregister()

    def _offer(self, node: _Node, run: Callable[[Callable[[], Any]], Any]) -> None:
        for name, kind, handler in (
            ("get_parameters", "GetParameters", self._get),
            ("set_parameters", "SetParameters", self._set),
            ("set_parameters_atomically", "SetParametersAtomically", self._set_together),
            ("list_parameters", "ListParameters", self.list_into),
            ("describe_parameters", "DescribeParameters", self._describe),
            ("get_parameter_types", "GetParameterTypes", self._types),
        ):
            self._serve(node, name, kind, handler, run)

    def _checked(self, name: str, value: Any) -> tuple[str, Any]:
        """Return why a value is refused, and the value in the parameter's type."""
        if name not in self.values:
            if self._policy.allow_undeclared:
                return "", value
            hint = did_you_mean(name, self.values)
            return f"parameter '{name}' cannot be set because it was not declared; {hint}", value
        known = self.descriptor(name)
        if known.read_only:
            return f"parameter '{name}' cannot be set because it is read-only", value
        now = parameter_type(self.values[name])
        value = value if self._policy.is_strict else _widened(value, now)
        wanted = now if now.check(value) else parameter_type(value)
        if wanted is not now and not known.dynamic_typing and now is not ParameterType.NOT_SET:
            if self._policy.is_strict:
                return f"Wrong parameter type, expected '{now}' got '{wanted}'", value
            text = f"Wrong parameter type, parameter {{{name}}} is of type {{{now.word}}}, setting"
            return f"{text} it to {{{wanted.word}}} is not allowed.", value
        if not known.allows(value):
            low, high = known.lowest, known.highest
            return f"Parameter {{{name}}} doesn't comply with range [{low:g}, {high:g}].", value
        return "", value

    def _serve(
        self,
        node: _Node,
        name: str,
        kind: str,
        handler: Callable[[Any, Any], None],
        run: Callable[[Callable[[], Any]], Any],
    ) -> None:
        from gazelle.interfaces import service_type

        service = service_type(f"rcl_interfaces/{kind}")

        def answer(request: Any) -> Any:
            response = service.Response()
            run(lambda: handler(request, response))
            return response

        self._closables.append(node.create_service(f"{self.node_name}/{name}", service, answer))

    def _get(self, request: Any, response: Any) -> None:
        response.values = [value_message(self.values.get(name)) for name in request.names]

    def _set(self, request: Any, response: Any) -> None:
        for item in request.parameters:
            reason = self.set({item.name: value_from_message(item.value)})
            response.results.append(_result(reason))

    def _set_together(self, request: Any, response: Any) -> None:
        changes = {item.name: value_from_message(item.value) for item in request.parameters}
        response.result = _result(self.set(changes))

    def list_into(self, request: Any, response: Any) -> None:
        """Put names into a ``ListParameters`` response as its request asks."""
        names = [name for name in sorted(self.values) if _listed(name, request)]
        response.result.names = names
        prefixes = {name.rpartition(".")[0] for name in names if "." in name}
        response.result.prefixes = sorted(prefixes)

    def _describe(self, request: Any, response: Any) -> None:
        response.descriptors = [self._descriptor_message(name) for name in request.names]

    def _types(self, request: Any, response: Any) -> None:
        found = [int(parameter_type(self.values.get(name))) for name in request.names]
        response.types = found

    def _descriptor_message(self, name: str) -> Any:
        known, kind = self.descriptor(name), parameter_type(self.values.get(name))
        message = _message("ParameterDescriptor")(
            name=name,
            type=int(kind),
            description=known.description,
            read_only=known.read_only,
            dynamic_typing=known.dynamic_typing,
        )
        if known.lowest is not None and known.highest is not None:
            if kind is ParameterType.INTEGER:
                limits = _message("IntegerRange")
                row = limits(from_value=int(known.lowest), to_value=int(known.highest), step=0)
                message.integer_range = [row]
            else:
                limits = _message("FloatingPointRange")
                row = limits(from_value=known.lowest, to_value=known.highest, step=0.0)
                message.floating_point_range = [row]
        return message

    def _announce(
        self, values: Mapping[str, Any], *, new: bool = False, deleted: bool = False
    ) -> None:
        if not values:
            return
        event = _message("ParameterEvent")(node=self.node_name)
        set_stamp(event.stamp, self._now_ns())
        rows = [
            _message("Parameter")(name=name, value=value_message(value, for_writing=True))
            for name, value in values.items()
        ]
        kind = "deleted" if deleted else "new" if new else "changed"
        setattr(event, f"{kind}_parameters", rows)
        self._events.publish(event)


def _message(name: str) -> Any:
    return type_support.resolve_type(f"rcl_interfaces/msg/{name}")


def _result(reason: str) -> Any:
    return _message("SetParametersResult")(successful=not reason, reason=reason)


def _widened(value: Any, kind: ParameterType) -> Any:
    """Take 3 for 3.0 where a double is wanted: people write it so, rclcpp refuses it."""
    if kind is ParameterType.DOUBLE and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if kind is ParameterType.DOUBLE_ARRAY and isinstance(value, list):
        return [float(item) if type(item) is int else item for item in value]
    return value


def _listed(name: str, request: Any) -> bool:
    """Whether a name is below one of the prefixes and not deeper than asked for."""
    depth = int(request.depth)
    if not request.prefixes:
        return depth == 0 or name.count(".") < depth
    for prefix in request.prefixes:
        if name == prefix:
            return True
        rest = name.removeprefix(f"{prefix}.")
        if rest != name and (depth == 0 or rest.count(".") < depth):
            return True
    return False

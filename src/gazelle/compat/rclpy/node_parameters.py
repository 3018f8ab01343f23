"""The part of rclpy's `Node` that concerns parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from gazelle.compat.rclpy.exceptions import (
    InvalidParameterException,
    InvalidParameterTypeException,
    InvalidParameterValueException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from gazelle.compat.rclpy.parameter import Parameter
from gazelle.diagnostics import did_you_mean
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters
from gazelle.graph.ros2_parameter_values import value_from_message, value_message
from gazelle.interfaces import message_type, service_type

__all__ = ["ParameterHolder"]

_UNSET: Any = object()
Callback = Callable[[list[Parameter]], Any]


class ParameterHolder:
    """Declares, gets and sets parameters, and offers them to others."""

    _parameters: NodeParameters
    _rcl_overrides: dict[str, Any]
    _rcl_allow_undeclared: bool
    _rcl_uninitialized: dict[str, Parameter.Type]
    _rcl_pre_callbacks: list[Callback]
    _rcl_set_callbacks: list[Callback]
    _rcl_post_callbacks: list[Callback]

    def declare_parameter(
        self,
        name: str,
        value: Any = None,
        descriptor: Any = None,
        ignore_override: bool = False,
    ) -> Parameter:
        """Declare a parameter; what the command line and parameter files say counts more.

        Args:
            name: parts are separated by dots.
            value: the default, or a `Parameter.Type` for a value that must be given.
            descriptor: ``rcl_interfaces/msg/ParameterDescriptor``.
            ignore_override: keep the default whatever others say.

        Raises:
            ParameterAlreadyDeclaredException: it was declared before.
            InvalidParameterException: the name is empty.
            InvalidParameterValueException: the value was refused.
            InvalidParameterTypeException: the value given is of another type.
        """
        if not name or not isinstance(name, str):
            raise InvalidParameterException(str(name))
        if name in self._parameters.values or name in self._rcl_uninitialized:
            raise ParameterAlreadyDeclaredException([name])
        known = _descriptor(descriptor)
        wanted = value if isinstance(value, Parameter.Type) else None
        given = None if wanted is not None else value
        if not ignore_override and name in self._rcl_overrides:
            given = _fitting(name, self._rcl_overrides[name], value, known)
        elif wanted is not None:
            self._rcl_uninitialized[name] = wanted
            return Parameter(name)
        reason = self.__refusal([Parameter(name, value=given)])
        if reason:
            raise InvalidParameterValueException(name, given, reason)
        self._parameters.declare(name, given, known)
        return Parameter(name, value=given)

    def declare_parameters(
        self, namespace: str, parameters: Iterable[Any], ignore_override: bool = False
    ) -> list[Parameter]:
        """Declare several: names, (name, value) or (name, value, descriptor), below a prefix."""
        prefix = f"{namespace}." if namespace else ""
        found = []
        for item in parameters:
            name, *rest = (item,) if isinstance(item, str) else item
            value, descriptor = (*rest, None, None)[:2]
            found.append(self.declare_parameter(prefix + name, value, descriptor, ignore_override))
        return found

    def undeclare_parameter(self, name: str) -> None:
        """Remove a parameter.

        Raises:
            ParameterNotDeclaredException: there is none of the name.
            ParameterImmutableException: it is read-only.
        """
        if self._rcl_uninitialized.pop(name, None) is not None:
            return
        self.__check_declared(name)
        if self._parameters.descriptor(name).read_only:
            raise ParameterImmutableException(name)
        self._parameters.undeclare(name)

    def has_parameter(self, name: str) -> bool:
        """Tell whether it is declared."""
        return name in self._parameters.values or name in self._rcl_uninitialized

    def get_parameter(self, name: str) -> Parameter:
        """Return a parameter.

        Raises:
            ParameterNotDeclaredException: there is none of the name.
            ParameterUninitializedException: it was declared by type and has no value.
        """
        if name in self._rcl_uninitialized:
            raise ParameterUninitializedException(name)
        if name not in self._parameters.values and self._rcl_allow_undeclared:
            return Parameter(name)
        self.__check_declared(name)
        return Parameter(name, value=self._parameters.values[name])

    def get_parameters(self, names: Iterable[str]) -> list[Parameter]:
        """Return several parameters."""
        return [self.get_parameter(name) for name in names]

    def get_parameter_or(self, name: str, alternative_value: Any = None) -> Parameter:
        """Return a parameter, or another one when it is not there or not set."""
        if self._parameters.values.get(name) is None:
            return alternative_value or Parameter(name)
        return self.get_parameter(name)

    def get_parameter_type(self, name: str) -> Parameter.Type:
        """Return a parameter's type."""
        return self.get_parameter(name).type_

    def get_parameter_types(self, names: Iterable[str]) -> list[Parameter.Type]:
        """Return the types of several parameters."""
        return [self.get_parameter_type(name) for name in names]

    def get_parameters_by_prefix(self, prefix: str) -> dict[str, Parameter]:
        """Return the parameters below a prefix, their names without it."""
        start = f"{prefix}." if prefix else ""
        return {
            name.removeprefix(start): Parameter(name, value=value)
            for name, value in self._parameters.values.items()
            if name.startswith(start)
        }

    def set_parameters(self, parameter_list: list[Parameter]) -> list[Any]:
        """Set parameters one by one; a ``SetParametersResult`` for each.

        Raises:
            ParameterNotDeclaredException: one is not declared.
        """
        return [self.set_parameters_atomically([one]) for one in parameter_list]

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> Any:
        """Set all parameters or none; return ``SetParametersResult``.

        Raises:
            ParameterNotDeclaredException: one is not declared.
        """
        for callback in self._rcl_pre_callbacks:
            parameter_list = callback(parameter_list)
        for one in parameter_list:
            if one.name in self._rcl_uninitialized:
                self._parameters.declare(one.name, one.value)
                del self._rcl_uninitialized[one.name]
            if not self._rcl_allow_undeclared:
                self.__check_declared(one.name)
        reason = self._parameters.set({one.name: one.value for one in parameter_list})
        result = message_type("rcl_interfaces/msg/SetParametersResult")
        return result(successful=not reason, reason=reason)

    def list_parameters(self, prefixes: list[str], depth: int) -> Any:
        """Return ``rcl_interfaces/msg/ListParametersResult`` of names below prefixes."""
        kind = service_type("rcl_interfaces/srv/ListParameters")
        response = kind.Response()
        self._parameters.list_into(kind.Request(prefixes=prefixes, depth=depth), response)
        return response.result

    def set_descriptor(self, name: str, descriptor: Any, alternative_value: Any = None) -> Any:
        """Set what is said about a parameter; return its ``ParameterValue``.

        Args:
            name: a declared parameter.
            descriptor: ``rcl_interfaces/msg/ParameterDescriptor``.
            alternative_value: a ``ParameterValue`` for when the present one does not fit.

        Raises:
            ParameterNotDeclaredException: there is none of the name.
            ParameterImmutableException: it is read-only.
            InvalidParameterValueException: neither value fits.
        """
        self.__check_declared(name)
        if self._parameters.descriptor(name).read_only:
            raise ParameterImmutableException(name)
        known = _descriptor(descriptor)
        value = self._parameters.values[name]
        if not known.allows(value) and alternative_value is not None:
            value = value_from_message(alternative_value)
        if not known.allows(value):
            limits = f"[{known.lowest:g}, {known.highest:g}]"
            text = f"Parameter {{{name}}} doesn't comply with range {limits}."
            raise InvalidParameterValueException(name, value, text)
        self._parameters.declare(name, value, known)
        return value_message(value)

    def describe_parameter(self, name: str) -> Any:
        """Return ``rcl_interfaces/msg/ParameterDescriptor`` of a parameter."""
        self.__check_declared(name)
        return self._parameters._descriptor_message(name)

    def describe_parameters(self, names: Iterable[str]) -> list[Any]:
        """Return the descriptors of several parameters."""
        return [self.describe_parameter(name) for name in names]

    def add_pre_set_parameters_callback(self, callback: Callback) -> None:
        """Call something that may change what is to be set."""
        self._rcl_pre_callbacks.insert(0, callback)

    def add_on_set_parameters_callback(self, callback: Callback) -> None:
        """Call something that judges what is to be set, with a ``SetParametersResult``."""
        self._rcl_set_callbacks.insert(0, callback)

    def add_post_set_parameters_callback(self, callback: Callback) -> None:
        """Call something after parameters were set."""
        self._rcl_post_callbacks.insert(0, callback)

    def remove_on_set_parameters_callback(self, callback: Callback) -> None:
        """Ask a callback no more."""
        self._rcl_set_callbacks.remove(callback)

    def remove_pre_set_parameters_callback(self, callback: Callback) -> None:
        """Ask a callback no more."""
        self._rcl_pre_callbacks.remove(callback)

    def remove_post_set_parameters_callback(self, callback: Callback) -> None:
        """Tell a callback no more."""
        self._rcl_post_callbacks.remove(callback)

    def _rcl_on_set(self, changes: dict[str, Any]) -> str:
        """Judge a change from whomever; why it is refused, or nothing."""
        parameters = [Parameter(name, value=value) for name, value in changes.items()]
        reason = self.__refusal(parameters)
        if reason:
            return reason
        self._rcl_take_effect(changes)
        for callback in self._rcl_post_callbacks:
            callback(parameters)
        return ""

    def _rcl_take_effect(self, changes: dict[str, Any]) -> None:
        """Hear of values that count from now on."""

    def __refusal(self, parameters: list[Parameter]) -> str:
        for callback in self._rcl_set_callbacks:
            result = callback(parameters)
            if not result.successful:
                return str(result.reason) or "refused"
        return ""

    def __check_declared(self, name: str) -> None:
        if name not in self._parameters.values:
            raise ParameterNotDeclaredException([name], did_you_mean(name, self._parameters.values))


def _descriptor(message: Any) -> Descriptor:
    if message is None:
        return Descriptor()
    ranges = [*message.floating_point_range, *message.integer_range]
    return Descriptor(
        description=message.description,
        read_only=message.read_only,
        dynamic_typing=message.dynamic_typing,
        lowest=ranges[0].from_value if ranges else None,
        highest=ranges[0].to_value if ranges else None,
    )


def _fitting(name: str, given: Any, declared: Any, known: Descriptor) -> Any:
    """Return an override if it is of the declared type; 3 is no double, as in rclpy.

    Raises:
        InvalidParameterTypeException: it is of another type.
    """
    if declared is None or known.dynamic_typing:
        return given
    wanted = declared
    if not isinstance(declared, Parameter.Type):
        wanted = Parameter.Type.from_parameter_value(declared)
    if not wanted.check(given):
        kind = Parameter.Type.from_parameter_value(given).name
        raise InvalidParameterTypeException(name, given, given=kind, desired=wanted.name)
    return given

"""rclpy's exceptions (rclpy.exceptions), and those of executors."""

from __future__ import annotations

from typing import Any

__all__ = [
    "ExternalShutdownException",
    "InvalidHandle",
    "InvalidNamespaceException",
    "InvalidNodeNameException",
    "InvalidParameterException",
    "InvalidParameterTypeException",
    "InvalidParameterValueException",
    "InvalidServiceNameException",
    "InvalidTopicNameException",
    "NameValidationException",
    "NoTypeSupportImportedException",
    "NotInitializedException",
    "ParameterAlreadyDeclaredException",
    "ParameterException",
    "ParameterImmutableException",
    "ParameterNotDeclaredException",
    "ParameterUninitializedException",
    "ROSInterruptException",
    "ShutdownException",
    "TimeoutException",
    "TimerCancelledError",
]


class NotInitializedException(Exception):  # noqa: N818 - rclpy's name
    """`rclpy.init` has not been called."""

    def __init__(self, *args: object) -> None:
        super().__init__("rclpy.init() has not been called", *args)


class InvalidHandle(RuntimeError):  # noqa: N818 - rclpy's name
    """Something that was destroyed is used."""


class NoTypeSupportImportedException(Exception):  # noqa: N818 - rclpy's name
    """A type is none of ROS 2."""


class TimerCancelledError(Exception):
    """A timer was stopped while somebody waits for it."""


class NameValidationException(Exception):  # noqa: N818 - rclpy's name
    """A name is not legal; the text marks the character.

    Attributes:
        name_type: what it names, as ``topic name``.
        name: the name.
        error_msg: what is wrong.
        invalid_index: place of the first wrong character.
    """

    def __init__(self, name_type: str, name: str, error_msg: str, invalid_index: int) -> None:
        mark = " " * (invalid_index + 1) + "^"
        super().__init__(f"Invalid {name_type}: {error_msg}:\n  '{name}'\n  {mark}")
        self.name_type = name_type
        self.name = name
        self.error_msg = error_msg
        self.invalid_index = invalid_index


class InvalidNamespaceException(NameValidationException):
    """A namespace is not legal."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("namespace", name, error_msg, invalid_index)


class InvalidNodeNameException(NameValidationException):
    """A node's name is not legal."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("node name", name, error_msg, invalid_index)


class InvalidTopicNameException(NameValidationException):
    """A topic's name is not legal."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("topic name", name, error_msg, invalid_index)


class InvalidServiceNameException(NameValidationException):
    """A service's name is not legal."""

    def __init__(self, name: str, error_msg: str, invalid_index: int) -> None:
        super().__init__("service name", name, error_msg, invalid_index)


class TimeoutException(Exception):  # noqa: N818 - rclpy's name
    """Time was up."""


class ShutdownException(Exception):  # noqa: N818 - rclpy's name
    """The executor was shut down."""


class ExternalShutdownException(Exception):  # noqa: N818 - rclpy's name
    """The context was shut down while spinning."""


class ROSInterruptException(Exception):  # noqa: N818 - rclpy's name
    """The context was shut down during a sleep."""


class ParameterException(Exception):  # noqa: N818 - rclpy's name
    """Base of what concerns parameters."""

    def __init__(self, error_msg: str, parameters: Any, *args: object) -> None:
        super().__init__(f"{error_msg}: {parameters}", *args)


class ParameterNotDeclaredException(ParameterException):
    """A parameter is used that was not declared."""

    def __init__(self, parameters: Any, hint: str = "") -> None:
        shown = ", ".join(parameters)
        super().__init__("Invalid access to undeclared parameter(s)", shown)
        if hint:
            self.args = (f"{self.args[0]}; {hint}",)


class ParameterAlreadyDeclaredException(ParameterException):
    """A parameter is declared a second time."""

    def __init__(self, parameters: Any) -> None:
        super().__init__("Parameter(s) already declared", parameters)


class ParameterImmutableException(ParameterException):
    """A read-only parameter is set."""

    def __init__(self, parameters: Any) -> None:
        super().__init__("Attempted to modify read-only parameter(s)", parameters)


class ParameterUninitializedException(ParameterException):
    """A parameter was declared by type only and has no value yet."""

    def __init__(self, parameters: Any) -> None:
        super().__init__(f"The parameter '{parameters}' is not initialized", parameters)


class InvalidParameterException(ParameterException):
    """A parameter's name is not legal."""

    def __init__(self, parameters: Any) -> None:
        super().__init__("Invalid parameter name", parameters)


class InvalidParameterTypeException(ParameterException):
    """A parameter's value is of another type than declared."""

    def __init__(self, name: str, value: Any, *, given: str, desired: str) -> None:
        text = f"Trying to set parameter '{name}' to '{value}' of type '{given}'"
        super().__init__(f"{text}, expecting type '{desired}'", name)


class InvalidParameterValueException(ParameterException):
    """A parameter's value was refused."""

    def __init__(self, parameter: str, value: Any, reason: str) -> None:
        text = f"Invalid parameter value ({value}) for parameter. Reason: {reason}"
        super().__init__(text, parameter)

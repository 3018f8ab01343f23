"""rospy's exceptions (http://docs.ros.org/en/api/rospy/html/rospy.exceptions-module.html)."""

from __future__ import annotations

__all__ = [
    "ParameterInvalid",
    "ROSException",
    "ROSInitException",
    "ROSInternalException",
    "ROSInterruptException",
    "ROSSerializationException",
    "ROSTimeMovedBackwardsException",
    "ServiceException",
    "TransportException",
    "TransportInitError",
    "TransportTerminated",
    "UnknownServiceException",
]


class ROSException(Exception):  # noqa: N818 - rospy's name
    """Base of rospy's exceptions."""


class ROSInternalException(Exception):  # noqa: N818 - rospy's name
    """Base of exceptions that user code rarely sees."""


class ROSInitException(ROSException):
    """The node was used before `init_node`."""


class ROSSerializationException(ROSException):
    """A message does not fit its type."""


class ROSInterruptException(ROSException, KeyboardInterrupt):
    """A sleep or wait was cut short by the shutdown."""


class ROSTimeMovedBackwardsException(ROSInterruptException):
    """Simulated time went backwards during a sleep.

    Attributes:
        time: the jump in seconds, negative.
    """

    def __init__(self, time: float) -> None:
        self.time = time
        super().__init__("ROS time moved backwards")


class ServiceException(Exception):  # noqa: N818 - rospy's name
    """A service call failed."""


class UnknownServiceException(ServiceException):
    """There is no such service."""


class TransportException(ROSInternalException):
    """A connection failed."""


class TransportTerminated(TransportException):
    """A connection was closed."""


class TransportInitError(TransportException):
    """A connection could not be opened."""


class ParameterInvalid(Exception):  # noqa: N818 - rospy's name
    """A name or an address is not what it has to be (rospy.impl.validators)."""

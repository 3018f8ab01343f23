"""genpy: message base class, times and errors."""

from gazelle.interfaces import Duration, Time, TVal
from gazelle.interfaces import Ros1Message as Message


class MessageException(Exception):
    """Base of message errors."""


class DeserializationError(MessageException):
    """Bytes are no message of this type."""


class SerializationError(MessageException):
    """A field's value does not fit its type."""


__all__ = [
    "DeserializationError",
    "Duration",
    "Message",
    "MessageException",
    "SerializationError",
    "TVal",
    "Time",
]

"""genpy.message, by Gazelle."""

from genpy import DeserializationError, Message, MessageException, SerializationError

from gazelle.compat.genpy_message import fill_message_args, strify_message
from gazelle.compat.roslib import get_message_class, get_service_class

__all__ = [
    "DeserializationError",
    "Message",
    "MessageException",
    "SerializationError",
    "fill_message_args",
    "get_message_class",
    "get_service_class",
    "strify_message",
]

"""roslib.message."""

from genpy import Duration, Message, Time

from gazelle.compat.roslib import get_message_class, get_service_class

__all__ = ["Duration", "Message", "Time", "get_message_class", "get_service_class"]

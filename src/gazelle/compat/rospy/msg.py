"""Messages of ROS 1 as bytes, one after another with their lengths (rospy.msg)."""

from __future__ import annotations

import struct
from typing import Any, BinaryIO

from gazelle.compat.rospy.exceptions import ROSSerializationException
from gazelle.compat.rospy.topics import message_of as args_kwds_to_message
from gazelle.errors import GazelleError
from gazelle.interfaces import AnyMsg

__all__ = ["AnyMsg", "args_kwds_to_message", "deserialize_messages", "serialize_message"]

_LENGTH = struct.Struct("<I")


def serialize_message(b: BinaryIO, seq: int, msg: Any) -> None:
    """Write a message behind its length; a header gets the number.

    Raises:
        ROSSerializationException: a field's value does not fit its type.
    """
    if type(msg)._has_header:
        msg.header.seq = seq
    start = b.tell()
    b.seek(start + _LENGTH.size)
    try:
        msg.serialize(b)
    except (GazelleError, struct.error) as error:
        raise ROSSerializationException(str(error)) from error
    end = b.tell()
    b.seek(start)
    b.write(_LENGTH.pack(end - start - _LENGTH.size))
    b.seek(end)


def deserialize_messages(
    b: BinaryIO,
    msg_queue: list[Any],
    data_class: type[Any],
    queue_size: int | None = None,
    max_msgs: int | None = None,
    start: int = 0,
) -> None:
    """Move the whole messages that lie before the buffer's position to a list.

    Args:
        b: what has been received; what is left of it is moved to `start`.
        msg_queue: gets the messages.
        data_class: their class.
        queue_size: most messages of the list; the first ones go.
        max_msgs: most messages to take; None takes all.
        start: where the first one begins.
    """
    end = b.tell()
    b.seek(start)
    data = b.read(end - start)
    taken = 0
    found: list[bytes] = []
    while len(data) - taken >= _LENGTH.size and not (max_msgs and len(found) >= max_msgs):
        after = taken + _LENGTH.size + _LENGTH.unpack_from(data, taken)[0]
        if after > len(data):
            break
        found.append(data[taken + _LENGTH.size : after])
        taken = after
    kept = found if queue_size is None else found[-queue_size:]
    msg_queue.extend(data_class().deserialize(one) for one in kept)
    if queue_size is not None:
        del msg_queue[:-queue_size]
    b.seek(start)
    b.write(data[taken:])
    b.truncate()

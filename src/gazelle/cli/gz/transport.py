"""Topics of Gazebo Classic's own transport: their names, types and texts."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from gazelle.graph import TopicInfo
from gazelle.graph.gazebo_names import shown_transport_name

__all__ = ["contacts_fields", "gazebo_name", "gazebo_type", "transport_topics"]

_CONTACTS = "gazebo.msgs.Contacts"


def transport_topics(topics: Iterable[TopicInfo]) -> dict[str, TopicInfo]:
    """Return the topics of the transport by the names that Gazebo has for them."""
    named = ((shown_transport_name(one.name), one) for one in topics)
    return {name: one for name, one in named if name}


def gazebo_name(topic: TopicInfo) -> str:
    """Return a topic's name as ``gz topic`` shows it."""
    return shown_transport_name(topic.name) or topic.name


def gazebo_type(topic: TopicInfo) -> str:
    """Return a topic's type as ``gz topic -i`` shows it."""
    return _CONTACTS if shown_transport_name(topic.name) else topic.type_name


def contacts_fields(message: Any, topic: str) -> dict[str, Any]:
    """Return contacts as the fields of ``gazebo.msgs.Contacts``; there are no ids here."""
    time = _time(message.header.stamp)
    world = topic.split("/")[2] if topic.startswith("/gazebo/") else ""
    found = [_contact(one, time, world) for one in message.contacts]
    return {"contact": found, "time": time}


def _contact(contact: Any, time: dict[str, int], world: str) -> dict[str, Any]:
    return {
        "collision1": contact.collision1.name,
        "collision2": contact.collision2.name,
        "position": [_vector(one) for one in contact.positions],
        "normal": [_vector(one) for one in contact.normals],
        "depth": [float(one) for one in contact.depths],
        "wrench": [
            {
                "body_1_name": one.body_1_name.data,
                "body_2_name": one.body_2_name.data,
                "body_1_wrench": _wrench(one.body_1_wrench),
                "body_2_wrench": _wrench(one.body_2_wrench),
            }
            for one in contact.wrenches
        ],
        "time": time,
        "world": world,
    }


def _wrench(wrench: Any) -> dict[str, Any]:
    return {"force": _vector(wrench.force), "torque": _vector(wrench.torque)}


def _vector(vector: Any) -> dict[str, float]:
    return {"x": float(vector.x), "y": float(vector.y), "z": float(vector.z)}


def _time(stamp: Any) -> dict[str, int]:
    seconds = getattr(stamp, "secs", None)
    if seconds is None:
        return {"sec": int(stamp.sec), "nsec": int(stamp.nanosec)}
    return {"sec": int(seconds), "nsec": int(stamp.nsecs)}

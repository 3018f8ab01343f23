"""``joints.publish``: what the sliders of the joint panel say."""

from __future__ import annotations

from typing import Any

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_stamp
from gazelle.studio.errors import StudioError
from gazelle.studio.graph_view.publishing import Outbox
from gazelle.studio.request_params import Params

__all__ = ["publish_joints"]

_TOPIC = "/joint_states"


def publish_joints(outbox: Outbox, params: Params) -> dict[str, Any]:
    """``joints.publish``: one ``sensor_msgs/JointState`` of now."""
    names, positions = params.texts("names"), params.numbers("positions")
    if len(names) != len(positions):
        raise StudioError(f"{len(names)} names and {len(positions)} positions do not go together")
    message_class = message_type("sensor_msgs/msg/JointState")
    message = message_class(name=names, position=positions)
    stamp = message.header.stamp
    set_stamp(stamp, outbox.node.clock.now_ns())
    outbox.publisher(params.text("topic", _TOPIC), message_class).publish(message)
    return {}

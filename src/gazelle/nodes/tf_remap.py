"""``tf tf_remap``: publishes ``/tf_old`` as ``/tf`` with other names of frames (ROS 1).

``~mappings`` is a list of ``{old: FRAME, new: FRAME}``.
"""

from __future__ import annotations

import threading
from typing import Any

from gazelle.graph import Graph
from gazelle.interfaces import message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "run"]

PARAMETERS = ParameterTable(
    "tf_remap",
    "Publishes `/tf_old` as `/tf` with other names of frames.",
    ("tf/tf_remap",),
    (Parameter("mappings", "any", None, "other names: a list of `{old: FRAME, new: FRAME}`"),),
)

_KIND = "tf2_msgs/msg/TFMessage"
_QUEUE = 100


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Rename frames until told to stop."""
    node = start_node(arguments, graph)
    with private_parameters(node, arguments, PARAMETERS) as own:
        names = _names(own.raw("mappings"))
    shown = ", ".join(f"{old} → {new}" for old, new in names.items()) or "none"
    node.log("info", f"Applying the following mappings to incoming tf frame ids: {shown}")
    out = node.create_publisher("/tf", message_type(_KIND), queue_size=_QUEUE)

    def take(message: Any) -> None:
        for one in message.transforms:
            one.header.frame_id = names.get(one.header.frame_id, one.header.frame_id)
            one.child_frame_id = names.get(one.child_frame_id, one.child_frame_id)
        out.publish(message)

    node.create_subscription("/tf_old", _KIND, take, queue_size=_QUEUE)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


def _names(mappings: Any) -> dict[str, str]:
    """Return new names by old ones; entries without both are passed over, as tf does."""
    items = mappings if isinstance(mappings, list) else []
    return {
        str(item["old"]): str(item["new"])
        for item in items
        if isinstance(item, dict) and {"old", "new"} <= set(item)
    }

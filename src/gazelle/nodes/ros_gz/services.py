"""Services of worlds that ros_gz_bridge offers in ROS, by those of Gazelle's world."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.diagnostics import did_you_mean
from gazelle.errors import GraphError
from gazelle.graph import Node
from gazelle.graph.gazebo_names import SHOWN_SPACE, offered_name
from gazelle.interfaces import service_type
from gazelle.nodes.ros_gz.bridge_config import ServiceRow

__all__ = ["KINDS", "offer"]

_WAIT_S = 5.0


def offer(node: Node, row: ServiceRow) -> None:
    """Offer one service; what cannot be offered is logged."""
    forward = KINDS.get(row.ros_type)
    if forward is None:
        hint = did_you_mean(row.ros_type, KINDS) or f"there are {', '.join(sorted(KINDS))}"
        node.log("error", f"Failed to create a bridge for service [{row.ros_type}]; {hint}")
        return
    kind: Any = service_type(row.ros_type)

    def answer(request: Any) -> Any:
        response = kind.Response()
        try:
            response.success = forward(node, request)
        except GraphError as error:
            node.log("error", f"{row.name}: {error}")
            response.success = False
        return response

    node.create_service(row.name, kind, answer)
    node.log("info", f"Creating ROS->GZ service bridge [{row.name} ({row.ros_type})]")


def _control(node: Node, request: Any) -> bool:
    return bool(_call(node, "control_world", "ros_gz_interfaces/ControlWorld", request).success)


def _spawn(node: Node, request: Any) -> bool:
    from gazelle.nodes.ros_gz.models import model_text

    wanted = request.entity_factory
    kind = "gazebo_msgs/SpawnModel"
    fields = service_type(kind).Request(
        model_name=wanted.name,
        model_xml=wanted.sdf or model_text(wanted.sdf_filename),
        initial_pose=wanted.pose,
        reference_frame=wanted.relative_to,
    )
    return _said(node, _call(node, "spawn_sdf_model", kind, fields))


def _delete(node: Node, request: Any) -> bool:
    kind = "gazebo_msgs/DeleteModel"
    fields = service_type(kind).Request(model_name=request.entity.name)
    return _said(node, _call(node, "delete_model", kind, fields))


def _set_pose(node: Node, request: Any) -> bool:
    kind = "gazebo_msgs/SetModelState"
    fields = service_type(kind).Request()
    fields.model_state.model_name = request.entity.name
    fields.model_state.pose = request.pose
    return _said(node, _call(node, "set_model_state", kind, fields))


def _call(node: Node, name: str, kind: str, request: Any) -> Any:
    offered = offered_name(node.graph, f"{SHOWN_SPACE}/{name}", _WAIT_S)
    client = node.create_client(offered, service_type(kind))
    try:
        if not client.available:
            raise GraphError(f"no world answers at {SHOWN_SPACE}/{name}: is gz sim running?")
        return client.call(request, timeout_s=_WAIT_S)
    finally:
        client.unregister()


def _said(node: Node, answer: Any) -> bool:
    if not answer.success:
        node.log("error", str(answer.status_message))
    return bool(answer.success)


KINDS: dict[str, Callable[[Node, Any], bool]] = {
    "ros_gz_interfaces/srv/ControlWorld": _control,
    "ros_gz_interfaces/srv/DeleteEntity": _delete,
    "ros_gz_interfaces/srv/SetEntityPose": _set_pose,
    "ros_gz_interfaces/srv/SpawnEntity": _spawn,
}

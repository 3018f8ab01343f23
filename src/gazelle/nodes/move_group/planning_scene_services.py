"""Topics and services by which others see and change the planning scene."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.interfaces import service_type
from gazelle.nodes.move_group.context import MoveGroupContext
from gazelle.nodes.move_group.planning_scene_messages import Components

__all__ = ["offer_scene", "offer_scene_answers", "offer_scene_topics"]

_GET = "moveit_msgs/GetPlanningScene"
_APPLY = "moveit_msgs/ApplyPlanningScene"
_EMPTY = "std_srvs/Empty"


def offer_scene(context: MoveGroupContext) -> None:
    """Listen to the topics and offer the services."""
    node = context.node
    offer_scene_topics(context)
    offer_scene_answers(context)
    node.create_service("apply_planning_scene", service_type(_APPLY), lambda r: _apply(context, r))
    node.create_service("clear_octomap", service_type(_EMPTY), _cleared)
    node.create_subscription(
        "trajectory_execution_event", "std_msgs/msg/String", lambda m: _event(context, m)
    )


def offer_scene_answers(context: MoveGroupContext) -> None:
    """Offer the service that tells the scene."""
    kind = service_type(_GET)
    context.node.create_service("get_planning_scene", kind, lambda r: _get(context, r))


def offer_scene_topics(context: MoveGroupContext) -> None:
    """Listen to the topics."""
    node, monitor = context.node, context.monitor
    takers: tuple[tuple[str, str, Callable[[Any], object]], ...] = (
        ("planning_scene", "PlanningScene", monitor.apply),
        ("planning_scene_world", "PlanningSceneWorld", monitor.apply_world),
        ("collision_object", "CollisionObject", monitor.apply_object),
        ("attached_collision_object", "AttachedCollisionObject", monitor.apply_attached),
    )
    for topic, kind, take in takers:
        node.create_subscription(
            topic, f"moveit_msgs/msg/{kind}", _without_value(take), queue_size=1024
        )


def _without_value(take: Callable[[Any], object]) -> Callable[[Any], None]:
    def call(message: Any) -> None:
        take(message)

    return call


def _get(context: MoveGroupContext, request: Any) -> Any:
    response: Any = service_type(_GET).Response()
    parts = Components.asked(int(request.components.components))
    response.scene = context.monitor.message(parts)
    return response


def _apply(context: MoveGroupContext, request: Any) -> Any:
    done = context.monitor.apply(request.scene)
    return service_type(_APPLY).Response(success=done)


def _cleared(request: Any) -> Any:
    """There is no octomap, so nothing is left of it."""
    del request
    return service_type(_EMPTY).Response()


def _event(context: MoveGroupContext, message: Any) -> None:
    if message.data == "stop" and context.executor is not None:
        context.executor.stop("trajectory_execution_event")
    elif message.data != "stop":
        text = f"Unknown event type: '{message.data}'; there is 'stop'"
        context.node.log("warn", text)

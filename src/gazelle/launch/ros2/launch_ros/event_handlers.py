"""launch_ros.event_handlers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import EventHandler
from gazelle.launch.ros2.launch_ros.actions.lifecycle_node import LifecycleNode
from gazelle.launch.ros2.launch_ros.events.lifecycle import StateTransition

__all__ = ["OnStateTransition"]


class OnStateTransition(EventHandler):
    """Yields entities when a managed node changes its state.

    Of `target_lifecycle_node`, `transition`, `start_state` and `goal_state` those that are given
    must fit; a `matcher` takes the place of them all.
    """

    def __init__(
        self,
        *,
        entities: Any,
        target_lifecycle_node: LifecycleNode | None = None,
        transition: str | None = None,
        start_state: str | None = None,
        goal_state: str | None = None,
        matcher: Callable[[Event], bool] | None = None,
        **kwargs: Any,
    ) -> None:
        target = target_lifecycle_node
        if target is not None and not isinstance(target, LifecycleNode):
            raise RuntimeError("OnStateTransition requires a 'LifecycleNode' action as the target")
        wanted = {
            "action": target,
            "transition": transition,
            "start_state": start_state,
            "goal_state": goal_state,
        }

        def fits(event: Event) -> bool:
            return isinstance(event, StateTransition) and all(
                value is None or getattr(event, key) == value for key, value in wanted.items()
            )

        super().__init__(matcher=matcher or fits, entities=entities, **kwargs)
        self.__target = target

    @property
    def handler_description(self) -> str:
        """What it does, in words."""
        return "<actions>"

    @property
    def matcher_description(self) -> str:
        """Which events it picks, in words."""
        if self.__target is None:
            return "event == StateTransition"
        which = hex(id(self.__target))
        return f"event == StateTransition and event.action == LifecycleNode({which})"

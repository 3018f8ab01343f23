"""The base of actions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gazelle.launch.ros2.condition import Condition
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity

if TYPE_CHECKING:
    from gazelle.launch.ros2.frontend import Entity, Parser
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["Action"]


class Action(LaunchDescriptionEntity):
    """Something to do, unless its condition says no."""

    def __init__(self, *, condition: Condition | None = None) -> None:
        self.__condition = condition

    @staticmethod
    def parse(entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return the class and the arguments that an element's ``if`` and ``unless`` mean.

        Raises:
            RuntimeError: it has both.
        """
        from gazelle.launch.ros2.conditions import IfCondition, UnlessCondition

        if_text = entity.get_attr("if", optional=True)
        unless_text = entity.get_attr("unless", optional=True)
        if if_text is not None and unless_text is not None:
            raise RuntimeError("if and unless conditions can't be used simultaneously")
        kwargs: dict[str, Any] = {}
        if if_text is not None:
            kwargs["condition"] = IfCondition(parser.parse_substitution(if_text))
        if unless_text is not None:
            kwargs["condition"] = UnlessCondition(parser.parse_substitution(unless_text))
        return Action, kwargs

    @property
    def condition(self) -> Condition | None:
        """Its condition, None when it is always carried out."""
        return self.__condition

    def describe(self) -> str:
        """Return a text for people."""
        return repr(self)

    def get_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return what it yields, as far as that is known before it runs."""
        return []

    def describe_sub_entities(self) -> list[LaunchDescriptionEntity]:
        """Return what it yields in any case."""
        return self.get_sub_entities() if self.condition is None else []

    def describe_conditional_sub_entities(
        self,
    ) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return what it yields when its condition holds."""
        if self.condition is None:
            return []
        return [(f"Conditionally included by {self.describe()}", self.get_sub_entities())]

    def visit(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Carry it out if its condition holds, and tell handlers of its completion."""
        if self.__condition is not None and not self.__condition.evaluate(context):
            return None
        try:
            return self.execute(context)
        finally:
            self._tell_completion(context)

    def _tell_completion(self, context: LaunchContext) -> None:
        from gazelle.launch.ros2.events import ExecutionComplete

        event = ExecutionComplete(action=self)
        if not context.would_handle_event(event):
            return
        future = self.get_asyncio_future()
        if future is None:
            context.emit_event_sync(event)
        else:
            future.add_done_callback(lambda _future: context.emit_event_sync(event))

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Do it, and return what is to be visited next."""
        return None

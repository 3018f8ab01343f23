"""launch_ros.actions.lifecycle_node: managed nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.interfaces import message_type, service_type
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.actions import OpaqueFunction
from gazelle.launch.ros2.event_handler import EventHandler
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity
from gazelle.launch.ros2.launch_ros.actions.node import Node
from gazelle.launch.ros2.launch_ros.events.lifecycle import ChangeState, StateTransition
from gazelle.launch.ros2.launch_ros.launch_graph import call_while_running, launch_node
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.utilities.type_utils import (
    normalize_typed_substitution,
    perform_typed_substitution,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["LifecycleNode"]

_CONFIGURE, _ACTIVATE = 1, 3


@expose_action("lifecycle_node")
class LifecycleNode(Node):
    """Runs a managed node: `ChangeState` events change its state, `StateTransition` tells of it.

    With `autostart` it is configured and activated as soon as it runs.
    """

    def __init__(
        self,
        *,
        name: SomeSubstitutionsType | None = None,
        namespace: SomeSubstitutionsType | None = None,
        autostart: bool | SomeSubstitutionsType = False,
        **kwargs: Any,
    ) -> None:
        old = {"name": "node_name", "namespace": "node_namespace"}
        for key, value in (("name", name), ("namespace", namespace)):
            if value is None and old[key] not in kwargs:
                raise TypeError(
                    f"LifecycleNode() missing 1 required keyword-only argument: '{key}'"
                )
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__autostart = normalize_typed_substitution(autostart, bool)
        self.__logger = launch_logging.get_logger("launch_ros.actions.lifecycle_node")

    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser, ignore: list[str] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<lifecycle_node>``."""
        _, kwargs = super().parse(entity, parser, ignore=ignore)
        autostart = entity.get_attr("autostart", data_type=bool, optional=True)
        if autostart is not None:
            kwargs["autostart"] = parser.parse_if_substitutions(autostart)
        return cls, kwargs

    @property
    def is_lifecycle_node(self) -> bool:
        """Always true."""
        return True

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start it, listening to its transitions from then on."""
        self._perform_substitutions(context)
        if self.UNSPECIFIED_NODE_NAME in self.node_name:
            raise RuntimeError("node_name unexpectedly incomplete for lifecycle node")
        kind = message_type("lifecycle_msgs/msg/TransitionEvent")
        topic = f"{self.node_name}/transition_event"

        def take(message: Any) -> None:
            context.asyncio_loop.call_soon_threadsafe(self.__tell, context, message)

        launch_node(context).create_subscription(topic, kind, take)
        handler = EventHandler(
            matcher=lambda event: isinstance(event, ChangeState),
            entities=[OpaqueFunction(function=self.__on_change_state)],
        )
        context.register_event_handler(handler)
        found = super().execute(context)
        if perform_typed_substitution(context, self.__autostart, bool):
            self.__change(context, _CONFIGURE, _ACTIVATE)
        return found

    def __tell(self, context: LaunchContext, message: Any) -> None:
        context.emit_event_sync(StateTransition(action=self, msg=message))

    def __on_change_state(self, context: LaunchContext) -> None:
        event: ChangeState = context.locals.event
        if event.lifecycle_node_matcher(self):
            self.__change(context, event.transition_id)

    def __change(self, context: LaunchContext, *transition_ids: int) -> None:
        future = context.asyncio_loop.run_in_executor(
            None, self.__change_in_turn, context, transition_ids
        )
        context.add_completion_future(future)

    def __change_in_turn(self, context: LaunchContext, transition_ids: tuple[int, ...]) -> None:
        kind: Any = service_type("lifecycle_msgs/srv/ChangeState")
        name = f"{self.node_name}/change_state"
        for transition_id in transition_ids:
            request = kind.Request()
            request.transition.id = transition_id
            word = ChangeState.valid_transitions[transition_id]
            what = f"transition '{word}' for LifecycleNode '{self.node_name}'"
            try:
                answer = call_while_running(context, name, kind, request)
            except GraphError as error:
                self.__logger.error(f"Failed to make {what}: {error}")
                return
            if answer is None:
                self.__logger.warning(f"Abandoning {what}, due to shutdown.")
                return
            if not answer.success:
                self.__logger.error(f"Failed to make {what}")
                return

"""launch_ros.actions.lifecycle_transition: several transitions, one after the other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

from gazelle.diagnostics import did_you_mean
from gazelle.launch.ros2 import logging as launch_logging
from gazelle.launch.ros2.action import Action
from gazelle.launch.ros2.actions import EmitEvent, OpaqueFunction
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.event_handler import EventHandler
from gazelle.launch.ros2.frontend import Entity, Parser, expose_action
from gazelle.launch.ros2.launch_ros.events.lifecycle import ChangeState, StateTransition
from gazelle.launch.ros2.launch_ros.events.matchers import matches_node_name
from gazelle.launch.ros2.substitution import SomeSubstitutionsType
from gazelle.launch.ros2.utilities import (
    normalize_to_list_of_substitutions,
    perform_substitutions,
)

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext
    from gazelle.launch.ros2.launch_description_entity import LaunchDescriptionEntity

__all__ = ["LifecycleTransition"]

_ERROR = "errorprocessing"


@expose_action("lifecycle_transition")
class LifecycleTransition(Action):
    """Lets managed nodes make transitions: each when the one before has reached its goal.

    Attributes:
        transition_targets: states on the way and at the end, by constants of ``Transition``.
    """

    transition_targets: ClassVar[dict[int, dict[str, str]]] = {
        number: {"start_state": start, "goal_state": goal}
        for number, start, goal in (
            (1, "configuring", "inactive"),
            (2, "cleaningup", "unconfigured"),
            (3, "activating", "active"),
            (4, "deactivating", "inactive"),
            (5, "shuttingdown", "finalized"),
            (6, "shuttingdown", "finalized"),
            (7, "shuttingdown", "finalized"),
        )
    }

    def __init__(
        self,
        *,
        lifecycle_node_names: Sequence[SomeSubstitutionsType],
        transition_ids: Sequence[int | SomeSubstitutionsType],
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if not transition_ids:
            raise ValueError("No transition_ids provided.")
        if not lifecycle_node_names:
            raise ValueError("No lifecycle_node_names provided.")
        self.__names = [normalize_to_list_of_substitutions(one) for one in lifecycle_node_names]
        self.__ids = [
            normalize_to_list_of_substitutions(str(one) if isinstance(one, int) else one)
            for one in transition_ids
        ]
        self.__logger = launch_logging.get_logger("launch_ros.actions.lifecycle_transition")

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[Any, dict[str, Any]]:
        """Return class and arguments of a ``<lifecycle_transition>``."""
        _, kwargs = super().parse(entity, parser)
        for attribute, name in (("names", "lifecycle_node_names"), ("ids", "transition_ids")):
            words = entity.get_attr(attribute).split()
            kwargs[name] = [parser.parse_substitution(word) for word in words]
        return cls, kwargs

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Ask for the first transition of every node; the others follow.

        Raises:
            ValueError: a transition is none.
        """
        ids = [_number(perform_substitutions(context, one)) for one in self.__ids]
        names = [perform_substitutions(context, one) for one in self.__names]
        for name in names:
            self.__follow(context, name, ids)
        return [_request(name, ids[0]) for name in names]

    def __follow(self, context: LaunchContext, name: str, ids: Sequence[int]) -> None:
        """Register what is done when a node reaches each goal, and when it fails."""
        handlers: list[EventHandler] = []

        def give_up(_context: LaunchContext) -> None:
            reason = "error occurred during transitions"
            self.__logger.info(f"Stopping transitions for {name} because '{reason}'")
            forget(_context)

        def forget(_context: LaunchContext) -> None:
            for handler in handlers:
                if handler in _context._event_handlers:
                    _context.unregister_event_handler(handler)

        for number, following in zip(ids, [*ids[1:], None], strict=True):
            entity: Any = OpaqueFunction(function=forget)
            if following is not None:
                entity = _request(name, following)
            target = self.transition_targets[number]
            handlers.append(
                EventHandler(
                    matcher=_reaches(name, target["goal_state"], target["start_state"]),
                    entities=[entity],
                    handle_once=True,
                )
            )
        fails = OpaqueFunction(function=give_up)
        handlers.append(
            EventHandler(matcher=_reaches(name, _ERROR), entities=[fails], handle_once=True)
        )
        # What is registered last is asked first: of two equal transitions the first one counts.
        for handler in reversed(handlers):
            context.register_event_handler(handler)


def _number(text: str) -> int:
    known = LifecycleTransition.transition_targets
    names = {key: name for key, name in ChangeState.valid_transitions.items() if key in known}
    if not text.isdigit():
        words = {name.removeprefix("TRANSITION_").lower(): key for key, name in names.items()}
        if text in words:
            return words[text]
        raise ValueError(
            f"expected integer for lifecycle transition, got {text}; "
            f"{did_you_mean(text, words) or ', '.join(words)}"
        )
    if int(text) not in known:
        raise ValueError(f"no transition has the number {text}; there are {sorted(known)}")
    return int(text)


def _request(name: str, transition_id: int) -> EmitEvent:
    matcher = matches_node_name(name)
    event = ChangeState(lifecycle_node_matcher=matcher, transition_id=transition_id)
    return EmitEvent(event=event)


def _reaches(name: str, goal_state: str, start_state: str = "") -> Callable[[Event], bool]:
    is_node = matches_node_name(name)

    def fits(event: Event) -> bool:
        return (
            isinstance(event, StateTransition)
            and is_node(event.action)
            and event.goal_state == goal_state
            and start_state in ("", event.start_state)
        )

    return fits

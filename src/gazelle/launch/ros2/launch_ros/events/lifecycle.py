"""launch_ros.events.lifecycle: states of managed nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

from gazelle.interfaces import message_type
from gazelle.launch.ros2.event import Event
from gazelle.launch.ros2.launch_ros.events.matchers import matches_node_name

__all__ = ["ChangeState", "StateTransition", "matches_node_name"]


def _constants(type_name: str, names: tuple[str, ...]) -> dict[int, str]:
    kind: Any = message_type(type_name)
    return {getattr(kind, name): name for name in names}


class ChangeState(Event):
    """Nodes that a matcher picks are to make a transition.

    Attributes:
        lifecycle_node_matcher: is given the action of each node.
        transition_id: a constant of ``lifecycle_msgs.msg.Transition``.
        valid_transitions: the names of all of them.
        valid_states: the names of the states, by their constants.
    """

    name = "launch_ros.events.lifecycle.ChangeState"
    valid_transitions: ClassVar[dict[int, str]] = _constants(
        "lifecycle_msgs/msg/Transition",
        (
            "TRANSITION_CREATE",
            "TRANSITION_CONFIGURE",
            "TRANSITION_CLEANUP",
            "TRANSITION_ACTIVATE",
            "TRANSITION_DEACTIVATE",
            "TRANSITION_UNCONFIGURED_SHUTDOWN",
            "TRANSITION_INACTIVE_SHUTDOWN",
            "TRANSITION_ACTIVE_SHUTDOWN",
            "TRANSITION_DESTROY",
        ),
    )
    valid_states: ClassVar[dict[int, str]] = _constants(
        "lifecycle_msgs/msg/State",
        (
            "PRIMARY_STATE_UNKNOWN",
            "PRIMARY_STATE_UNCONFIGURED",
            "PRIMARY_STATE_INACTIVE",
            "PRIMARY_STATE_ACTIVE",
            "PRIMARY_STATE_FINALIZED",
            "TRANSITION_STATE_CONFIGURING",
            "TRANSITION_STATE_CLEANINGUP",
            "TRANSITION_STATE_SHUTTINGDOWN",
            "TRANSITION_STATE_ACTIVATING",
            "TRANSITION_STATE_DEACTIVATING",
            "TRANSITION_STATE_ERRORPROCESSING",
        ),
    )

    def __init__(
        self, *, lifecycle_node_matcher: Callable[[Any], bool], transition_id: int
    ) -> None:
        super().__init__()
        self.lifecycle_node_matcher = lifecycle_node_matcher
        self.transition_id = transition_id
        if transition_id not in self.valid_transitions:
            known = ", ".join(f"{name}: {key}" for key, name in self.valid_transitions.items())
            raise ValueError(
                f"given transition_id of '{transition_id}', expected one of {{{known}}}"
            )


class StateTransition(Event):
    """A node is in another state.

    Attributes:
        action: of the node.
        msg: ``lifecycle_msgs/msg/TransitionEvent``.
        timestamp: of the message.
        transition: its label.
        start_state: label of the state before.
        goal_state: label of the state now.
    """

    name = "launch_ros.events.lifecycle.StateTransition"

    def __init__(self, *, action: Any, msg: Any) -> None:
        super().__init__()
        self.action = action
        self.msg = msg
        self.timestamp = msg.timestamp
        self.transition = msg.transition.label
        self.start_state = msg.start_state.label
        self.goal_state = msg.goal_state.label

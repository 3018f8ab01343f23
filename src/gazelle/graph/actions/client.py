"""Action clients: sending goals to a server of either generation."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import nearest_names
from gazelle.errors import GraphError, NotFoundError
from gazelle.graph.actions.action_info import ActionInfo, actions_of
from gazelle.graph.actions.actionlib_client import ActionlibClient
from gazelle.graph.actions.client_goal import ClientGoal
from gazelle.graph.actions.ros2_client import Ros2Client
from gazelle.graph.actions.types import (
    ActionTypes,
    RosVersion,
    action_name,
    action_types,
    as_message,
)

if TYPE_CHECKING:
    from gazelle.graph.node import Node

__all__ = ["ActionClient"]

_SLICE_S = 0.1
_POLL_S = 0.005


class ActionClient:
    """Sends goals of one action.

    Attributes:
        name: the action's global name.
        type_name: ``pkg/action/Name``.
    """

    def __init__(
        self,
        node: Node,
        name: str,
        action_type: Any,
        *,
        ros_version: RosVersion | None = None,
    ) -> None:
        """Prepare to send goals.

        Args:
            node: a graph's node.
            name: any legal name.
            action_type: ``pkg/Name``, or a class of either generation.
            ros_version: 1 for actionlib's wire, 2 for ROS 2's; as the server when None.

        Raises:
            NotFoundError: nothing defines the action.
            GraphError: `action_type` is no action's type.
        """
        self.name = node.resolve_name(name)
        self.type_name = action_name(action_type)
        self._action_type = action_type
        self._node = node
        self._types: ActionTypes | None = None
        self._wire: ActionlibClient | Ros2Client | None = None
        if ros_version is not None:
            self._join(ros_version)

    @property
    def types(self) -> ActionTypes:
        """The action's messages.

        Raises:
            NotFoundError: the generation is the server's, and there is none yet.
        """
        if self._types is None:
            self.require_server()
        assert self._types is not None
        return self._types

    @property
    def is_server_ready(self) -> bool:
        """True when a server would hear a goal, and its feedback and result would come back."""
        self._find_out()
        return self._wire is not None and self._wire.is_connected

    def wait_for_server(self, timeout_s: float | None = None) -> bool:
        """Wait until a server is ready, in wall time; False when time is up first."""
        deadline = None if timeout_s is None else time.monotonic() + timeout_s
        while not self.is_server_ready:
            left_s = _SLICE_S if deadline is None else min(_SLICE_S, deadline - time.monotonic())
            if left_s <= 0 or self._node.closed:
                return False
            if self._node.graph.discovery.wait_for(self._is_announced, left_s):
                # Announcements can overtake the connections themselves.
                time.sleep(min(_POLL_S, left_s))
        return True

    def require_server(self, timeout_s: float = 0.0) -> None:
        """Wait until a server is ready.

        Raises:
            NotFoundError: there is none in time; the text names actions of similar names.
            GraphError: there is one of another type.
        """
        if self.wait_for_server(timeout_s):
            return
        known = actions_of(self._node.graph.entities())
        other = next((one for one in known if one.name == self.name and one.servers), None)
        if other is not None and other.type_name != self.type_name:
            raise GraphError(
                f"action {self.name} has type {other.type_name}, the client wants {self.type_name}"
            )
        if other is not None and self.wait_for_server(_SLICE_S * 10):
            return
        names = [one.name for one in known if one.servers]
        raise NotFoundError(
            "action server",
            self.name,
            nearest=nearest_names(self.name, names),
            hint="ROS says: Waiting for an action server to become available...",
        )

    def send_goal(
        self,
        goal: Any = None,
        *,
        on_feedback: Callable[[Any], None] | None = None,
        on_done: Callable[[ClientGoal], None] | None = None,
        on_transition: Callable[[ClientGoal], None] | None = None,
        check: bool = True,
    ) -> ClientGoal:
        """Send a goal; callbacks run in the graph's threads.

        Args:
            goal: the goal message, or a mapping or other message with fields of the same names.
            on_feedback: called with each feedback message.
            on_done: called with the goal at its end.
            on_transition: called with the goal at each change.
            check: see that there is a server; actionlib's clients send into the blue.

        Raises:
            NotFoundError: there is no server.
            InterfaceError: a field's value does not fit.
        """
        if check or self._wire is None:
            self.require_server()
        assert self._wire is not None
        message = as_message(goal, self.types.Goal)
        return self._wire.send(
            message, on_feedback=on_feedback, on_done=on_done, on_transition=on_transition
        )

    def cancel_all(self) -> None:
        """Ask the server to cancel all goals, those of other clients too."""
        if self._wire is not None:
            self._wire.cancel_all()

    def cancel_before(self, stamp_ns: int) -> None:
        """Ask the server to cancel all goals up to a time of the node's clock."""
        if self._wire is not None:
            self._wire.cancel_all(stamp_ns)

    def close(self) -> None:
        """Leave the action; goals go on without this client."""
        if self._wire is not None:
            self._wire.close()
            self._wire = None

    def _join(self, ros_version: RosVersion) -> None:
        kind = self._action_type
        if ros_version == 2 or not hasattr(kind, "_slot_types"):
            kind = self.type_name
        self._types = action_types(kind, ros_version)
        made = ActionlibClient if ros_version == 1 else Ros2Client
        self._wire = made(self._node, self.name, self._types)

    def _find_out(self) -> None:
        if self._wire is not None:
            return
        info = self._announced(self._node.graph.discovery.known())
        if info is not None:
            self._join(1 if info.ros_version == 1 else 2)

    def _announced(self, known: Any) -> ActionInfo | None:
        for one in actions_of(known):
            if one.name == self.name and one.servers and one.type_name == self.type_name:
                return one
        return None

    def _is_announced(self, known: Any) -> bool:
        return self._announced(known) is not None

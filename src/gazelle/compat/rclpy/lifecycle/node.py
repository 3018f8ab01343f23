"""Lifecycle nodes (rclpy.lifecycle): states that others may change, by services."""

from __future__ import annotations

from typing import Any

from gazelle.compat.rclpy.callback_groups import CallbackGroup
from gazelle.compat.rclpy.lifecycle.entities import LifecyclePublisher, ManagedEntity
from gazelle.compat.rclpy.lifecycle.states import (
    STATES,
    TRANSITIONS,
    LifecycleState,
    StateMachine,
    Transition,
    TransitionCallbackReturn,
)
from gazelle.compat.rclpy.logging import get_logger
from gazelle.compat.rclpy.node import Node
from gazelle.compat.rclpy.qos import QoSProfile
from gazelle.interfaces import message_type, service_type

__all__ = ["LifecycleNode", "LifecycleNodeMixin"]

_ERROR = TransitionCallbackReturn.ERROR
_CALLBACKS = {
    "configuring": "on_configure",
    "cleaningup": "on_cleanup",
    "shuttingdown": "on_shutdown",
    "activating": "on_activate",
    "deactivating": "on_deactivate",
    "errorprocessing": "on_error",
}


class LifecycleNodeMixin(ManagedEntity):
    """The lifecycle of a node; stands before `Node` among the bases.

    A callback that raises counts as `TransitionCallbackReturn.ERROR`; what it raised is logged.
    """

    def __init__(
        self,
        *,
        enable_communication_interface: bool = True,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        node = self.__node("LifecycleNodeMixin")
        self.__machine = StateMachine()
        self.__managed_entities: list[ManagedEntity] = []
        self.__events: Any = None
        if enable_communication_interface:
            event = message_type("lifecycle_msgs/msg/TransitionEvent")
            with node.graph_node.announced_together():
                self.__events = node.create_publisher(event, "~/transition_event", 10)
                for name, kind, answer in (
                    ("change_state", "ChangeState", self.__on_change_state),
                    ("get_state", "GetState", self.__on_get_state),
                    ("get_available_states", "GetAvailableStates", self.__on_get_states),
                    (
                        "get_available_transitions",
                        "GetAvailableTransitions",
                        self.__on_get_available,
                    ),
                    ("get_transition_graph", "GetAvailableTransitions", self.__on_get_graph),
                ):
                    service = service_type(f"lifecycle_msgs/srv/{kind}")
                    node.create_service(service, f"~/{name}", answer, callback_group=callback_group)

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Tell the managed entities; a node's own callback calls this one."""
        return self.__tell("on_configure", state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Tell the managed entities."""
        return self.__tell("on_cleanup", state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Tell the managed entities."""
        return self.__tell("on_shutdown", state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Tell the managed entities: lifecycle publishers begin to send."""
        return self.__tell("on_activate", state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Tell the managed entities: lifecycle publishers fall silent."""
        return self.__tell("on_deactivate", state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Tell the managed entities; success leads back to ``unconfigured``."""
        return self.__tell("on_error", state)

    def trigger_configure(self) -> TransitionCallbackReturn:
        """Configure the node."""
        return self.__change_state("configure")

    def trigger_cleanup(self) -> TransitionCallbackReturn:
        """Clean the node up."""
        return self.__change_state("cleanup")

    def trigger_shutdown(self) -> TransitionCallbackReturn:
        """End the node, from any of its states.

        Raises:
            RuntimeError: it has ended already.
        """
        if self.__machine.find("shutdown") is None:
            raise RuntimeError(
                f"Shutdown transtion not possible from state {self.__machine.state.label}"
            )
        return self.__change_state("shutdown")

    def trigger_activate(self) -> TransitionCallbackReturn:
        """Make the node active."""
        return self.__change_state("activate")

    def trigger_deactivate(self) -> TransitionCallbackReturn:
        """Make the node inactive."""
        return self.__change_state("deactivate")

    def add_managed_entity(self, entity: ManagedEntity) -> None:
        """Let something follow the node's state.

        Raises:
            TypeError: it is no `ManagedEntity`.
        """
        if not isinstance(entity, ManagedEntity):
            raise TypeError("Expected a rclpy.lifecycle.ManagedEntity instance.")
        self.__managed_entities.append(entity)

    def create_lifecycle_publisher(
        self, msg_type: Any, topic: str, qos_profile: QoSProfile | int, **options: Any
    ) -> LifecyclePublisher:
        """Offer a topic on which messages go out only while the node is active.

        Args:
            msg_type: class of the messages.
            topic: any legal name.
            qos_profile: a profile, or the queue's depth.
            options: the others of `Node.create_publisher`.

        Raises:
            TypeError: there is no such option.
        """
        node = self.__node("LifecycleNodeMixin")
        made = node.create_publisher(
            msg_type, topic, qos_profile, **options, publisher_class=LifecyclePublisher
        )
        assert isinstance(made, LifecyclePublisher)
        self.add_managed_entity(made)
        return made

    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher) -> bool:
        """Stop offering a topic."""
        if publisher in self.__managed_entities:
            self.__managed_entities.remove(publisher)
        return self.__node("LifecycleNodeMixin").destroy_publisher(publisher)

    def __node(self, name: str) -> Node:
        if not isinstance(self, Node):
            raise RuntimeError(
                f"{name} uses Node fields so Node needs to be in the inheritance tree."
            )
        return self

    def __tell(self, callback: str, state: LifecycleState) -> TransitionCallbackReturn:
        for entity in self.__managed_entities:
            answer = getattr(entity, callback)(state)
            if not isinstance(answer, TransitionCallbackReturn):
                raise TypeError(
                    f"{callback}() return value of class {type(entity)} should be"
                    f" `TransitionCallbackReturn`, not {answer!r}"
                )
            if answer is not TransitionCallbackReturn.SUCCESS:
                return answer
        return TransitionCallbackReturn.SUCCESS

    def __change_state(self, wanted: int | str) -> TransitionCallbackReturn:
        before = self.__machine.state
        first = self.__machine.find(wanted)
        if first is None:
            known = ", ".join(f"{one.label} [{one.id}]" for one in self.__machine.available())
            warning = f"No transition matching {wanted} found for current state {before.label}"
            get_logger("rcl_lifecycle").warning(f"{warning} (possible: {known or 'none'})")
            text = f"Unable to start transition {wanted} from current state"
            self.__node("LifecycleNodeMixin").get_logger().error(
                f"{text} ({before.state_id}, '{before.label}')"
            )
            return _ERROR
        self.__go(first)
        answer = self.__run_callback(before)
        if answer is _ERROR:
            # Now it is errorprocessing, and that callback decides where it ends.
            self.__run_callback(before)
        return answer

    def __run_callback(self, before: LifecycleState) -> TransitionCallbackReturn:
        """Call what belongs to the present state and take the transition it asks for."""
        name = _CALLBACKS[self.__machine.state.label]
        logger = self.__node("LifecycleNodeMixin").get_logger()
        try:
            answer = getattr(self, name)(before)
        except Exception as error:  # noqa: BLE001 - a user's callback may raise anything
            logger.error(f"{name}() raised {type(error).__name__}: {error}")
            answer = _ERROR
        if not isinstance(answer, TransitionCallbackReturn):
            logger.error(f"{name}() returned {answer!r}; return a TransitionCallbackReturn")
            answer = _ERROR
        following = self.__machine.find(answer.to_label())
        if following is not None:
            self.__go(following)
        return answer

    def __go(self, transition: Transition) -> None:
        self.__machine.go(transition)
        if self.__events is not None:
            # rcl_lifecycle fills only the states in, neither stamp nor transition.
            event = message_type("lifecycle_msgs/msg/TransitionEvent")()
            event.start_state = _state_message(transition.start)
            event.goal_state = _state_message(transition.goal)
            self.__events.publish(event)

    def __on_change_state(self, request: Any, response: Any) -> Any:
        wanted = request.transition.label or int(request.transition.id)
        response.success = self.__change_state(wanted) is TransitionCallbackReturn.SUCCESS
        return response

    def __on_get_state(self, _request: Any, response: Any) -> Any:
        response.current_state = _state_message(self.__machine.state.state_id)
        return response

    def __on_get_states(self, _request: Any, response: Any) -> Any:
        response.available_states = [_state_message(number) for number in STATES]
        return response

    def __on_get_available(self, _request: Any, response: Any) -> Any:
        response.available_transitions = [_description(one) for one in self.__machine.available()]
        return response

    def __on_get_graph(self, _request: Any, response: Any) -> Any:
        response.available_transitions = [_description(one) for one in TRANSITIONS]
        return response


class LifecycleNode(LifecycleNodeMixin, Node):
    """A node with a lifecycle; takes the arguments of `Node`."""

    def __init__(
        self,
        node_name: str,
        *,
        enable_communication_interface: bool = True,
        **options: Any,
    ) -> None:
        Node.__init__(self, node_name, **options)
        LifecycleNodeMixin.__init__(
            self, enable_communication_interface=enable_communication_interface
        )


def _state_message(state_id: int) -> Any:
    return message_type("lifecycle_msgs/msg/State")(id=state_id, label=STATES[state_id])


def _description(one: Transition) -> Any:
    message = message_type("lifecycle_msgs/msg/TransitionDescription")()
    message.transition = message_type("lifecycle_msgs/msg/Transition")(id=one.id, label=one.label)
    message.start_state = _state_message(one.start)
    message.goal_state = _state_message(one.goal)
    return message

"""Events of publishers and subscriptions (rclpy.event_handler, rclpy.qos_event).

This graph tells of partners that come and go (``matched``), of partners with another quality of
service (``incompatible_qos``; messages pass nevertheless, which most transports of ROS 2 refuse)
and of missed deadlines. It has no liveliness leases, and it takes note of other types by itself,
so those callbacks stay silent.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.compat.rclpy.clock import Clock
from gazelle.compat.rclpy.duration import Infinite
from gazelle.compat.rclpy.executors import Once
from gazelle.compat.rclpy.qos import (
    QoSPolicyKind,
    QoSProfile,
    announced_qos,
    clashing_policy,
)
from gazelle.compat.rclpy.time import ClockType
from gazelle.graph import Entity, Kind

if TYPE_CHECKING:
    from gazelle.compat.rclpy.callback_groups import CallbackGroup
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "EventWatch",
    "IncompatibleTypeInfo",
    "MatchedInfo",
    "PublisherEventCallbacks",
    "QoSIncompatibleInfo",
    "QoSLivelinessChangedInfo",
    "QoSLivelinessLostInfo",
    "QoSMessageLostInfo",
    "QoSMissedInfo",
    "QoSOfferedDeadlineMissedInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherMatchedInfo",
    "QoSRequestedDeadlineMissedInfo",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionMatchedInfo",
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]

Callback = Callable[[Any], Any] | None


class UnsupportedEventTypeError(Exception):
    """The transport has no such events."""


class MatchedInfo(NamedTuple):
    """How many partners there are and have been."""

    total_count: int
    total_count_change: int
    current_count: int
    current_count_change: int


class QoSMissedInfo(NamedTuple):
    """How many deadlines were missed."""

    total_count: int
    total_count_change: int


class QoSIncompatibleInfo(NamedTuple):
    """How many partners have another quality of service, and the policy of the last."""

    total_count: int
    total_count_change: int
    last_policy_kind: QoSPolicyKind


class QoSLivelinessChangedInfo(NamedTuple):
    """How many publishers live."""

    alive_count: int
    not_alive_count: int
    alive_count_change: int
    not_alive_count_change: int


class QoSLivelinessLostInfo(NamedTuple):
    """How often a publisher did not say in time that it lives."""

    total_count: int
    total_count_change: int


class QoSMessageLostInfo(NamedTuple):
    """How many messages were lost."""

    total_count: int
    total_count_change: int


class IncompatibleTypeInfo(NamedTuple):
    """How many partners have another type."""

    total_count: int
    total_count_change: int


# One form serves both ends; rclpy has a name for each.
QoSPublisherMatchedInfo = QoSSubscriptionMatchedInfo = MatchedInfo
QoSOfferedDeadlineMissedInfo = QoSRequestedDeadlineMissedInfo = QoSMissedInfo
QoSOfferedIncompatibleQoSInfo = QoSRequestedIncompatibleQoSInfo = QoSIncompatibleInfo


class SubscriptionEventCallbacks:
    """What a subscription calls when something happens to it."""

    def __init__(
        self,
        *,
        deadline: Callback = None,
        incompatible_qos: Callback = None,
        liveliness: Callback = None,
        message_lost: Callback = None,
        incompatible_type: Callback = None,
        matched: Callback = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.deadline = deadline
        self.incompatible_qos = incompatible_qos
        self.liveliness = liveliness
        self.message_lost = message_lost
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks


class PublisherEventCallbacks:
    """What a publisher calls when something happens to it."""

    def __init__(
        self,
        *,
        deadline: Callback = None,
        incompatible_qos: Callback = None,
        liveliness: Callback = None,
        incompatible_type: Callback = None,
        matched: Callback = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.deadline = deadline
        self.incompatible_qos = incompatible_qos
        self.liveliness = liveliness
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks


class EventWatch:
    """Watches one publisher or subscription for its callbacks."""

    def __init__(
        self,
        node: Node,
        given_topic: str,
        topic: str,
        qos: QoSProfile,
        callbacks: PublisherEventCallbacks | SubscriptionEventCallbacks,
        group: CallbackGroup,
    ) -> None:
        is_publisher = isinstance(callbacks, PublisherEventCallbacks)
        self._node, self._given_topic, self._topic = node, given_topic, topic
        self._qos = announced_qos(qos)
        self._callbacks, self._group = callbacks, group
        self._partner = Kind.SUBSCRIPTION if is_publisher else Kind.PUBLISHER
        self._total = self._current = self._incompatible = self._missed = 0
        self._has_acted = False
        self._partners: set[Entity] = set()
        self._timer: Any = None
        self._is_closed = False
        self._incompatible_callback = callbacks.incompatible_qos
        if self._incompatible_callback is None and callbacks.use_default_callbacks:
            self._incompatible_callback = self._warn
        if callbacks.matched or self._incompatible_callback:
            discovery = node.graph_node.graph.discovery
            discovery.listen(self._on_entity)
            for entity in discovery.known():
                self._on_entity(entity, True)
        if callbacks.deadline and qos.deadline != Infinite and qos.deadline.nanoseconds > 0:
            clock = Clock(clock_type=ClockType.STEADY_TIME)
            period_s = qos.deadline.nanoseconds / 1e9
            self._timer = node.create_timer(period_s, self._on_deadline, group, clock)

    def note(self) -> None:
        """Take note of a message."""
        self._has_acted = True

    def close(self) -> None:
        """Watch no more."""
        self._is_closed = True
        self._node.graph_node.graph.discovery.ignore(self._on_entity)
        if self._timer is not None:
            self._node.destroy_timer(self._timer)

    def _on_entity(self, entity: Entity, appeared: bool) -> None:
        if self._is_closed or entity.kind is not self._partner or entity.name != self._topic:
            return
        if appeared == (entity in self._partners):
            return
        self._partners ^= {entity}
        change = 1 if appeared else -1
        self._current += change
        self._total += appeared
        info = MatchedInfo(self._total, int(appeared), self._current, change)
        self._call(self._callbacks.matched, info)
        policy = self._clash(entity) if appeared else None
        if policy is not None:
            self._incompatible += 1
            told = QoSIncompatibleInfo(self._incompatible, 1, policy)
            self._call(self._incompatible_callback, told)

    def _clash(self, partner: Entity) -> QoSPolicyKind | None:
        if self._partner is Kind.PUBLISHER:
            return clashing_policy(partner.qos, self._qos)
        return clashing_policy(self._qos, partner.qos)

    def _warn(self, info: QoSIncompatibleInfo) -> None:
        is_publisher = self._partner is Kind.SUBSCRIPTION
        partner = "subscription" if is_publisher else "publisher"
        acts = "requesting" if is_publisher else "offering"
        lost = "sent to it" if is_publisher else "received from it"
        self._node.get_logger().warning(
            f"New {partner} discovered on topic '{self._given_topic}', {acts} incompatible QoS. "
            f"No messages will be {lost} in ROS 2 (here they are). "
            f"Last incompatible policy: {info.last_policy_kind.name}"
        )

    def _on_deadline(self) -> None:
        acted, self._has_acted = self._has_acted, False
        if not acted:
            self._missed += 1
            if self._callbacks.deadline is not None:
                self._callbacks.deadline(QoSMissedInfo(self._missed, 1))

    def _call(self, callback: Callback, info: Any) -> None:
        if callback is not None:
            self._node.post_work(Once(self._group, lambda: callback(info)))

"""One direction of a bridge: messages of one name under another."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE, Kind, MessageInfo, Node, RawMessage, Subscription
from gazelle.interfaces import from_cdr, message_type
from gazelle.interfaces.definition import Field

__all__ = ["End", "Relay", "wrapped_field"]

_HEADER = "header"


class End(NamedTuple):
    """One side of a bridge: a topic's name as `node` resolves it."""

    node: Node
    topic: str

    @property
    def name(self) -> str:
        """The topic's global name."""
        return self.node.resolve_name(self.topic)


class Relay:
    """Passes messages on; with one name for both sides it says its type and watches others'."""

    def __init__(
        self,
        source: End,
        target: End,
        type_name: str,
        *,
        log: Callable[[str, str], None],
        queue_size: int = 10,
        lazy: bool = False,
        to_gz: bool = False,
    ) -> None:
        """Begin.

        Args:
            source: where messages come from.
            target: where they go to.
            type_name: of what is published, ``pkg/msg/Name``.
            log: takes a level and a text.
            queue_size: told to others.
            lazy: listen to `source` only while somebody listens to `target`.
            to_gz: `target` is Gazebo's side.
        """
        self._log = log
        self._source = source
        self._nodes = frozenset({source.node.name, target.node.name})
        self._type_name = type_name
        self._lazy = lazy
        self._told: set[str] = set()
        self._subscription: Subscription | None = None
        self._publisher: Any = None
        if source.name != target.name:
            kind: Any = message_type(type_name)
            self._publisher = target.node.create_publisher(
                target.topic, kind, queue_size=queue_size
            )
            if not lazy:
                self._listen()
        elif to_gz:
            # The world takes the messages itself, by whatever type; who asks for the topic's
            # type, or waits for somebody of that type, finds the bridge's.
            source.node.create_subscription(source.topic, None, _leave, announced=type_name)

    def look(self) -> None:
        """Look at who is there: call it now and then."""
        if self._publisher is None:
            self._compare_types()
            return
        if not self._lazy:
            return
        if self._publisher.matched and self._subscription is None:
            self._listen()
        elif not self._publisher.matched and self._subscription is not None:
            self._subscription.unregister()
            self._subscription = None

    def _listen(self) -> None:
        self._subscription = self._source.node.create_subscription(
            self._source.topic,
            None,
            self._take,
            raw=True,
            with_info=True,
            announced=self._type_name,
        )

    def _take(self, message: RawMessage, info: MessageInfo) -> None:
        if self._came_from_here(info):
            # The way back of a bridge in both directions.
            return
        if message.type_name == self._type_name:
            self._publisher.publish_raw(message.data)
            return
        converted = self._converted(message)
        if converted is not None:
            self._publisher.publish(converted)
        else:
            self._tell_type(message.type_name)

    def _came_from_here(self, info: MessageInfo) -> bool:
        entity = self._source.node.graph.entity_with_gid(info.gid)
        return entity is not None and entity.node in self._nodes

    def _converted(self, message: RawMessage) -> Any:
        """Return the message with or without a header around it; None for other differences."""
        have: Any = message_type(message.type_name)
        want: Any = message_type(self._type_name)
        inner, outer = wrapped_field(want, have), wrapped_field(have, want)
        if inner is not None:
            made = want()
            setattr(made, inner, from_cdr(have, message.data))
            return made
        return getattr(from_cdr(have, message.data), outer) if outer is not None else None

    def _compare_types(self) -> None:
        name = self._source.name
        for one in self._source.node.graph.entities():
            is_end = one.kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION) and one.name == name
            if not is_end or one.type_name in (self._type_name, ANY_TYPE):
                continue
            if one.kind is Kind.SUBSCRIPTION and self._differs_by_header(one.type_name):
                # Drives of the simulator take both, whichever they show; a subscription that
                # does not says so itself when a message comes.
                continue
            self._tell_type(one.type_name)

    def _differs_by_header(self, other: str) -> bool:
        try:
            one: Any = message_type(self._type_name)
            two: Any = message_type(other)
        except GazelleError:
            return False
        return wrapped_field(one, two) is not None or wrapped_field(two, one) is not None

    def _tell_type(self, other: str) -> None:
        if other in self._told:
            return
        self._told.add(other)
        self._log(
            "warn",
            f"{self._source.name} carries {other} here, which is not turned into "
            f"{self._type_name}; name {other} in the bridge, or read the topic as it is",
        )


def wrapped_field(outer: Any, inner: Any) -> str | None:
    """Return the field of a stamped message that holds the other one; None when none does."""
    fields: list[Field] = [one for one in outer.FIELDS if one.name != _HEADER]
    is_stamped = len(outer.FIELDS) == 2 and len(fields) == 1
    return fields[0].name if is_stamped and fields[0].type.base == inner.TYPE_NAME else None


def _leave(_message: Any) -> None:
    """Take no notice of a message that the world takes."""

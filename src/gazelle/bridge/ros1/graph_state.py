"""What there is on one side, in the words of the other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TypeVar

from gazelle.bridge.node_mirrors import RosNodeEntities
from gazelle.bridge.ros1.master_registry import State
from gazelle.bridge.ros1.publisher import PublishedTopic
from gazelle.bridge.ros1.slave_api import NodeEntities
from gazelle.bridge.ros1.types import MessageKind, ServiceKind, is_ros2_only, message_kind
from gazelle.bridge.ros1.types import service_kind as service_kind_of
from gazelle.errors import GazelleError, NotFoundError
from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.graph.names import is_hidden, is_legal
from gazelle.interfaces import ros1_type_of

__all__ = ["BRIDGE_NAME", "TypeBook", "node_entities_of", "ros_node_entities_of"]

BRIDGE_NAME = "/ros1_bridge"
_ALIAS = "_gazelle"
_LOG = "rcl_interfaces/msg/Log"
_OWN_OF_ROS2 = ("rcl_interfaces/", "type_description_interfaces/")
_T = TypeVar("_T", MessageKind, ServiceKind)
_V = TypeVar("_V")


class TypeBook:
    """Looks types up and tells once of each that does not get across."""

    def __init__(self, notice: Callable[[str], None], explain: Callable[[str], None]) -> None:
        """Know nothing yet.

        Args:
            notice: told of what does not get across.
            explain: told of what gets across with a definition made for it.
        """
        self._notice = notice
        self._explain = explain
        self._told: set[str] = set()

    def message(self, name: str, where: str) -> MessageKind | None:
        """Return a message type, None when it does not get across."""
        return self._found(message_kind, name, where)

    def service(self, name: str, where: str) -> ServiceKind | None:
        """Return a service type, None when it does not get across."""
        return self._found(service_kind_of, name, where)

    def _found(self, look_up: Callable[[str], _T], name: str, where: str) -> _T | None:
        try:
            found = look_up(name)
        except NotFoundError:
            shown = ros1_type_of(name) if name.count("/") == 2 else name
            self._tell(
                self._notice,
                name,
                f"{where} does not cross the bridge: nothing here defines its type {shown}\n"
                "  fix: start the bridge where the package that defines it is found",
            )
            return None
        except GazelleError as error:
            self._tell(self._notice, name, f"{where} does not cross the bridge: {error}")
            return None
        if name.count("/") == 2 and is_ros2_only(_full_ros1(found, name)):
            self._tell(
                self._explain,
                name,
                f"{where} has type {name}, which ROS 1 does not define; it is offered there as "
                f"{found.ros1_name} with md5sum {found.md5}, for programs that bring such a type",
            )
        return found

    def _tell(self, say: Callable[[str], None], name: str, text: str) -> None:
        if name not in self._told:
            self._told.add(name)
            say(text)


def node_entities_of(
    entities: Iterable[Entity], taken: frozenset[str], skipped: frozenset[str], book: TypeBook
) -> dict[str, NodeEntities]:
    """Return what each node of the graph offers and wants, by its name in ROS 1.

    Args:
        entities: of the graph, without those that come from ROS 1.
        taken: names of nodes in ROS 1; a node of the graph has another name there.
        skipped: topics that stay on their side.
        book: looks types up.
    """
    found: dict[str, NodeEntities] = {}
    for one in entities:
        if one.kind is Kind.CLIENT or (one.kind is not Kind.NODE and not _crosses(one, skipped)):
            continue
        name = _ros1_name(one.node, taken)
        node_entities = found.setdefault(name, NodeEntities(one.node, {}, {}, {}))
        _enter(one, node_entities, book)
    return found


def ros_node_entities_of(
    state: State,
    own: frozenset[str],
    skipped: frozenset[str],
    services: Mapping[str, ServiceKind],
    book: TypeBook,
) -> dict[str, RosNodeEntities[MessageKind, ServiceKind]]:
    """Return what each node of ROS 1 offers and wants, by name.

    Args:
        state: of the master.
        own: names of nodes that come from the graph.
        skipped: topics that stay on their side.
        services: types of services that are known.
        book: looks types up.
    """
    found: dict[str, RosNodeEntities[MessageKind, ServiceKind]] = {}

    def crosses(node: str, name: str) -> bool:
        return node not in own and name not in skipped and is_legal(name)

    def ros_entities(node: str) -> RosNodeEntities[MessageKind, ServiceKind]:
        return found.setdefault(node, RosNodeEntities({}, {}, {}))

    for node, topic in state.publishers:
        type_name = state.types.get(topic, ANY_TYPE)
        if crosses(node, topic) and type_name != ANY_TYPE:
            kind = book.message(type_name, f"topic {topic} of {node}")
            _put(ros_entities(node).publishers, topic, kind)
    for node, topic in state.subscribers:
        if crosses(node, topic):
            type_name = state.types.get(topic, ANY_TYPE)
            known = book.message(type_name, f"topic {topic}") if type_name != ANY_TYPE else None
            _put(ros_entities(node).subscribers, topic, known.wire_name if known else ANY_TYPE)
    for node, service in state.services:
        if crosses(node, service):
            _put(ros_entities(node).services, service, services.get(service))
    return found


def _enter(one: Entity, node_entities: NodeEntities, book: TypeBook) -> None:
    where = f"{one.name} of {one.node}"
    if one.kind is Kind.PUBLISHER:
        kind = book.message(one.type_name, f"topic {where}")
        before = node_entities.publishers.get(one.name)
        latched = one.qos.latched or (before is not None and before.latched)
        _put(node_entities.publishers, one.name, kind and PublishedTopic(one.node, kind, latched))
    elif one.kind is Kind.SUBSCRIPTION and one.type_name == ANY_TYPE:
        _put(node_entities.subscribers, one.name, ANY_TYPE)
    elif one.kind is Kind.SUBSCRIPTION:
        kind = book.message(one.type_name, f"topic {where}")
        _put(node_entities.subscribers, one.name, kind and kind.ros1_name)
    elif one.kind is Kind.SERVICE:
        _put(node_entities.services, one.name, book.service(one.type_name, f"service {where}"))


def _full_ros1(kind: MessageKind | ServiceKind, name: str) -> str:
    """The name of the type in ROS 1, in full: another one for what is renamed."""
    package, bare = kind.ros1_name.split("/")
    return f"{package}/{name.split('/')[1]}/{bare}"


def _put(table: dict[str, _V], name: str, value: _V | None) -> None:
    """Enter what is known."""
    if value is not None:
        table[name] = value


def _crosses(one: Entity, skipped: frozenset[str]) -> bool:
    """Whether ROS 1 has a use for it: ROS 2's own services and hidden names stay here."""
    if is_hidden(one.name) or not is_legal(one.name) or one.name in skipped:
        return False
    return one.type_name == _LOG or not one.type_name.startswith(_OWN_OF_ROS2)


def _ros1_name(node: str, taken: frozenset[str]) -> str:
    if is_hidden(node) or not is_legal(node):
        return BRIDGE_NAME
    return f"{node}{_ALIAS}" if node in taken else node

"""Methods and streams of the graph, and what they work on."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass

from gazelle.graph import Node
from gazelle.studio.frame_manager import Frames
from gazelle.studio.graph_view.actions import open_action
from gazelle.studio.graph_view.node_graph import Topology, get_graph, open_graph
from gazelle.studio.graph_view.nodes import get_node, kill_node, list_loggers, set_logger
from gazelle.studio.graph_view.parameters import (
    delete_parameter,
    get_node_parameters,
    get_parameter,
    list_parameters,
    set_node_parameter,
    set_parameter,
)
from gazelle.studio.graph_view.plot import open_plot
from gazelle.studio.graph_view.publishers import (
    Outbox,
    Publishers,
    list_publishers,
    publish,
    publish_joints,
    remove_publisher,
    set_publisher,
)
from gazelle.studio.graph_view.reconfigure import (
    DynamicClients,
    get_reconfigurable,
    list_reconfigurable,
    set_reconfigurable,
)
from gazelle.studio.graph_view.rosout import Console, open_rosout
from gazelle.studio.graph_view.services import call_service
from gazelle.studio.graph_view.topics import open_echo, open_stats
from gazelle.studio.graph_view.transforms import open_tf, open_tree
from gazelle.studio.graph_view.types import get_type, list_types
from gazelle.studio.lazy_parts import Lazy, closed_with
from gazelle.studio.pages import Pages
from gazelle.studio.routing import Method, methods_of, methods_without, streams_of
from gazelle.studio.streams import StreamKind
from gazelle.studio.subscriptions import Subscriptions

__all__ = ["METHODS", "STREAMS", "GraphParts", "graph_parts"]

_NODE_METHODS: dict[str, Method[Node]] = {
    "graph.get": get_graph,
    "logger.list": list_loggers,
    "logger.set": set_logger,
    "node.info": get_node,
    "node.kill": kill_node,
    "node.param_set": set_node_parameter,
    "node.params": get_node_parameters,
    "param.delete": delete_parameter,
    "param.get": get_parameter,
    "param.list": list_parameters,
    "param.set": set_parameter,
    "reconfigure.list": list_reconfigurable,
    "service.call": call_service,
}
_OUTBOX_METHODS: dict[str, Method[Outbox]] = {
    "joints.publish": publish_joints,
    "topic.publish": publish,
}
_PUBLISHER_METHODS: dict[str, Method[Publishers]] = {
    "publisher.list": list_publishers,
    "publisher.remove": remove_publisher,
    "publisher.set": set_publisher,
}
_CLIENT_METHODS: dict[str, Method[DynamicClients]] = {
    "reconfigure.get": get_reconfigurable,
    "reconfigure.set": set_reconfigurable,
}
_TOPIC_STREAMS: dict[str, StreamKind[Subscriptions]] = {
    "topic.echo": StreamKind(latest=True, open=open_echo),
    "topic.plot": StreamKind(latest=False, open=open_plot),
    "topic.stats": StreamKind(latest=True, open=open_stats),
}
_FRAME_STREAMS: dict[str, StreamKind[Frames]] = {
    "tf": StreamKind(latest=True, open=open_tf),
    "tf.tree": StreamKind(latest=True, open=open_tree),
}
METHODS: dict[str, Method[GraphParts]] = {
    **methods_of(lambda parts: parts.node, _NODE_METHODS),
    **methods_of(lambda parts: parts.outbox, _OUTBOX_METHODS),
    **methods_of(lambda parts: parts.publishers(), _PUBLISHER_METHODS),
    **methods_of(lambda parts: parts.clients, _CLIENT_METHODS),
    **methods_without({"type.get": get_type, "type.list": list_types}),
}
STREAMS: dict[str, StreamKind[GraphParts]] = {
    **streams_of(lambda parts: parts.subscriptions, _TOPIC_STREAMS),
    **streams_of(lambda parts: parts.frames, _FRAME_STREAMS),
    **streams_of(lambda parts: parts.node, {"action": StreamKind(False, open_action)}),
    **streams_of(lambda parts: parts.topology(), {"graph": StreamKind(False, open_graph)}),
    **streams_of(lambda parts: parts.console(), {"rosout": StreamKind(False, open_rosout)}),
}


@dataclass(frozen=True)
class GraphParts:
    """A graph as pages look at it.

    Attributes:
        node: who looks and calls.
        subscriptions: topics that are listened to.
        frames: where frames are.
        outbox: publishers of single messages.
        clients: those of dynamic_reconfigure.
        topology: who speaks with whom; followed from the first look on.
        console: what nodes say; kept from the first look on.
        publishers: those that go on by themselves.
    """

    node: Node
    subscriptions: Subscriptions
    frames: Frames
    outbox: Outbox
    clients: DynamicClients
    topology: Lazy[Topology]
    console: Lazy[Console]
    publishers: Lazy[Publishers]


def graph_parts(
    subscriptions: Subscriptions, frames: Frames, pages: Pages, ending: ExitStack
) -> GraphParts:
    """Return the parts that end with others."""
    node = subscriptions.node
    return GraphParts(
        node,
        subscriptions,
        frames,
        Outbox(node),
        DynamicClients(node),
        topology=Lazy(lambda: closed_with(ending, Topology(node.graph))),
        console=Lazy(lambda: closed_with(ending, Console(subscriptions))),
        publishers=Lazy(lambda: closed_with(ending, Publishers(node, pages))),
    )

"""Methods and streams of the graph."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.studio.graph_view.actions import open_action
from gazelle.studio.graph_view.echo import open_echo
from gazelle.studio.graph_view.joints import publish_joints
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
    list_publishers,
    remove_publisher,
    set_publisher,
)
from gazelle.studio.graph_view.publishing import publish
from gazelle.studio.graph_view.rates import open_stats
from gazelle.studio.graph_view.reconfigure import (
    get_reconfigurable,
    list_reconfigurable,
    set_reconfigurable,
)
from gazelle.studio.graph_view.rosout import open_rosout
from gazelle.studio.graph_view.services import call_service
from gazelle.studio.graph_view.topology import get_graph, open_graph
from gazelle.studio.graph_view.transforms import open_tf, open_tree
from gazelle.studio.graph_view.types import get_type, list_types
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import StreamKind

__all__ = ["METHODS", "STREAMS"]

METHODS: dict[str, Callable[[Studio, Params], Any]] = {
    "graph.get": get_graph,
    "joints.publish": publish_joints,
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
    "publisher.list": list_publishers,
    "publisher.remove": remove_publisher,
    "publisher.set": set_publisher,
    "reconfigure.get": get_reconfigurable,
    "reconfigure.list": list_reconfigurable,
    "reconfigure.set": set_reconfigurable,
    "service.call": call_service,
    "topic.publish": publish,
    "type.get": get_type,
    "type.list": list_types,
}
STREAMS: dict[str, StreamKind] = {
    "action": StreamKind(latest=False, open=open_action),
    "graph": StreamKind(latest=False, open=open_graph),
    "rosout": StreamKind(latest=False, open=open_rosout),
    "tf": StreamKind(latest=True, open=open_tf),
    "tf.tree": StreamKind(latest=True, open=open_tree),
    "topic.echo": StreamKind(latest=True, open=open_echo),
    "topic.plot": StreamKind(latest=False, open=open_plot),
    "topic.stats": StreamKind(latest=True, open=open_stats),
}

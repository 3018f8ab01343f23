"""``libgazebo_ros_state`` and ``libgazebo_ros_properties``, ROS 2's plug-ins of a world."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, cast

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.gazebo_ros.clock_and_states import offer_entity_states
from gazelle.simulator.gazebo_ros.joint_services import JointServices
from gazelle.simulator.gazebo_ros.link_services import LinkServices
from gazelle.simulator.gazebo_ros.model_services import Entities, ModelServices, Row
from gazelle.simulator.gazebo_ros.world_services import LightServices
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader, PluginTable

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["PROPERTIES_TABLE", "STATE_TABLE", "load_properties", "load_state"]

_NAMES = "`<ros>`'s namespace and remappings give the names."

STATE_TABLE = PluginTable(
    ParameterTable(
        "gazebo_ros_state",
        "States of all models, links and lights of the world, asked for, set and published.",
        ("gazebo_ros_state",),
        (Parameter("update_rate", "number", 100.0, "of both topics, 0 for every step", "Hz"),),
    ),
    topics=(
        Topic("model_states", "gazebo_msgs/msg/ModelStates", rate="`update_rate`"),
        Topic("link_states", "gazebo_msgs/msg/LinkStates", rate="`update_rate`"),
    ),
    services=(
        Topic("get_entity_state", "gazebo_msgs/srv/GetEntityState", kind="service"),
        Topic("set_entity_state", "gazebo_msgs/srv/SetEntityState", kind="service"),
    ),
    behaviour=(
        _NAMES,
        "An entity is a model, `model::link` or a light; `reference_frame` is one of them, or"
        " empty or `world`. What is not there is logged, for the responses have no words.",
    ),
)

PROPERTIES_TABLE = PluginTable(
    ParameterTable(
        "gazebo_ros_properties",
        "What models, joints, links and lights of the world are, asked for and set.",
        ("gazebo_ros_properties",),
    ),
    services=(
        Topic("get_model_properties", "gazebo_msgs/srv/GetModelProperties", kind="service"),
        Topic("get_joint_properties", "gazebo_msgs/srv/GetJointProperties", kind="service"),
        Topic("set_joint_properties", "gazebo_msgs/srv/SetJointProperties", kind="service"),
        Topic("get_link_properties", "gazebo_msgs/srv/GetLinkProperties", kind="service"),
        Topic("set_link_properties", "gazebo_msgs/srv/SetLinkProperties", kind="service"),
        Topic("get_light_properties", "gazebo_msgs/srv/GetLightProperties", kind="service"),
        Topic("set_light_properties", "gazebo_msgs/srv/SetLightProperties", kind="service"),
    ),
    behaviour=(_NAMES, "The links of a model are told as `model::link`, as in ROS 2."),
)


def load_state(context: PluginContext) -> None:
    """Offer states of entities."""
    parameters, server = context.reader(STATE_TABLE), _server(context)
    _offer(context, parameters, ModelServices(server, Entities(server)).state_rows())
    models, links = (context.topic(parameters, name) for name in ("model_states", "link_states"))
    rate_hz = parameters.number("update_rate")
    offer_entity_states(server, context.resources, models, links, rate_hz)
    parameters.report_unread()


def load_properties(context: PluginContext) -> None:
    """Offer properties of models, joints, links and lights."""
    parameters, server = context.reader(PROPERTIES_TABLE), _server(context)
    entities = Entities(server)
    for group in (
        ModelServices(server, entities),
        JointServices(server),
        LinkServices(server, entities),
        LightServices(server),
    ):
        _offer(context, parameters, group.property_rows())
    parameters.report_unread()


def _offer(context: PluginContext, parameters: PluginReader, rows: Iterable[Row]) -> None:
    with context.host.node.announced_together():
        for row in rows:
            context.resources.service(context.topic(parameters, row.name), row.type, row.handler)


def _server(context: PluginContext) -> WorldServer:
    """Return the host, which is always a whole world server."""
    return cast("WorldServer", context.host)

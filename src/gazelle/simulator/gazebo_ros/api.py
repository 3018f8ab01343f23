"""Everything gazebo_ros offers, in one call."""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph.gazebo_names import SHOWN_SPACE, world_space
from gazelle.simulator.gazebo_ros.clock_and_states import offer_states
from gazelle.simulator.gazebo_ros.joint_services import JointServices
from gazelle.simulator.gazebo_ros.link_services import LinkServices
from gazelle.simulator.gazebo_ros.model_services import Entities, ModelServices
from gazelle.simulator.gazebo_ros.physics_parameters import PhysicsParameters
from gazelle.simulator.gazebo_ros.spawn_services import SpawnServices
from gazelle.simulator.gazebo_ros.world_services import LightServices, WorldServices
from gazelle.simulator.plugins.bumper import offer_world_contacts
from gazelle.simulator.plugins.context import join_names

if TYPE_CHECKING:
    from gazelle.simulator.plugins.context import Resources
    from gazelle.simulator.world_server import WorldServer

__all__ = ["ROS2_PLUGINS", "offer_gazebo_ros"]

_INIT, _FACTORY, _STATE = "gazebo_ros_init", "gazebo_ros_factory", "gazebo_ros_state"
_FORCE = "gazebo_ros_force_system"
# Which plug-in of ROS 2's gazebo_ros offers a service.
_PLUGIN_OF = {
    "pause_physics": _INIT,
    "unpause_physics": _INIT,
    "reset_simulation": _INIT,
    "reset_world": _INIT,
    "spawn_entity": _FACTORY,
    "delete_entity": _FACTORY,
    "get_model_list": _FACTORY,
    "get_entity_state": _STATE,
    "set_entity_state": _STATE,
    "apply_link_wrench": _FORCE,
    "clear_link_wrenches": _FORCE,
    "apply_joint_effort": _FORCE,
    "clear_joint_efforts": _FORCE,
}
ROS2_PLUGINS = frozenset({*_PLUGIN_OF.values(), "gazebo_ros_properties"})


def offer_gazebo_ros(
    server: WorldServer,
    *,
    ros2: Collection[str] = (),
    is_gz: bool = False,
    report: Callable[[Diagnostics], None] = lambda found: None,
    clock_rate_hz: float | None = None,
) -> None:
    """Offer ``/clock`` and ROS 1's services and topics, and set ``/use_sim_time``.

    ROS 1 has them below ``/gazebo``; started by ROS 2 or gz, the world hides them.

    Args:
        server: the world.
        ros2: plug-ins of ROS 2's gazebo_ros whose services (``/spawn_entity`` …) are offered.
        is_gz: a command of the new Gazebo started it.
        report: called with what was found about each spawned model.
        clock_rate_hz: how often the clock is told, 0 for every step; ROS 1's parameter when None.
    """
    resources = server.world_resources
    server.node.parameters.set("/use_sim_time", True)
    space = world_space(server.ros_version, is_gz=is_gz)
    offer_states(server, resources, space, clock_rate_hz)
    entities = Entities(server)
    models, links, joints = (
        ModelServices(server, entities),
        LinkServices(server, entities),
        JointServices(server),
    )
    spawns = SpawnServices(server, entities, report)
    world = WorldServices(server, PhysicsParameters(server, resources, space))
    with server.node.announced_together():
        for group in (models, links, joints, spawns, world, LightServices(server)):
            for row in group.rows():
                resources.service(join_names(space, row.name), row.type, row.handler)
            for row in group.ros2_rows():
                if _PLUGIN_OF[row.name] in ros2:
                    resources.service(join_names("/", row.name), row.type, row.handler)
    if not is_gz:
        offer_world_contacts(server, resources)
    if space == SHOWN_SPACE:
        _listen(server, resources, models, links)


def _listen(
    server: WorldServer, resources: Resources, models: ModelServices, links: LinkServices
) -> None:
    """Take the topics that set states, which only ROS 1 has."""

    def log_problem(problem: str) -> None:
        if problem:
            server.node.log("ERROR", problem)

    def set_model_state(message: Any) -> None:
        log_problem(models.set_state(message))

    def set_link_state(message: Any) -> None:
        log_problem(links.set_state(message))

    resources.subscription("/gazebo/set_model_state", "gazebo_msgs/ModelState", set_model_state)
    resources.subscription("/gazebo/set_link_state", "gazebo_msgs/LinkState", set_link_state)

"""Everything gazebo_ros offers, in one call."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostics
from gazelle.simulator.gazebo_ros.entities import Entities
from gazelle.simulator.gazebo_ros.joint_services import JointServices
from gazelle.simulator.gazebo_ros.link_services import LinkServices
from gazelle.simulator.gazebo_ros.model_services import ModelServices
from gazelle.simulator.gazebo_ros.physics_parameters import PhysicsParameters
from gazelle.simulator.gazebo_ros.spawn_services import SpawnServices
from gazelle.simulator.gazebo_ros.states import offer_states
from gazelle.simulator.gazebo_ros.world_services import WorldServices
from gazelle.simulator.plugins.context import join_names

if TYPE_CHECKING:
    from gazelle.simulator.world_server import WorldServer

__all__ = ["offer_gazebo_ros"]


def offer_gazebo_ros(
    server: WorldServer,
    *,
    ros2: bool = False,
    report: Callable[[Diagnostics], None] = lambda found: None,
    clock_rate_hz: float | None = None,
) -> None:
    """Offer ``/clock`` and ``/gazebo/*``, and set ``/use_sim_time``.

    Args:
        server: the world.
        ros2: offer the services of ROS 2's gazebo_ros (``/spawn_entity`` …) as well.
        report: called with what was found about each spawned model.
        clock_rate_hz: how often the clock is told, 0 for every step; ROS 1's parameter when None.
    """
    resources = server.world_resources
    server.node.parameters.set("/use_sim_time", True)
    offer_states(server, resources, clock_rate_hz)
    entities = Entities(server)
    models, links, joints = (
        ModelServices(server, entities),
        LinkServices(server, entities),
        JointServices(server),
    )
    spawns = SpawnServices(server, entities, report)
    world = WorldServices(server, PhysicsParameters(server, resources))
    for group in (models, links, joints, spawns, world):
        for row in group.rows():
            resources.service(join_names("/gazebo", row.name), row.type, row.handler)
        for row in group.ros2_rows() if ros2 else ():
            resources.service(join_names("/", row.name), row.type, row.handler)

    if server.ros_version == 2:
        # These topics are ROS 1's.
        return

    def log_problem(problem: str) -> None:
        if problem:
            server.node.log("ERROR", problem)

    def set_model_state(message: Any) -> None:
        log_problem(models.set_state(message))

    def set_link_state(message: Any) -> None:
        log_problem(links.set_state(message))

    resources.subscription("/gazebo/set_model_state", "gazebo_msgs/ModelState", set_model_state)
    resources.subscription("/gazebo/set_link_state", "gazebo_msgs/LinkState", set_link_state)

"""``/clock``, and the states of models and links."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gazelle.geometry import Pose
from gazelle.graph import Publisher
from gazelle.graph.shared_clock_discovery import share_clock
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import pose_message, twist_message
from gazelle.interfaces.stamps import stamp_message
from gazelle.simulator.plugins.context import join_names
from gazelle.simulator.scheduler import ORDER_CLOCK, ORDER_STATE, period_in_steps
from gazelle.simulator.wall_clock import Mode

if TYPE_CHECKING:
    from gazelle.graph.shared_clock_discovery import SharedClock
    from gazelle.simulator.node_interfaces import PublisherPort
    from gazelle.simulator.plugins.context import Resources
    from gazelle.simulator.world_server import WorldServer

__all__ = ["offer_clock", "offer_entity_states", "offer_states"]

_CLOCK = "/clock"
# Faster than real time, nobody can use more of them: each costs every process 0.1 ms.
_CLOCKS_PER_REAL_S = 500.0


def offer_states(
    server: WorldServer, resources: Resources, space: str, clock_rate_hz: float | None = None
) -> None:
    """Publish clock and, in a namespace, states every step while somebody listens.

    ``clock_rate_hz``, or the ROS parameter ``/gazebo/pub_clock_frequency``, lowers the clock's
    rate, as in gazebo_ros; 0 is every step.
    A world that is to run faster than real time shows the clock 500 times a second of real time.
    """
    rate_hz = clock_rate_hz
    if rate_hz is None:
        rate_hz = float(server.node.parameters.get("/gazebo/pub_clock_frequency", 0.0))
    offer_clock(server, resources, _CLOCK, rate_hz)
    models, links = (join_names(space, f"{one}_states") for one in ("model", "link"))
    offer_entity_states(server, resources, models, links)


def offer_entity_states(
    server: WorldServer,
    resources: Resources,
    models_topic: str,
    links_topic: str,
    rate_hz: float = 0.0,
) -> None:
    """Publish the states of all models and links while somebody listens; at 0 Hz each step."""
    period = period_in_steps(rate_hz, server.engine.step_ns)
    links = resources.publisher(links_topic, "gazebo_msgs/LinkStates", reliable=False)
    models = resources.publisher(models_topic, "gazebo_msgs/ModelStates", reliable=False)
    resources.task(
        links_topic,
        period,
        lambda: links.publish(_link_states(server)),
        order=ORDER_STATE,
        wanted=lambda: links.matched,
    )
    resources.task(
        models_topic,
        period,
        lambda: models.publish(_model_states(server)),
        order=ORDER_STATE,
        wanted=lambda: models.matched,
    )


def offer_clock(server: WorldServer, resources: Resources, topic: str, rate_hz: float) -> None:
    """Publish the world's time while somebody listens, each step at 0 Hz."""
    engine = server.engine
    clock = resources.publisher(topic, "rosgraph_msgs/Clock")
    shared = _shared(server, resources, clock) if topic == _CLOCK else None

    def publish_clock() -> None:
        if not server.paused and engine.iteration % _steps_between_clocks(server):
            return
        if shared is not None and shared.is_on:
            shared.show(engine.time_ns)
        if clock.matched:
            clock.publish(message_type("rosgraph_msgs/Clock")(clock=stamp_message(engine.time_ns)))

    def wanted() -> bool:
        if shared is not None:
            # As fast as possible: then messages hold time up until everybody has them.
            shared.turn(on=server.pace.factor > 0 and shared.is_used)
        return clock.matched or (shared is not None and shared.is_on)

    resources.task(
        topic,
        period_in_steps(rate_hz, engine.step_ns),
        publish_clock,
        order=ORDER_CLOCK,
        wanted=wanted,
    )


def _shared(server: WorldServer, resources: Resources, clock: PublisherPort) -> SharedClock | None:
    """Return what shows the world's time to other processes, None where all wait for messages.

    In the modes that wait for nobody's wall clock, whatever is published waits for its readers.
    """
    if server.mode is not Mode.REAL_TIME or not isinstance(clock, Publisher):
        return None
    shared = share_clock(clock)
    if shared is not None:
        resources.on_close(shared.close)
    return shared


def _steps_between_clocks(server: WorldServer) -> int:
    """Return 1 up to real time, and where no rate is wanted."""
    factor = server.pace.factor
    if factor <= 1.0:
        return 1
    return math.ceil(factor * 1e9 / (server.engine.step_ns * _CLOCKS_PER_REAL_S))


def _link_states(server: WorldServer) -> Any:
    engine = server.engine
    snapshot = engine.snapshot()
    message = message_type("gazebo_msgs/LinkStates")(name=list(snapshot.link_names))
    for name, row in zip(snapshot.link_names, snapshot.T.tolist(), strict=True):
        pose = Pose((row[0], row[1], row[2]), (row[3], row[4], row[5], row[6]))
        message.pose.append(pose_message(pose))
        message.twist.append(twist_message(*engine.link(name).velocity_world()))
    return message


def _model_states(server: WorldServer) -> Any:
    engine = server.engine
    names = [model.name for model in engine.world.models]
    message = message_type("gazebo_msgs/ModelStates")(name=names)
    for name in names:
        message.pose.append(pose_message(engine.model_pose(name)))
        message.twist.append(twist_message(*engine.model_velocity(name)))
    return message

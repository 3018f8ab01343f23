"""What every world of the new Gazebo tells: statistics, clock and poses under ``/world/NAME``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from gazelle.interfaces import message_type
from gazelle.interfaces.poses import transform_stamped
from gazelle.interfaces.stamps import stamp_message
from gazelle.simulator.gazebo_ros.clock_and_states import offer_clock

if TYPE_CHECKING:
    from gazelle.description.model import Model
    from gazelle.simulator.plugins.context import Resources
    from gazelle.simulator.world_server import WorldServer

__all__ = ["GzTopics"]

_STATISTICS = "gazelle_msgs/WorldStatistics"
_POSES = "tf2_msgs/TFMessage"


class GzTopics:
    """Publishes what is listened to; `Broadcast` says when."""

    def __init__(self, server: WorldServer, resources: Resources) -> None:
        """Offer ``/stats`` and, below ``/world/NAME``, stats, clock and both poses."""
        self._server = server
        world = f"/world/{server.engine.world.name}"
        self._stats = [
            resources.publisher(name, _STATISTICS, reliable=False)
            for name in (f"{world}/stats", "/stats")
        ]
        self._poses = {
            name: resources.publisher(f"{world}/{name}/info", _POSES, reliable=False)
            for name in ("pose", "dynamic_pose")
        }
        offer_clock(server, resources, f"{world}/clock", rate_hz=0.0)

    def wants_statistics(self) -> bool:
        """Tell whether somebody listens to the statistics."""
        return any(one.matched for one in self._stats)

    def send_statistics(self, value: Mapping[str, Any]) -> None:
        """Publish the statistics that viewers have."""
        message = _gz_statistics(value)
        for publisher in self._stats:
            if publisher.matched:
                publisher.publish(message)

    def send_poses(self) -> None:
        """Publish where models are in the world and links in their models.

        The dynamic ones leave out models that are static.
        """
        for name, publisher in self._poses.items():
            if publisher.matched:
                models = self._server.engine.world.models
                shown = [one for one in models if name == "pose" or not one.static]
                rows = [row for model in shown for row in self._transforms(model)]
                publisher.publish(message_type(_POSES)(transforms=rows))

    def _transforms(self, model: Model) -> Iterator[Any]:
        engine = self._server.engine
        T_world_model = engine.model_pose(model.name)
        yield transform_stamped(engine.time_ns, engine.world.name, model.name, T_world_model)
        T_model_world = T_world_model.inverse()
        for link in model.links:
            T_model_link = T_model_world @ engine.link(f"{model.name}::{link.name}").T_world_link()
            frame = f"{model.name}/{link.name}".replace("::", "/")
            yield transform_stamped(engine.time_ns, model.name, frame, T_model_link)


def _gz_statistics(value: Mapping[str, Any]) -> Any:
    def time_of(seconds: float) -> Any:
        return stamp_message(round(seconds * 1e9))

    return message_type("gazelle_msgs/WorldStatistics")(
        sim_time=time_of(value["sim_s"]),
        real_time=time_of(value["real_s"]),
        paused=value["paused"],
        iterations=value["iterations"],
        real_time_factor=value["rtf"],
        step_size=time_of(value["step_s"]),
    )

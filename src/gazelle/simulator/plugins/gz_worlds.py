"""Which worlds are those of gz-sim."""

from __future__ import annotations

from gazelle.description.model import World
from gazelle.simulator.plugins.gz_systems import TABLE as GZ_SYSTEMS
from gazelle.simulator.plugins.registry import plain_name

__all__ = ["is_gz_world"]

_SYSTEMS = ("gz-sim", "ignition-gazebo")


def is_gz_world(world: World) -> bool:
    """Tell whether a world loads systems of gz-sim.

    Those that serve all models may stand in a model as well (``Sensors``, ``Imu``, …).
    """
    if any(plain_name(plugin.filename).startswith(_SYSTEMS) for plugin in world.plugins):
        return True
    plugins = (plugin for model in world.models for plugin in model.plugins)
    return any(plain_name(plugin.filename) in GZ_SYSTEMS.parameters.types for plugin in plugins)

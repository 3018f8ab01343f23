"""What a plug-in of the user's own derives from."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

if TYPE_CHECKING:
    from gazelle.simulator.plugins.user.views import PluginNode, PluginParameters, WorldOfPlugin
    from gazelle.simulator.simulation_handles import ModelOfSimulation, SensorOfSimulation

__all__ = ["ModelPlugin", "Plugin", "SensorPlugin", "WorldPlugin"]


class Plugin:
    """Hooks that every plug-in may have; those it does not write cost nothing.

    Attributes:
        update_rate_hz: how often `on_update` is called; None for every step, and for the rate of
            the sensor that a sensor plug-in stands in.
    """

    update_rate_hz: ClassVar[float | None] = None

    def on_update(self, time_s: float) -> None:
        """Called between two steps, at simulated time."""

    def on_reset(self) -> None:
        """Called after the world was put back to its start."""

    def close(self) -> None:
        """Called when the model goes or the world ends; topics are closed without it."""


class WorldPlugin(Plugin):
    """A ``<plugin>`` that stands in a ``<world>``."""

    def load(self, world: WorldOfPlugin, parameters: PluginParameters, node: PluginNode) -> None:
        """Called once, before the first step."""


class ModelPlugin(Plugin):
    """A ``<plugin>`` that stands in a ``<model>``, or in a ``<gazebo>`` of a URDF."""

    def load(
        self, model: ModelOfSimulation, parameters: PluginParameters, node: PluginNode
    ) -> None:
        """Called once, when the model enters the world."""


class SensorPlugin(Plugin):
    """A ``<plugin>`` that stands in a ``<sensor>``."""

    def load(
        self, sensor: SensorOfSimulation, parameters: PluginParameters, node: PluginNode
    ) -> None:
        """Called once, when the sensor's model enters the world."""

"""Plug-ins of your own in Python: derive from the class of the place they stand in."""

from __future__ import annotations

from gazelle.simulator.plugins.user.base import ModelPlugin, Plugin, SensorPlugin, WorldPlugin
from gazelle.simulator.plugins.user.views import PluginNode, PluginParameters, WorldOfPlugin

__all__ = [
    "ModelPlugin",
    "Plugin",
    "PluginNode",
    "PluginParameters",
    "SensorPlugin",
    "WorldOfPlugin",
    "WorldPlugin",
]

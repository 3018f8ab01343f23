"""Plug-ins of your own in Python: derive from the class of the place they stand in."""

from __future__ import annotations

from gazelle.simulator.plugins.user.plugin_api import (
    ModelPlugin,
    Plugin,
    PluginNode,
    PluginParameters,
    SensorPlugin,
    WorldOfPlugin,
    WorldPlugin,
)

__all__ = [
    "ModelPlugin",
    "Plugin",
    "PluginNode",
    "PluginParameters",
    "SensorPlugin",
    "WorldOfPlugin",
    "WorldPlugin",
]

"""Plug-ins that are known by name: what they would do, and what there is instead."""

from __future__ import annotations

from gazelle.parameters import ParameterTable
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.plugins.registry import looked_up, plain_name

__all__ = ["NOTHING_TABLE", "TABLE", "load", "load_nothing"]


# Name, and what does not happen; each says what to use instead where there is something.
_MISSING = {
    "gazebo_ros_elevator": "the elevator does not move to floors on command; drive its lift joint "
    "with a position controller",
    "ElevatorPlugin": "the elevator does not move to floors on command; drive its lift joint with "
    "a position controller",
    "gz-sim-elevator-system": "the elevator does not move to floors on command; drive its lift "
    "joint with a position controller",
    "gazebo_ros_harness": "the model is not held by a harness; pause the world until it is to fall",
    "HarnessPlugin": "the model is not held by a harness; pause the world until it is to fall",
    "gazebo_ros_video": "no pictures are shown on the visual; cameras see its material",
    "gazebo_ros_projector": "no picture is projected; cameras see the scene without it",
    "gazebo_ros_triggered_multicamera": "pictures are not taken on a trigger; use "
    "gazebo_ros_multicamera, which publishes at the sensor's rate",
    "ActorPlugin": "actors do not walk around obstacles",
    "BuoyancyPlugin": "nothing floats",
    "gz-sim-buoyancy-system": "nothing floats",
    "LiftDragPlugin": "wings and rotors feel no air",
    "gz-sim-lift-drag-system": "wings and rotors feel no air",
    "WindPlugin": "links feel no wind",
    "gz-sim-wind-effects-system": "links feel no wind",
    "gz-sim-logical-camera-system": "logical cameras see nothing; use the models' poses",
    "gz-sim-thermal-system": "thermal cameras see nothing",
    "gz-sim-air-speed-system": "air speed sensors give no data",
    "gz-sim-python-system-loader-system": "systems in Python need gz's own bindings; write a "
    "plug-in of Gazelle's in Python instead (docs/howto/own_plugin.md)",
    "gz-sim-dvl-system": "Doppler velocity logs give no data",
}

# What gz-sim's systems were called before their project was renamed.
_MISSING |= {
    f"ignition-gazebo-{name.removeprefix('gz-sim-')}": meaning
    for name, meaning in _MISSING.items()
    if name.startswith("gz-sim-")
}

_NOTHING = {
    "gazebo_ros_template": "a template to copy, which does nothing in Gazebo either",
    "gazebo_ros_utils": "a library for other plug-ins, none itself",
    "gazebo_ros_camera_utils": "a library for other plug-ins, none itself",
    "MultiCameraPlugin": "the base of gazebo_ros_multicamera, which publishes nothing itself",
    "CameraPlugin": "the base of camera plug-ins, which publishes nothing itself",
    "DepthCameraPlugin": "the base of depth camera plug-ins, which publishes nothing itself",
    "RayPlugin": "the base of laser plug-ins, which publishes nothing itself",
    "ContactPlugin": "the base of contact plug-ins, which publishes nothing itself",
    "ImuSensorPlugin": "the base of IMU plug-ins, which publishes nothing itself",
}

TABLE = PluginTable(
    ParameterTable(
        "known by name",
        "Plug-ins that are known and not simulated; a warning says what does not happen.",
        tuple(_MISSING),
    ),
    behaviour=tuple(f"`{name}`: {meaning}." for name, meaning in _MISSING.items()),
)

NOTHING_TABLE = PluginTable(
    ParameterTable(
        "without effect",
        "Libraries that do nothing by themselves in Gazebo either.",
        tuple(_NOTHING),
    ),
    behaviour=tuple(f"`{name}`: {meaning}." for name, meaning in _NOTHING.items()),
)


def load(context: PluginContext) -> None:
    """Say what does not happen."""
    _report(context, "plugin.named-only", _MISSING)


def load_nothing(context: PluginContext) -> None:
    """Say that there is nothing to do."""
    _report(context, "plugin.without-effect", _NOTHING)


def _report(context: PluginContext, code: str, meanings: dict[str, str]) -> None:
    plugin = context.plugin
    wanted = looked_up(plugin)
    meaning = next(text for name, text in meanings.items() if plain_name(name) in wanted)
    context.report(code, f"plug-in '{plugin.name}' ({plugin.filename}): {meaning}")

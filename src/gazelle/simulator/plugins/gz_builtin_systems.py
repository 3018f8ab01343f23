"""gz-sim systems and gazebo_ros plug-ins that are always there; which worlds are gz-sim's."""

from __future__ import annotations

from gazelle.description.model import World
from gazelle.parameters import ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.plugins.registry import plain_name

__all__ = ["BUILT_IN", "SERVER_TABLE", "TABLE", "is_gz_world", "load"]


BUILT_IN = (
    "physics",
    "user-commands",
    "scene-broadcaster",
    "sensors",
    "imu",
    "contact",
    "forcetorque",
    "navsat",
    "altimeter",
    "magnetometer",
    "air-pressure",
    "log",
    "log-record",
)

TABLE = PluginTable(
    ParameterTable(
        "gz-sim systems",
        "Systems a gz-sim world names and Gazelle always has.",
        (
            *(f"gz-sim-{name}-system" for name in BUILT_IN),
            *(f"ignition-gazebo-{name}-system" for name in BUILT_IN),
        ),
    ),
    topics=(
        Topic("{topic}, {topic}/points", "LaserScan and PointCloud2 of lidars", rate="sensor's"),
        Topic("{topic}, camera_info beside it", "Image and CameraInfo of cameras", rate="sensor's"),
        Topic(
            "{topic}/image, /depth_image, /points, /camera_info",
            "of RGB-D cameras",
            rate="sensor's",
        ),
        Topic("{topic}", "sensor_msgs/msg/Imu", rate="sensor's"),
        Topic(
            "{contact/topic}", "ros_gz_interfaces/msg/Contacts", rate="every step with a contact"
        ),
        Topic("{topic} (…/forcetorque)", "geometry_msgs/msg/WrenchStamped", rate="sensor's"),
        Topic("{topic} (…/navsat)", "sensor_msgs/msg/NavSatFix", rate="sensor's"),
        Topic("{topic} (…/magnetometer)", "sensor_msgs/msg/MagneticField", rate="sensor's"),
        Topic("{topic} (…/altimeter)", "ros_gz_interfaces/msg/Altimeter", rate="sensor's"),
        Topic("{topic} (…/air_pressure)", "sensor_msgs/msg/FluidPressure", rate="sensor's"),
    ),
    behaviour=(
        "Their parameters have no effect; a notice says so once.",
        "In a world that names one, sensors without a plug-in of their own publish on their"
        " `<topic>`, by default `/world/W/model/M/link/L/sensor/S/…`, as the ROS types that"
        " `ros_gz_bridge` maps them to.",
    ),
)

SERVER_TABLE = PluginTable(
    ParameterTable(
        "gazebo_ros server plug-ins",
        "ROS 1's services and topics under /gazebo; ROS 2's of each plug-in that is named.",
        (
            "gazebo_ros_api_plugin",
            "gazebo_ros_paths_plugin",
            "gazebo_ros_init",
            "gazebo_ros_factory",
            "gazebo_ros_force_system",
        ),
    ),
)


def load(context: PluginContext) -> None:
    """Say that the plug-in is built in."""
    text = f"plug-in '{context.plugin.name}' ({context.plugin.filename}) is part of Gazelle"
    context.report("plugin.built-in", text)


_SYSTEMS = ("gz-sim", "ignition-gazebo")


def is_gz_world(world: World) -> bool:
    """Tell whether a world loads systems of gz-sim.

    Those that serve all models may stand in a model as well (``Sensors``, ``Imu``, …).
    """
    if any(plain_name(plugin.filename).startswith(_SYSTEMS) for plugin in world.plugins):
        return True
    plugins = (plugin for model in world.models for plugin in model.plugins)
    return any(plain_name(plugin.filename) in TABLE.parameters.types for plugin in plugins)

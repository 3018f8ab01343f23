"""Displays by RViz's class names, and the streams that show messages."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.studio.displays.cameras import open_camera, open_image, open_picture
from gazelle.studio.displays.depth_cloud import open_depth_cloud
from gazelle.studio.displays.maps import open_map
from gazelle.studio.displays.markers import open_interactive, open_markers
from gazelle.studio.displays.plain import open_plain
from gazelle.studio.displays.points import open_points
from gazelle.studio.displays.showing import Site, open_on
from gazelle.studio.displays.turtles import open_turtles
from gazelle.studio.errors import unknown
from gazelle.studio.params import Params
from gazelle.studio.session import Studio
from gazelle.studio.streams import Channel, OpenStream, StreamKind

__all__ = ["DISPLAYS", "STREAMS"]

DISPLAYS: dict[str, Callable[[Site], OpenStream]] = {
    "Camera": open_camera,
    "DepthCloud": open_depth_cloud,
    "Effort": open_plain,
    "FluidPressure": open_plain,
    "GridCells": open_plain,
    "Illuminance": open_plain,
    "Image": open_picture,
    "Imu": open_plain,
    "InteractiveMarkers": open_interactive,
    "LaserScan": open_points,
    "Map": open_map,
    "Marker": open_markers,
    "MarkerArray": open_markers,
    "Odometry": open_plain,
    "ParticleCloud": open_plain,
    "Path": open_plain,
    "PointCloud": open_points,
    "PointCloud2": open_points,
    "PointStamped": open_plain,
    "Polygon": open_plain,
    "Pose": open_plain,
    "PoseArray": open_plain,
    "PoseWithCovariance": open_plain,
    "Range": open_plain,
    "RelativeHumidity": open_plain,
    "Temperature": open_plain,
    "WrenchStamped": open_plain,
}
"""Class names without ``rviz/``."""

_ALIASES = {"Wrench": "WrenchStamped"}


def _open_display(studio: Studio, channel: Channel, params: Params) -> OpenStream:
    name = params.text("display").rpartition("/")[2]
    opener = DISPLAYS.get(_ALIASES.get(name, name))
    if opener is None:
        raise unknown("display", name, DISPLAYS)
    return open_on(Site(studio, channel, params), opener)


STREAMS: dict[str, StreamKind] = {
    "display": StreamKind(latest=True, open=_open_display),
    "image": StreamKind(latest=True, open=open_image),
    "turtles": StreamKind(latest=True, open=open_turtles),
}

"""SDF ``<scene>`` and ``<spherical_coordinates>``."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description.model import Scene, SphericalCoordinates
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_bool, child_float, child_rgba
from gazelle.description.sdf_reader.poses import pose_of, read_pose
from gazelle.description.xml import Tag
from gazelle.geometry import Pose

__all__ = ["read_scene", "read_spherical_coordinates"]

_DEFAULTS = Scene()


def read_scene(world: Tag, context: ReadContext) -> Scene:
    """Return how the world looks where nothing stands in the way."""
    view = _view(world, context)
    tag = world.find("scene")
    if tag is None:
        return replace(_DEFAULTS, T_world_view=view)
    return Scene(
        ambient=child_rgba(tag, "ambient", _DEFAULTS.ambient, context),
        background=child_rgba(tag, "background", _DEFAULTS.background, context),
        sky=tag.find("sky") is not None,
        shadows=child_bool(tag, "shadows", True, context),
        grid=child_bool(tag, "grid", True, context),
        T_world_view=view,
        span=tag.span,
    )


def _view(world: Tag, context: ReadContext) -> Pose | None:
    """Return where a window's camera is: Gazebo Classic's, or that of a gz window's 3D view."""
    gui = world.find("gui")
    if gui is None:
        return None
    camera = gui.find("camera")
    if camera is not None and camera.find("pose") is not None:
        return pose_of(camera, context)
    for plugin in gui.find_all("plugin"):
        pose = plugin.find("camera_pose")
        if pose is not None:
            return read_pose(pose, context)
    return None


def read_spherical_coordinates(world: Tag, context: ReadContext) -> SphericalCoordinates | None:
    """Return where the world lies on Earth; its axes are east, north and up."""
    tag = world.find("spherical_coordinates")
    if tag is None:
        return None
    orientation = tag.find("world_frame_orientation")
    if orientation is not None and orientation.text.upper() not in ("", "ENU"):
        message = f"world_frame_orientation '{orientation.text}' is not supported; ENU is used"
        context.diagnostics.report("sdf.bad-value", message, orientation.span, fix="write ENU")
    return SphericalCoordinates(
        latitude_deg=child_float(tag, "latitude_deg", 0.0, context),
        longitude_deg=child_float(tag, "longitude_deg", 0.0, context),
        elevation_m=child_float(tag, "elevation", 0.0, context),
        heading_deg=child_float(tag, "heading_deg", 0.0, context),
    )

"""SDF ``<camera>``: image, clip, lens, depth clip and distortion."""

from __future__ import annotations

import math
from dataclasses import replace

from gazelle.description.model import CameraSpec, LensDistortion
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import (
    child_float,
    child_int,
    optional_float,
    optional_int,
)
from gazelle.description.sdf_reader.noise import read_noise
from gazelle.description.sdf_reader.poses import pose_of
from gazelle.description.xml import Tag, floats_from

__all__ = ["read_camera", "read_multicamera"]

_DEFAULTS = CameraSpec()
_MIN_FOV_RAD = 0.01


def read_camera(tag: Tag | None, kind: str, context: ReadContext) -> CameraSpec:
    """Return the camera of a ``<camera>`` element; SDF's defaults when it is None.

    Args:
        tag: the ``<camera>`` element.
        kind: ``rgb``, ``depth``, ``rgbd`` or ``wideangle``.
        context: where problems are reported.
    """
    if tag is None:
        return replace(_DEFAULTS, kind=kind)
    image, clip = tag.find("image") or tag, tag.find("clip") or tag
    depth_clip = tag.find("depth_camera", "clip")
    return CameraSpec(
        name=tag.attributes.get("name", _DEFAULTS.name),
        kind=kind,
        T_sensor_camera=pose_of(tag, context),
        horizontal_fov_rad=_horizontal_fov(tag, kind, context),
        width_px=_pixels(image, "width", _DEFAULTS.width_px, context),
        height_px=_pixels(image, "height", _DEFAULTS.height_px, context),
        pixel_format=image.text_of("format", default=_DEFAULTS.pixel_format),
        near_m=child_float(clip, "near", _DEFAULTS.near_m, context),
        far_m=child_float(clip, "far", _DEFAULTS.far_m, context),
        depth_near_m=optional_float(depth_clip, "near", context),
        depth_far_m=optional_float(depth_clip, "far", context),
        noise=read_noise(tag.find("noise"), context),
        distortion=_distortion(tag.find("distortion"), context),
        intrinsics=_intrinsics(tag.find("lens", "intrinsics"), context),
        optical_frame_id=tag.text_of("optical_frame_id"),
        camera_info_topic=tag.text_of("camera_info_topic"),
        visibility_mask=_mask(tag, context),
    )


def read_multicamera(tag: Tag, context: ReadContext) -> CameraSpec:
    """Return a multicamera: the first camera with all of them as its members."""
    members = tuple(read_camera(child, "rgb", context) for child in tag.find_all("camera"))
    first = members[0] if members else _DEFAULTS
    return replace(first, members=members)


def _mask(tag: Tag, context: ReadContext) -> int:
    mask = optional_int(tag, "visibility_mask", context)
    return _DEFAULTS.visibility_mask if mask is None else mask & _DEFAULTS.visibility_mask


def _pixels(image: Tag, name: str, default: int, context: ReadContext) -> int:
    value = child_int(image, name, default, context)
    if value >= 1:
        return value
    found = image.find(name) or image
    message = f"<{name}> is {value}; an image needs at least 1 pixel, {default} are used"
    context.diagnostics.report("sdf.bad-value", message, found.span)
    return default


def _horizontal_fov(tag: Tag, kind: str, context: ReadContext) -> float:
    """Return the angle, which is at most π (2π for wide-angle lenses)."""
    value = child_float(tag, "horizontal_fov", _DEFAULTS.horizontal_fov_rad, context)
    most = 2 * math.pi if kind == "wideangle" else math.radians(179.9)
    kept = min(max(value, _MIN_FOV_RAD), most)
    if kept != value:
        found = tag.find("horizontal_fov") or tag
        message = f"<horizontal_fov> is {value:g} rad; {kept:g} rad is used"
        context.diagnostics.report(
            "sdf.bad-value", message, found.span, fix="write an angle in radians, such as 1.047"
        )
    return kept


def _distortion(tag: Tag | None, context: ReadContext) -> LensDistortion | None:
    if tag is None:
        return None
    values = {name: child_float(tag, name, 0.0, context) for name in ("k1", "k2", "k3", "p1", "p2")}
    return LensDistortion(**values, center=_center(tag.find("center"), context))


def _center(tag: Tag | None, context: ReadContext) -> tuple[float, float]:
    middle = (0.5, 0.5)
    if tag is None or not tag.text:
        return middle
    x, y = floats_from(
        tag.text, 2, middle, what="<center>", span=tag.span, diagnostics=context.diagnostics
    )
    return x, y


def _intrinsics(
    tag: Tag | None, context: ReadContext
) -> tuple[float, float, float, float, float] | None:
    """Return fx, fy, cx, cy, s with the defaults of SDF 1.6 and later."""
    if tag is None:
        return None
    return (
        child_float(tag, "fx", 277.0, context),
        child_float(tag, "fy", 277.0, context),
        child_float(tag, "cx", 160.0, context),
        child_float(tag, "cy", 120.0, context),
        child_float(tag, "s", 0.0, context),
    )

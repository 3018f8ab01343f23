"""SDF ``<ray>`` and ``<lidar>``: scan and range."""

from __future__ import annotations

from gazelle.description.model import LidarSpec
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import child_float, child_int
from gazelle.description.sdf_reader.noise import read_noise
from gazelle.description.xml import Tag

__all__ = ["read_lidar"]

_DEFAULT_SAMPLES = 640


def read_lidar(tag: Tag | None, context: ReadContext, *, on_collisions: bool) -> LidarSpec:
    """Return the lidar of a ``<ray>`` or ``<lidar>`` element.

    Args:
        tag: the element; None means SDF's defaults.
        context: where problems are reported.
        on_collisions: True for ``ray``, which hits collisions; False for kinds that see visuals.
    """
    if tag is None:
        return LidarSpec(on_collisions=on_collisions)
    horizontal = tag.find("scan", "horizontal") or tag
    vertical, reach = tag.find("scan", "vertical"), tag.find("range") or tag
    return LidarSpec(
        samples=_samples(horizontal, _DEFAULT_SAMPLES, context),
        min_angle_rad=child_float(horizontal, "min_angle", 0.0, context),
        max_angle_rad=child_float(horizontal, "max_angle", 0.0, context),
        resolution=child_float(horizontal, "resolution", 1.0, context),
        vertical_samples=_samples(vertical, 1, context) if vertical else 1,
        vertical_min_angle_rad=child_float(vertical, "min_angle", 0.0, context) if vertical else 0,
        vertical_max_angle_rad=child_float(vertical, "max_angle", 0.0, context) if vertical else 0,
        vertical_resolution=child_float(vertical, "resolution", 1.0, context) if vertical else 1,
        range_min_m=child_float(reach, "min", 0.0, context),
        range_max_m=_range_max(reach, context),
        range_resolution_m=child_float(reach, "resolution", 0.0, context),
        noise=read_noise(tag.find("noise"), context),
        on_collisions=on_collisions,
    )


def _samples(tag: Tag, default: int, context: ReadContext) -> int:
    value = child_int(tag, "samples", default, context)
    if value >= 1:
        return value
    found = tag.find("samples") or tag
    context.diagnostics.report(
        "sdf.bad-value", f"<samples> is {value}; a scan needs at least 1, 1 is used", found.span
    )
    return 1


def _range_max(tag: Tag, context: ReadContext) -> float:
    """Return the range; ``inf``, which SDF 1.6 and later allow, is no mistake."""
    found = tag.find("max")
    if found is not None and found.text.strip().lower() in ("inf", "+inf"):
        return float("inf")
    return child_float(tag, "max", 0.0, context)

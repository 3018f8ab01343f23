"""Compares a drive's parameters with the robot's geometry and decides what legacyMode means."""

from __future__ import annotations

from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader
from gazelle.simulator.plugins.wheel_geometry import DriveGeometry, drive_geometry

__all__ = ["check_drive", "exchange_wheels"]

# Parameters within 2 % of the geometry count as the geometry's.
_TOLERANCE = 0.02


def exchange_wheels(
    context: PluginContext, parameters: PluginReader, wheels: tuple[str, str]
) -> bool:
    """Tell whether the wheels change places: ``legacyMode``, or the geometry where it is absent."""
    if parameters.has("legacyMode"):
        exchanged = parameters.flag("legacyMode")
        if exchanged:
            text = "<legacyMode> true exchanges the wheels, as Gazebo did up to ROS Kinetic; later "
            text += "releases ignore the word and would turn the robot the other way"
            context.report("plugin.legacy-mode", text)
        return exchanged
    if parameters.is_ros2():
        return False
    exchanged = not _geometry(context, wheels).turns_left(exchanged=False)
    if exchanged:
        text = "<legacyMode> is absent; the wheels are driven exchanged, so that a positive yaw "
        text += "command turns left"
        context.report("plugin.legacy-mode", text)
    return exchanged


def check_drive(
    context: PluginContext,
    wheels: tuple[str, str],
    separation_m: float,
    diameter_m: float,
    *,
    exchanged: bool,
) -> None:
    """Report wheel parameters that the geometry contradicts and drives that turn the wrong way."""
    geometry = _geometry(context, wheels)
    _check_sizes(context, geometry, separation_m, diameter_m)
    name = f"plug-in '{context.plugin.name}'"
    left, right = (wheel.split("::", 1)[1] for wheel in wheels)
    if geometry.forward < 0:
        text = f"{name}: positive speed of '{left}' and '{right}' drives the robot backward"
        context.report("plugin.drives-backwards", text)
    if not geometry.turns_left(exchanged=exchanged):
        side = "left" if geometry.left_is_left else "right"
        text = f"{name}: a positive yaw command turns the robot right: '{left}', named as the left"
        text += f" joint, stands on the {side}"
        text += ", and legacyMode exchanges the wheels" if exchanged else ""
        context.report("plugin.wheels-swapped", text)


def _geometry(context: PluginContext, wheels: tuple[str, str]) -> DriveGeometry:
    left, right = (context.model.joint(name.split("::", 1)[1]) for name in wheels)
    assert left is not None
    assert right is not None
    return drive_geometry(context.model, left, right)


def _check_sizes(
    context: PluginContext, geometry: DriveGeometry, separation_m: float, diameter_m: float
) -> None:
    wrong = []
    if _differs(separation_m, geometry.separation_m):
        wrong.append(
            f"wheel separation is {separation_m:g} m, the joints are {geometry.separation_m:.4g} m"
            " apart"
        )
    radii = [r for r in (geometry.left_radius_m, geometry.right_radius_m) if r is not None]
    if radii and _differs(diameter_m, 2 * max(radii)):
        wrong.append(
            f"wheel diameter is {diameter_m:g} m, the wheels' shapes measure {2 * max(radii):.4g} m"
        )
    if wrong:
        text = f"plug-in '{context.plugin.name}': " + "; ".join(wrong)
        factor = 2 * max(radii) / diameter_m if radii and diameter_m > 0 else 1.0
        text += f". Commanded speeds are met {factor:.2f} times, yaw rates differ too"
        context.report("plugin.wheel-geometry", text)


def _differs(value: float, truth: float) -> bool:
    return abs(value - truth) > _TOLERANCE * max(truth, 1e-9)

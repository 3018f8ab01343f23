"""The true geometry of a differential drive, from joint frames and wheel shapes.

A drive's parameters are compared with it, and it decides what ``legacyMode`` means.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Joint,
    Link,
    MeshShape,
    Model,
    Sphere,
)
from gazelle.errors import GazelleError
from gazelle.simulator.plugins.context import PluginContext
from gazelle.simulator.plugins.plugin_parameters import PluginReader

__all__ = ["DriveGeometry", "check_drive", "drive_geometry", "exchange_wheels", "wheel_radius_m"]


_CIRCLE = np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False)
# Parameters within 2 % of the geometry count as the geometry's.
_TOLERANCE = 0.02


@dataclass(frozen=True, slots=True)
class DriveGeometry:
    """What the model itself says about two driven wheels.

    Attributes:
        separation_m: distance of the joint frames across the direction of travel.
        left_radius_m, right_radius_m: of the joints *named* left and right; None when the wheel
            has no collision shape that can be measured.
        left_is_left: the joint named left stands to the left (+y) of the one named right.
        forward: 1 when positive joint speed drives towards +x of the model, -1 when towards -x,
            0 when the two wheels disagree or the axes are not across.
    """

    separation_m: float
    left_radius_m: float | None
    right_radius_m: float | None
    left_is_left: bool
    forward: int

    def turns_left(self, *, exchanged: bool) -> bool:
        """Tell whether a positive yaw command turns the robot to the left.

        The wheel that is commanded faster for a left turn is the joint named right, or the one
        named left when exchanged; it must be the wheel on the right and drive forward, or the
        wheel on the left and drive backward.
        """
        return (self.left_is_left != exchanged) == (self.forward >= 0)


def drive_geometry(model: Model, left: Joint, right: Joint) -> DriveGeometry:
    """Measure a drive at joint angles of zero."""
    gap = np.subtract(left.T_model_joint.position_m, right.T_model_joint.position_m)
    signs = [_forward_sign(joint) for joint in (left, right)]
    return DriveGeometry(
        separation_m=float(np.linalg.norm(_across(gap, left))),
        left_radius_m=wheel_radius_m(model, left),
        right_radius_m=wheel_radius_m(model, right),
        left_is_left=bool(gap[1] > 0),
        forward=signs[0] if signs[0] == signs[1] else 0,
    )


def wheel_radius_m(model: Model, joint: Joint) -> float | None:
    """Return the largest distance of the wheel's collisions from its axis, None without any."""
    link = model.link(joint.child)
    if link is None or joint.axis is None:
        return None
    radii = [_collision_radius(item, link, joint) for item in link.collisions]
    known = [radius for radius in radii if radius is not None]
    return max(known) if known else None


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


def _across(gap: NDArray[np.float64], joint: Joint) -> NDArray[np.float64]:
    axis = _axis_in_model(joint)
    return np.asarray(np.dot(gap, axis) * axis)


def _axis_in_model(joint: Joint) -> NDArray[np.float64]:
    xyz = joint.axis.xyz if joint.axis is not None else (0.0, 0.0, 1.0)
    axis = np.array(joint.T_model_joint.rotate(xyz))
    return axis / max(float(np.linalg.norm(axis)), 1e-12)


def _forward_sign(joint: Joint) -> int:
    """A wheel rolling on the ground moves along axis × up: +y axes drive towards +x."""
    y = float(_axis_in_model(joint)[1])
    return 0 if abs(y) < 0.5 else (1 if y > 0 else -1)


def _collision_radius(collision: Collision, link: Link, joint: Joint) -> float | None:
    outline = _outline_m(collision)
    if outline is None:
        return None
    points, extra = outline
    T_model_collision = link.T_model_link @ collision.T_link_collision
    from_axis = T_model_collision.transform(points) - np.array(joint.T_model_joint.position_m)
    axis = _axis_in_model(joint)
    radial = from_axis - np.outer(from_axis @ axis, axis)
    return float(np.linalg.norm(radial, axis=1).max()) + extra


def _outline_m(collision: Collision) -> tuple[NDArray[np.float64], float] | None:
    """Return points in the collision's frame and a radius around each of them."""
    shape = collision.shape
    if isinstance(shape, Sphere):
        return np.zeros((1, 3)), shape.radius_m
    if isinstance(shape, Capsule):
        return np.array([[0, 0, -shape.length_m / 2], [0, 0, shape.length_m / 2]]), shape.radius_m
    if isinstance(shape, Cylinder):
        ring = np.stack([np.cos(_CIRCLE), np.sin(_CIRCLE), np.zeros_like(_CIRCLE)], axis=1)
        ring *= shape.radius_m
        half = np.array([0.0, 0.0, shape.length_m / 2])
        return np.concatenate([ring + half, ring - half]), 0.0
    if isinstance(shape, Box):
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
        return signs * np.array(shape.size_m) / 2, 0.0
    if isinstance(shape, MeshShape) and shape.path is not None:
        from gazelle.geometry.mesh_files import load_mesh

        try:
            return load_mesh(shape.path).vertices_m * np.array(shape.scale), 0.0
        except GazelleError:
            # The engine has reported the file; a wheel without a shape has no radius.
            return None
    return None


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

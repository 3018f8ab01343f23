"""Mass and inertia that a moving link needs: checked, legalised, or estimated from its shapes.

Gazebo drops a moving link without inertia together with all that hangs on it, and passes an
impossible tensor to the physics engine. Here no link is ever dropped. Links joined by fixed
joints move as one body, so only a whole group without mass needs an estimate.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import assert_never

from gazelle.description.model import (
    Heightmap,
    Inertial,
    JointType,
    Link,
    MeshShape,
    Model,
    Plane,
    Polyline,
    Shape,
    Solid,
)
from gazelle.description.read_context import ReadContext
from gazelle.diagnostics import SourceSpan
from gazelle.errors import GazelleError
from gazelle.geometry import (
    MassProperties,
    Pose,
    combined_mass_properties,
    inertia_problems,
    legalised_inertia,
)

__all__ = ["body_of", "with_inertia"]

_DENSITY_KG_M3 = 1000.0
_WORLD = "world"
# A link without any shape has nothing to estimate from: a gram in a ball of a few centimetres.
_NOTHING = MassProperties(1e-3, (0.0, 0.0, 0.0), (1e-6, 0.0, 0.0, 1e-6, 0.0, 1e-6))


def body_of(link: Link, context: ReadContext) -> MassProperties | None:
    """Return mass properties of a link's collisions, or of its visuals when it has none.

    Args:
        link: the link.
        context: where to report meshes that cannot be read.

    Returns:
        Mass, centre and inertia at 1000 kg/m³ in the link's frame; None without any volume.
    """
    collisions = [(item.shape, item.T_link_collision, item.span) for item in link.collisions]
    visuals = [(item.shape, item.T_link_visual, item.span) for item in link.visuals]
    return _whole(collisions, context) or _whole(visuals, context)


def with_inertia(model: Model, broken: Collection[str], context: ReadContext) -> Model:
    """Return the model with every moving body given mass and a possible tensor.

    A massless link fixed to others that have mass stays massless.

    Args:
        model: the robot, its ``<gazebo>`` blocks applied.
        broken: links whose ``<inertial>`` was reported as unusable already.
        context: where to report, and look-up of meshes.
    """
    links = {link.name: _checked(link, context) for link in model.links}
    broken = {*broken, *(link.name for link in model.links if _is_negative(link))}
    if not model.static:
        for group in _moving_groups(model):
            members = [links[name] for name in group]
            for link in _completed(members, broken, context):
                links[link.name] = link
    return replace(model, links=tuple(links.values()))


def _whole(
    shapes: list[tuple[Shape, Pose, SourceSpan | None]], context: ReadContext
) -> MassProperties | None:
    bodies = []
    for shape, pose, span in shapes:
        body = _body(shape, span, context)
        if body is not None and 0.0 < body.mass_kg < math.inf:
            bodies.append(body.transformed(pose))
    return combined_mass_properties(bodies) if bodies else None


def _body(shape: Shape, span: SourceSpan | None, context: ReadContext) -> MassProperties | None:
    match shape:
        case Solid():
            return shape.body(_DENSITY_KG_M3)
        case MeshShape():
            return _mesh_body(shape, span, context)
        case Plane() | Heightmap() | Polyline():
            return None  # URDF has no word for them
        case _:
            assert_never(shape)


def _mesh_body(
    shape: MeshShape, span: SourceSpan | None, context: ReadContext
) -> MassProperties | None:
    """Return a mesh's properties, those of its convex hull when it is not closed."""
    from gazelle.geometry import convex_hull, load_mesh_reported, mesh_mass_properties

    if shape.path is None:
        return None
    mesh = load_mesh_reported(shape.path, context.diagnostics, shape.span or span, smooth=False)
    if mesh is None:
        return None
    sized = mesh.scaled(shape.scale)
    try:
        return mesh_mass_properties(sized, density_kg_m3=_DENSITY_KG_M3)
    except GazelleError:
        try:
            hull = convex_hull(sized.vertices_m)
            return mesh_mass_properties(hull, density_kg_m3=_DENSITY_KG_M3)
        except (GazelleError, ValueError):
            return None  # flat: no volume, and the caller says that there is nothing to go by


def _checked(link: Link, context: ReadContext) -> Link:
    """Return the link with a mass that is not negative and a tensor that a body can have."""
    inertial = link.inertial
    if inertial is None:
        return link
    if _is_negative(link):
        message = f"link '{link.name}' has the mass {inertial.mass_kg:g} kg"
        context.diagnostics.report("urdf.negative-mass", message, inertial.span)
        return replace(link, inertial=None)
    problems = inertia_problems(inertial.inertia_kg_m2) if any(inertial.inertia_kg_m2) else ()
    if not problems or inertial.mass_kg == 0.0:
        return link
    legal = legalised_inertia(inertial.inertia_kg_m2)
    message = (
        f"no body has the inertia of link '{link.name}': {'; '.join(problems)}. ROS passes it on "
        "and Gazebo may diverge; the nearest possible tensor is used"
    )
    shown = Inertial(inertial.mass_kg, inertial.T_link_com, legal)
    context.diagnostics.report(
        "urdf.bad-inertia", message, inertial.span, fix=f"paste\n{_block(shown)}"
    )
    return replace(link, inertial=replace(inertial, inertia_kg_m2=legal))


def _is_negative(link: Link) -> bool:
    return link.inertial is not None and link.inertial.mass_kg < 0.0


def _moving_groups(model: Model) -> list[list[str]]:
    """Return the links that move as one, for each body that can move; its first link first."""
    above = {joint.child: joint for joint in model.joints}
    head: dict[str, str] = {}

    def head_of(name: str) -> str:
        path = []
        while name not in head and name in above and above[name].type is JointType.FIXED:
            path.append(name)
            name = above[name].parent
        found = head.get(name, name)
        head.update(dict.fromkeys(path, found))
        return found

    groups: dict[str, list[str]] = {}
    for link in model.links:
        groups.setdefault(head_of(link.name), []).append(link.name)
    groups.pop(_WORLD if model.link(_WORLD) is None else "", None)
    return [sorted(names, key=lambda name: name != first) for first, names in groups.items()]


def _completed(
    members: Sequence[Link], broken: Collection[str], context: ReadContext
) -> list[Link]:
    if sum(link.inertial.mass_kg for link in members if link.inertial) <= 0.0:
        return _estimated(members, broken, context)
    weighty = [link for link in members if link.inertial and link.inertial.mass_kg > 0.0]
    if any(link.inertial and any(link.inertial.inertia_kg_m2) for link in weighty):
        # A point mass fixed to a body with inertia is fine; a massless frame stays one.
        return [replace(link, inertial=None) if _is_empty(link) else link for link in members]
    return [_turnable(link, context) if link in weighty else link for link in members]


def _is_empty(link: Link) -> bool:
    return link.inertial is not None and link.inertial.mass_kg == 0.0


def _estimated(
    members: Sequence[Link], broken: Collection[str], context: ReadContext
) -> list[Link]:
    bodies = [body_of(link, context) for link in members]
    if not any(bodies):
        bodies[0] = _NOTHING
    return [
        replace(link, inertial=None)
        if body is None
        else _given(link, body, link.name in broken, context)
        for link, body in zip(members, bodies, strict=True)
    ]


def _given(link: Link, body: MassProperties, silent: bool, context: ReadContext) -> Link:
    span = link.inertial.span if link.inertial else link.span
    inertial = Inertial(
        body.mass_kg, Pose(body.center_m), body.inertia_kg_m2, estimated=True, span=span
    )
    if not silent:
        lack = "has no <inertial>" if link.inertial is None else "has the mass 0"
        source = "it has no shapes" if body is _NOTHING else "its shapes at 1000 kg/m³"
        message = (
            f"link '{link.name}' moves and {lack}: Gazebo would drop it with all that hangs on "
            f"it; {body.mass_kg:.4g} kg are used ({source})"
        )
        fix = f'paste into <link name="{link.name}"> and correct\n{_block(inertial)}'
        context.diagnostics.report("urdf.no-inertia", message, span, fix=fix)
    return replace(link, inertial=inertial)


def _turnable(link: Link, context: ReadContext) -> Link:
    """Return a link of some mass with the inertia that its shapes give this mass."""
    inertial = link.inertial
    if inertial is None:
        return link
    body = body_of(link, context) or _NOTHING
    moments = body.with_mass(inertial.mass_kg).inertia_kg_m2
    fuller = replace(inertial, inertia_kg_m2=moments, estimated=True)
    message = (
        f"link '{link.name}' moves with {inertial.mass_kg:g} kg and an inertia of 0: it could not "
        "be turned; the inertia is estimated from its shapes"
    )
    fix = f'paste into <link name="{link.name}">\n{_block(fuller)}'
    context.diagnostics.report("urdf.zero-inertia", message, inertial.span, fix=fix)
    return replace(link, inertial=fuller)


def _block(inertial: Inertial) -> str:
    x, y, z = inertial.T_link_com.position_m
    roll, pitch, yaw = inertial.T_link_com.rpy_rad
    components = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    moments = " ".join(
        f'{word}="{value:.6g}"'
        for word, value in zip(components, inertial.inertia_kg_m2, strict=True)
    )
    return (
        "<inertial>\n"
        f'  <origin xyz="{x:.6g} {y:.6g} {z:.6g}" rpy="{roll:.6g} {pitch:.6g} {yaw:.6g}"/>\n'
        f'  <mass value="{inertial.mass_kg:.6g}"/>\n'
        f"  <inertia {moments}/>\n"
        "</inertial>"
    )

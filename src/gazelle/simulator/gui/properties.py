"""The inspector's rows of a model, a link or a joint, and changes to them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.description.model import Collision, Joint, Link, Model
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError, NotFoundError
from gazelle.geometry import Pose
from gazelle.simulator.gui.fields import flag_of, number_of
from gazelle.simulator.input_validation import InputRefusedError, Limit
from gazelle.simulator.model_replacement import replace_model

if TYPE_CHECKING:
    from gazelle.engine import Engine

__all__ = ["PropertyRow", "joint_rows", "link_rows", "model_rows", "set_property"]

_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_AXIS = ("lower", "upper", "effort", "velocity", "damping", "friction")
_UNLIMITED = {"lower": -math.inf, "upper": math.inf, "effort": math.inf, "velocity": math.inf}
_SURFACE = {"mu1": "", "mu2": "", "kp": "N/m", "kd": "N·s/m", "restitution_coefficient": ""}
_SURFACE_FIELDS = {"restitution_coefficient": "restitution"}


class PropertyRow(NamedTuple):
    """A line of the inspector.

    Attributes:
        group: heading that it stands below; ``collision/NAME`` for a collision's.
        name: the SDF word.
        value: number, bool or text; None for what is unlimited or not given.
        unit: SI, empty for none.
        editable: `set_property` takes it.
    """

    group: str
    name: str
    value: Any
    unit: str = ""
    editable: bool = False


def model_rows(engine: Engine, model: Model) -> list[PropertyRow]:
    """Return the rows of a model as it is now."""
    linear, angular = engine.model_velocity(model.name)
    return [
        PropertyRow("model", "name", model.name),
        PropertyRow("model", "static", model.static, editable=True),
        PropertyRow("model", "self_collide", model.self_collide, editable=True),
        *_pose_rows(engine.model_pose(model.name)),
        *_vector_rows("velocity", "linear", linear, "m/s"),
        *_vector_rows("velocity", "angular", angular, "rad/s"),
        PropertyRow("source", "file", str(model.file or "")),
        PropertyRow("source", "format", model.source_format),
    ]


def link_rows(engine: Engine, model: Model, link: Link) -> list[PropertyRow]:
    """Return the rows of a link as it is now."""
    handle = engine.link(f"{model.name}::{link.name}")
    linear, angular = handle.velocity_world()
    return [
        PropertyRow("link", "name", link.name),
        PropertyRow("link", "gravity", link.gravity, editable=True),
        PropertyRow("link", "kinematic", link.kinematic),
        *(row._replace(editable=False) for row in _pose_rows(handle.T_world_link())),
        *_vector_rows("velocity", "linear", linear, "m/s"),
        *_vector_rows("velocity", "angular", angular, "rad/s"),
        *_inertial_rows(link),
        *(row for collision in link.collisions for row in _collision_rows(collision)),
    ]


def joint_rows(engine: Engine, model: Model, joint: Joint) -> list[PropertyRow]:
    """Return the rows of a joint as it is now."""
    handle = engine.joint(f"{model.name}::{joint.name}")
    angle, effort = ("m", "N") if joint.type.value == "prismatic" else ("rad", "N·m")
    units = {"lower": angle, "upper": angle, "effort": effort, "velocity": f"{angle}/s",
             "damping": f"{effort}·s/{angle}", "friction": effort}  # fmt: skip
    rows = [
        PropertyRow("joint", "name", joint.name),
        PropertyRow("joint", "type", joint.type.value),
        PropertyRow("joint", "parent", joint.parent),
        PropertyRow("joint", "child", joint.child),
        PropertyRow("state", "position", handle.position, angle),
        PropertyRow("state", "velocity", handle.velocity, f"{angle}/s"),
        PropertyRow("state", "effort", handle.effort, effort),
    ]
    if joint.axis is not None:
        rows += [
            PropertyRow(
                "axis", name, _finite(getattr(joint.axis, name)), units[name], editable=True
            )
            for name in _AXIS
        ]
    return rows


def set_property(
    engine: Engine, model: Model, name: str, value: Any, *, link: str = "", joint: str = ""
) -> None:
    """Change a property of a model, or of its link or joint; state stays as it is.

    Args:
        engine: of the running world.
        model: whose property, or whose link's or joint's.
        name: the row's name; ``collision/NAME/mu1`` for a collision's.
        value: the new value.
        link: name of the link whose property it is, if any.
        joint: name of the joint whose property it is, if any.

    Raises:
        GazelleError: there is no such property, or it cannot have this value.
        NotFoundError: there is no such link or joint.
    """
    if link:
        changed = _with_link(model, link, name, value)
    elif joint:
        changed = _with_joint(model, joint, name, value)
    elif name in ("static", "self_collide"):
        change: dict[str, Any] = {name: flag_of(value, name)}
        changed = replace(model, **change)
    else:
        raise _unknown(name, ["static", "self_collide"])
    replace_model(engine, changed)


def _pose_rows(pose: Pose) -> list[PropertyRow]:
    values = zip(("x", "y", "z", "roll", "pitch", "yaw"), (*pose.position_m, *pose.rpy_rad),
                 strict=True)  # fmt: skip
    return [
        PropertyRow("pose", name, value, "m" if len(name) == 1 else "rad", editable=True)
        for name, value in values
    ]


def _vector_rows(group: str, name: str, vector: Any, unit: str) -> Iterator[PropertyRow]:
    for axis, value in zip("xyz", vector.tolist(), strict=True):
        yield PropertyRow(group, f"{name} {axis}", value, unit)


def _inertial_rows(link: Link) -> Iterator[PropertyRow]:
    inertial = link.inertial
    if inertial is None:
        yield PropertyRow("inertial", "mass", None, "kg", editable=False)
        return
    yield PropertyRow("inertial", "mass", inertial.mass_kg, "kg", editable=True)
    for name, value in zip(_TENSOR, inertial.inertia_kg_m2, strict=True):
        yield PropertyRow("inertial", name, value, "kg·m²", editable=True)
    for row in _pose_rows(inertial.T_link_com):
        yield row._replace(group="inertial", editable=False)


def _collision_rows(collision: Collision) -> Iterator[PropertyRow]:
    group = f"collision/{collision.name}"
    yield PropertyRow(group, "geometry", type(collision.shape).__name__.lower())
    for name, unit in _SURFACE.items():
        value = getattr(collision.surface, _SURFACE_FIELDS.get(name, name))
        yield PropertyRow(group, name, value, unit, editable=True)


def _with_link(model: Model, link_name: str, name: str, value: Any) -> Model:
    link = model.link(link_name)
    if link is None:
        raise NotFoundError("link", link_name, nearest=[one.name for one in model.links])
    changed = _changed_link(link, name, value)
    links = tuple(changed if one is link else one for one in model.links)
    return replace(model, links=links)


def _changed_link(link: Link, name: str, value: Any) -> Link:
    inertial = link.inertial
    if name == "gravity":
        return replace(link, gravity=flag_of(value, name))
    if name == "mass" and inertial is not None:
        return replace(
            link, inertial=replace(inertial, mass_kg=_positive(name, value, Limit.MASS_KG))
        )
    if name in _TENSOR and inertial is not None:
        tensor: dict[str, Any] = dict(zip(_TENSOR, inertial.inertia_kg_m2, strict=True))
        tensor[name] = number_of(value, name)
        changed: Any = tuple(tensor.values())
        return replace(link, inertial=replace(inertial, inertia_kg_m2=changed))
    kind, _, rest = name.partition("/")
    if kind == "collision":
        return _changed_surface(link, rest, value)
    raise _unknown(name, ["gravity", "mass", *_TENSOR, "collision/NAME/mu1"])


def _changed_surface(link: Link, path: str, value: Any) -> Link:
    collision_name, _, name = path.rpartition("/")
    found = next((one for one in link.collisions if one.name == collision_name), None)
    if found is None or name not in _SURFACE:
        known = [f"collision/{one.name}/{name}" for one in link.collisions for name in _SURFACE]
        raise _unknown(f"collision/{path}", known)
    change: dict[str, Any] = {_SURFACE_FIELDS.get(name, name): number_of(value, name)}
    surface = replace(found.surface, **change)
    changed = replace(found, surface=surface)
    return replace(
        link, collisions=tuple(changed if one is found else one for one in link.collisions)
    )


def _with_joint(model: Model, joint_name: str, name: str, value: Any) -> Model:
    joint = model.joint(joint_name)
    if joint is None:
        raise NotFoundError("joint", joint_name, nearest=[one.name for one in model.joints])
    if joint.axis is None or name not in _AXIS:
        raise _unknown(name, [] if joint.axis is None else list(_AXIS))
    is_unlimited = value is None and name in _UNLIMITED
    change: dict[str, Any] = {name: _UNLIMITED[name] if is_unlimited else number_of(value, name)}
    changed = replace(joint, axis=replace(joint.axis, **change))
    return replace(model, joints=tuple(changed if one is joint else one for one in model.joints))


def _positive(name: str, value: Any, limit: float) -> float:
    number = number_of(value, name, limit)
    if number <= 0.0:
        raise InputRefusedError(f"field '{name}' is {number:g}; it has to be above 0")
    return number


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _unknown(name: str, known: list[str]) -> GazelleError:
    hint = did_you_mean(name, known) or f"there are: {', '.join(known) or 'none'}"
    return GazelleError(f"no editable property '{name}'; {hint}")
